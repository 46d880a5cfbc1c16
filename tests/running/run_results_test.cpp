#include "courant/running/run_results.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/ladder_report.hpp"
#include "problems.hpp"

namespace courant::test {
// Mistakes that these cases have to notice:
//  * constraints are listed as observables
BOOST_AUTO_TEST_SUITE(run_results_test)

namespace {

// A bead on the unit circle: a row is x, y, v, w, then what is observed, then constraints.
Json on_circle() {
  return Json::parse(R"json({
    "title": "a bead",
    "system": { "type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["tension"],
      "equations": ["x' - v", "y' - w", "v' + tension*x", "w' + tension*y", "x^2 + y^2 - 1"] },
    "initial": { "x": 1, "y": 0, "v": 0, "w": 1 },
    "method": "constrain-first", "time": { "start": 2, "step": 0.5, "end": 4 },
    "observe": { "height": "y" },
    "expect": [ { "at": 3, "state": { "height": 0.75 }, "tolerance": 0.01 } ]
  })json");
}

Json free_particle() {
  return Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2" },
    "initial": { "q": 1, "p_q": 1 }, "method": "discretize-first", "time": { "step": 0.5, "end": 1 }
  })json");
}

struct Results {
  explicit Results(const Json& document)
      : given(problem(document)),
        report(ladder_report(given.ladder, *given.experiment.model.system)),
        observer(given.experiment, given.ladder, Backend::interpreter),
        of{.experiment = given.experiment,
           .ladder = given.ladder,
           .ladder_report = report,
           .symmetries = symmetries,
           .observer = observer} {}

  // A row whose numbers are all this one.
  VectorXd row(double number) const {
    return VectorXd::Constant(std::ssize(observer.names()), number);
  }

  Problem given;
  LadderReport report;
  std::vector<SymmetryFinding> symmetries;
  Observer observer;
  RunResults of;
};

}  // namespace

// The greatest of all constraints on either side of zero, and nothing of the other numbers of a row.
BOOST_AUTO_TEST_CASE(violations_are_those_of_constraints_alone) {
  Results results(on_circle());
  BOOST_TEST_REQUIRE(results.observer.constraint_count() >= 2u);
  const Index first = static_cast<Index>(results.observer.first_constraint());
  VectorXd row = results.row(5.0);
  row.tail(row.size() - first).setZero();
  row[first] = 0.25;
  results.of.statistics.add(2.0, row);
  BOOST_TEST(results.of.max_violation() == 0.25);
  row[first + 1] = -0.5;
  results.of.statistics.add(2.5, row);
  BOOST_TEST(results.of.max_violation() == 0.5);
  BOOST_TEST(results.of.summary(RunStatus::completed, {}).max_violation.value() == 0.5);

  Results unconstrained(free_particle());
  unconstrained.of.statistics.add(0.0, unconstrained.row(5.0));
  BOOST_TEST(std::isnan(unconstrained.of.max_violation()));
  BOOST_TEST(!unconstrained.of.summary(RunStatus::completed, {}).max_violation);
}

// Coordinates by their last value, what is observed by its record; constraints are in neither list.
BOOST_AUTO_TEST_CASE(a_summary_tells_coordinates_and_observables_apart) {
  Results results(on_circle());
  results.of.statistics.add(2.0, results.row(1.0));
  results.of.statistics.add(2.5, results.row(3.0));
  results.of.id = "0123";
  results.of.warnings = {"careful"};
  results.of.steps = 4;
  results.of.solver = {.steps = 4, .iterations = 12, .factorizations = 2, .failures = 1};
  results.of.wall_seconds = 0.5;
  results.of.cpu_seconds = 0.75;
  const RunSummary told = results.of.summary(RunStatus::interrupted, {});
  BOOST_TEST(told.id == "0123");
  BOOST_TEST((told.status == RunStatus::interrupted));
  BOOST_TEST(told.title == "a bead");
  BOOST_TEST(told.warnings.size() == 1u);
  BOOST_TEST(told.final.size() == results.observer.coordinate_count());
  BOOST_TEST(told.final.front().first == "x");
  BOOST_TEST(told.final.front().second == 3.0);
  const QuantityRecord* height = told.observable("height");
  BOOST_TEST_REQUIRE(height != nullptr);
  BOOST_TEST(height->initial == 1.0);
  BOOST_TEST(height->final == 3.0);
  BOOST_TEST(told.final.size() + told.observables.size() == results.observer.first_constraint());
  BOOST_TEST(told.time->start == 2.0);
  BOOST_TEST(told.time->end == 4.0);
  BOOST_TEST(told.solver.iterations_per_step == 3.0);
  BOOST_TEST(told.solver.factorizations_per_step == 0.5);
  BOOST_TEST(told.solver.failures.value() == 1);
  BOOST_TEST(told.cpu_seconds == 0.75);
  BOOST_TEST(told.steps_per_second == 8.0);
  BOOST_TEST(told.events.empty());
  BOOST_TEST(!told.power_balance);
}

// Before the first state nothing is known of quantities, and nothing is divided by zero.
BOOST_AUTO_TEST_CASE(a_run_without_states_has_a_summary) {
  Results results(on_circle());
  const RunSummary told = results.of.summary(RunStatus::running, {});
  BOOST_TEST(told.final.empty());
  BOOST_TEST(told.observables.empty());
  BOOST_TEST(!told.max_violation);
  BOOST_TEST(told.solver.iterations_per_step == 0.0);
  BOOST_TEST(told.time->end == 2.0);
  BOOST_TEST_REQUIRE(results.of.expectations().size() == 1u);
  BOOST_TEST(!results.of.expectations().front().passed);
}

// An expectation at a time reads the row that was kept there, whatever the last one is.
BOOST_AUTO_TEST_CASE(expectations_read_the_rows_of_their_times) {
  Results results(on_circle());
  results.of.statistics.add(2.0, results.row(1.0));
  results.of.rows_at_times[3.0] = results.row(0.755);
  BOOST_TEST(results.of.expectations().front().passed);
  results.of.rows_at_times[3.0] = results.row(0.77);
  BOOST_TEST(!results.of.expectations().front().passed);
}

// A run that ended early, or that has no states, meets no expectation of what it kept to.
BOOST_AUTO_TEST_CASE(expectations_of_whole_runs_ask_for_whole_runs) {
  Json document = on_circle();
  document["expect"] = Json::parse(R"([ { "observable": "height", "max": 2 } ])");
  Results results(document);
  BOOST_TEST(!results.of.expectations().front().passed);
  results.of.statistics.add(2.0, results.row(1.0));
  BOOST_TEST(results.of.expectations().front().passed);
  results.of.status = RunStatus::interrupted;
  BOOST_TEST(!results.of.expectations().front().passed);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::test
