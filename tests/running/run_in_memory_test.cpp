#include "courant/running/run_in_memory.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <filesystem>

#include "courant/manifolds/euclidean.hpp"
#include "courant/running/run_files.hpp"
#include "run_in.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(run_in_memory_suite)

namespace {

constexpr double kStep = 0.1;

const Json oscillator = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.1, "end": 10 },
  "observe": { "speed": "q'" },
  "events": { "down": { "zero": "q", "direction": "falling" } }
})json");

RunInMemoryOptions interpreted(bool has_curve = false) {
  RunInMemoryOptions options;
  options.run.backend = Backend::interpreter;
  options.has_curve = has_curve;
  return options;
}

// By the midpoint rule a step of h turns by 2 atan(h/2).
double angle_of(double h) { return 2.0 * std::atan(h / 2.0); }

// x'' = -x as a class: v = (x', y') with x' = y, y' = -x.
class Rotation final : public ImplicitSystem {
 public:
  Rotation()
      : ImplicitSystem(std::make_shared<Euclidean>(2), 0, 2, {.coordinates = {"r[0]", "r[1]"}}) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector&,
                         const Expr&) const override {
    ExprVector F(2);
    F << v[0] - x[1], v[1] + x[0];
    return F;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(rows_events_and_the_ladder_are_objects) {
  const RunInMemory run = run_in_memory(read_experiment_document(oscillator), interpreted());
  BOOST_TEST((run.outcome.status == RunStatus::completed));
  BOOST_TEST(run.rows.names == (std::vector<std::string>{"t", "q", "p_q", "H", "speed"}));
  BOOST_REQUIRE(run.rows.rows() == 101u);
  const auto t = run.rows.column("t"), q = run.rows.column("q");
  for (std::size_t k = 0; k <= 100; ++k) {
    BOOST_TEST(t[k] == static_cast<double>(k) * kStep);
    BOOST_TEST(std::abs(q[k] - std::cos(static_cast<double>(k) * angle_of(kStep))) < 1e-13);
  }
  BOOST_TEST((run.outcome.summary.ladder->verdict == Verdict::regular));
  BOOST_TEST(*run.outcome.summary.ladder->degrees_of_freedom == 2);
  const RunTable& down = run.events.at("down");
  BOOST_REQUIRE(down.rows() == 2u);  // at π/2 and 5π/2
  BOOST_TEST(std::abs(down.column("t")[0] - std::acos(0.0)) < 2e-3);
  BOOST_TEST(std::abs(down.column("q")[1]) < 1e-14);
  BOOST_TEST(run.curve == nullptr);
  BOOST_CHECK_THROW((void)run.rows.column("qq"), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_folder_has_the_same_bits) {
  Json timed = oscillator;
  timed["output"] = {{"at", {0.25, 1, "pi"}}};
  const TemporaryFolder folder;
  run_in(folder, timed);
  const Run written = read_run(folder / "run");
  const RunInMemory run = run_in_memory(read_experiment_document(timed), interpreted());
  BOOST_TEST(written.trajectory.names() == run.rows.names);
  BOOST_REQUIRE(run.rows.rows() == 5u);
  for (const std::string& name : run.rows.names) {
    const auto column = written.trajectory.column(name);
    BOOST_TEST(std::vector<double>(column.begin(), column.end()) == run.rows.column(name));
  }
  const auto event = written.events.at("down").column("q");
  BOOST_TEST(std::vector<double>(event.begin(), event.end()) == run.events.at("down").column("q"));
}

BOOST_AUTO_TEST_CASE(nothing_is_written) {
  const TemporaryFolder folder;
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  run_in_memory(read_experiment_document(oscillator), interpreted());
  std::filesystem::current_path(here);
  BOOST_TEST(std::filesystem::is_empty(folder / ""));
}

BOOST_AUTO_TEST_CASE(a_system_and_a_method_need_no_words_for_the_system) {
  const Json document = {{"initial", {{"r", {1, 0}}}},
                         {"method", "discretize-first"},
                         {"time", {{"step", kStep}, {"end", 10}}},
                         {"observe", {{"square", "r[0]^2 + r[1]^2"}}}};
  const RunInMemory run = run_in_memory(
      read_experiment_document(document, model_of(std::make_shared<Rotation>())), interpreted());
  BOOST_TEST(run.rows.names == (std::vector<std::string>{"t", "r[0]", "r[1]", "square"}));
  BOOST_TEST(std::abs(run.rows.column("r[0]")[100] - std::cos(100 * angle_of(kStep))) < 1e-12);
  BOOST_TEST(std::abs(run.rows.column("square")[100] - 1.0) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_stop_leaves_what_there_is) {
  std::atomic<bool> stop = false;
  class AfterTen final : public RunWatcher {
   public:
    explicit AfterTen(std::atomic<bool>& flag) : flag_(flag) {}
    std::optional<RunEnd> watch(const RunMoment& moment) override {
      if (moment.k == 10) flag_ = true;
      return std::nullopt;
    }

   private:
    std::atomic<bool>& flag_;
  } watcher(stop);
  RunInMemoryOptions options = interpreted();
  options.run.stop = &stop;
  options.run.watchers = {&watcher};
  const RunInMemory run = run_in_memory(read_experiment_document(oscillator), options);
  BOOST_TEST((run.outcome.status == RunStatus::interrupted));
  BOOST_TEST(run.rows.rows() == 12u);  // it is looked at before the watcher is told
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
