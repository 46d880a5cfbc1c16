#include "courant/running/trajectory_rows.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../core/files/temporary_folder.hpp"
#include "courant/running/folder_keeper.hpp"
#include "courant/running/run_files.hpp"
#include "problems.hpp"

namespace courant::test {
// Mistakes that these cases have to notice:
//  * a time within a step is a share of the whole run
//  * columns that nobody asked for are written
//  * a row is kept for an expectation at another time
BOOST_AUTO_TEST_SUITE(trajectory_rows_test)

namespace {

Json oscillator() {
  return Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
    "initial": { "q": 1, "p_q": 0 }, "method": "discretize-first",
    "time": { "step": 0.25, "end": 1 }, "output": { "every": 2 }
  })json");
}

// All that the rows of an experiment need.
struct Rows {
  explicit Rows(const Json& document)
      : given(problem(document)),
        method(given.prepare("discretize-first", 0.25)),
        observer(given.experiment, given.ladder, Backend::interpreter),
        clock(given.experiment.time),
        elsewhere(given.experiment, given.ladder, observer),
        rows(given.experiment, observer, clock, kept) {}

  // The file after four steps, with a row after each step that has one.
  TrajectoryTable written() {
    const TemporaryFolder folder;
    {
      FolderKeeper keeper(folder / "run", ExistingRun::refuse, std::chrono::seconds(1));
      keeper.begin(given.experiment);
      keeper.open({.columns = rows.column_names(),
                   .headings = rows.headings(),
                   .events = {},
                   .event_columns = {},
                   .ladder = given.ladder,
                   .integrator = nullptr});
      const auto stepper = method.integrator->stepper();
      State state = method.initial;
      const auto write = [&](long k, const VectorXd& row, const Step& step) {
        rows.write({.k = k, .steps = 4, .t = clock.t(state, k), .row = row, .step = step}, keeper);
      };
      write(0, observer.begin(state), Step{.after = state});
      for (long k = 1; k <= 4; ++k) {
        stepper->step(state, 0.25);
        elsewhere.begin_step();
        rows.write_between(*stepper, k, elsewhere, keeper);
        const VectorXd& row = observer.advance(stepper->last());
        rows.keep(clock.t(state, k), row);
        write(k, row, stepper->last());
      }
      keeper.close();
    }
    return read_trajectory_csv(folder / "run" / "trajectory.csv");
  }

  Problem given;
  PreparedMethod method;
  Observer observer;
  RunClock clock;
  ObserverElsewhere elsewhere;
  std::map<double, VectorXd> kept;
  TrajectoryRows rows;
};

std::vector<double> times(const TrajectoryTable& table) {
  const auto t = table.column("t");
  return {t.begin(), t.end()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_second_step_and_the_last_have_a_row) {
  Rows two(oscillator());
  BOOST_TEST(times(two.written()) == (std::vector<double>{0, 0.5, 1}),
             boost::test_tools::per_element());
  Json document = oscillator();
  document["output"]["every"] = 3;
  BOOST_TEST(times(Rows(document).written()) == (std::vector<double>{0, 0.75, 1}),
             boost::test_tools::per_element());
}

// 0.3 and 0.35 are 0.2 and 0.4 of the second step, 0.5 is its end. The last state has a row in any case.
BOOST_AUTO_TEST_CASE(times_that_are_asked_for_lie_between_steps) {
  Json document = oscillator();
  document["output"] = {{"at", {0.3, 0.35, 0.5}}};
  const TrajectoryTable table = Rows(document).written();
  BOOST_TEST(times(table) == (std::vector<double>{0, 0.3, 0.35, 0.5, 1}),
             boost::test_tools::per_element());
  // Dense output has the method's order: the error of the midpoint rule at this step.
  for (const std::size_t i : {1u, 2u})
    BOOST_TEST(std::fabs(table.column("q")[i] - std::cos(table.column("t")[i])) < 2e-3);
}

BOOST_AUTO_TEST_CASE(only_columns_that_are_asked_for_are_written) {
  Json document = oscillator();
  document["output"]["coordinates"] = {"p_q"};
  Rows rows(document);
  BOOST_TEST(rows.rows.names() == (std::vector<std::string>{"q", "p_q", "H"}),
             boost::test_tools::per_element());
  BOOST_TEST(rows.written().names() == (std::vector<std::string>{"t", "p_q", "H"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(rows_at_times_of_expectations_are_kept) {
  Json document = oscillator();
  document["expect"] = Json::parse(R"([{ "at": 0.75, "state": { "q": 0 }, "tolerance": 9 }])");
  Rows rows(document);
  rows.written();
  BOOST_TEST_REQUIRE(rows.kept.size() == 1u);
  BOOST_TEST_REQUIRE(rows.kept.contains(0.75));
  BOOST_TEST(std::fabs(rows.kept[0.75][0] - std::cos(0.75)) < 5e-3);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
