// Sizes that are given of coordinates and unknowns.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "../core/files/temporary_folder.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/run_in_memory.hpp"
#include "courant/structures/system_in_units.hpp"

// Mistakes that these cases have to notice:
//  * sizes are read and no step is measured by them (reading/method_in_units.cpp)
//  * what is not named is measured by 1 though it has a size (reading/method_in_units.cpp)
//  * positions move by other sizes (running/start_stages.cpp)
BOOST_AUTO_TEST_SUITE(nominal_sizes_test)

using namespace courant;

namespace {

// u' = (e^(5-u) - 1)/10 + cos(t)/3 and q' = -q²/a from q = a, by the midpoint rule. Because of the exponential no units
// are looked for.
Json charge_beside_a_voltage(double a, const Json& nominal) {
  Json document = {{"system",
                    {{"type", "implicit"},
                     {"parameters", {{"a", a}}},
                     {"coordinates", {"u", "q"}},
                     {"equations", {"u' - 0.1*(exp(5 - u) - 1) - cos(t)/3", "q' + q^2/a"}}}},
                   {"initial", {{"u", 5}, {"q", a}}},
                   {"method", {{"type", "discretize-first"}}},
                   {"time", {{"step", 0.25}, {"end", 5}}}};
  if (!nominal.is_null()) document["nominal"] = nominal;
  return document;
}

// The largest relative error of q in a row as a step of the one before: s₁ - s₀ = -h ((s₀ + s₁)/2)², solved for s₁ =
// q₁/a.
double error_of_steps(const Json& document, double a) {
  constexpr double h = 0.25;
  const RunInMemory run = run_in_memory(read_experiment_document(document));
  BOOST_TEST_REQUIRE(run.outcome.message == "");
  const std::vector<double> q = run.rows.column("q");
  BOOST_TEST_REQUIRE(q.size() == 21u);
  double error = 0.0;
  for (std::size_t k = 0; k + 1 < q.size(); ++k) {
    const double s = q[k] / a, b = 1.0 + h * s / 2.0, c = s - h * s * s / 4.0;
    const double next = 2.0 * c / (b + std::sqrt(b * b + h * c));
    error = std::max(error, std::fabs(q[k + 1] / a - next) / next);
  }
  return error;
}

Units units_of(const Json& document) {
  const Experiment experiment = read_experiment_document(document);
  const ConsistentStart start = consistent_start(experiment);
  const PreparedMethod method =
      experiment.method->prepare({.system = experiment.model.system,
                                  .ladder = start,
                                  .initial = start.point,
                                  .step = experiment.time->step,
                                  .backend = Backend::interpreter,
                                  .vocabulary = &experiment.model.vocabulary});
  BOOST_TEST_REQUIRE(method.integrator->units() != nullptr);
  return *method.integrator->units();
}

std::string problem_of(const Json& document) {
  try {
    read_experiment_document(document);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

std::string in_words(const ConstraintLadder& ladder) {
  std::string text = to_string(ladder.verdict) + " " + std::to_string(ladder.index);
  for (const LadderLevel& level : ladder.levels)
    text += " (" + std::to_string(level.dim_S) + "," + std::to_string(level.dim_M) + ")";
  for (const Doubt& doubt : ladder.doubts) text += " [" + to_string(doubt.kind) + "]";
  return text;
}

}  // namespace

// Next to 5, changes of 10⁻¹⁵ are nothing: without its size q is not solved for.
BOOST_AUTO_TEST_CASE(a_small_charge_has_all_its_digits) {
  constexpr double a = 1e-15;
  BOOST_TEST(error_of_steps(charge_beside_a_voltage(a, {}), a) > 1e-10);
  BOOST_TEST(error_of_steps(charge_beside_a_voltage(a, {{"q", 1e3}}), a) > 1e-10);
  BOOST_TEST(error_of_steps(charge_beside_a_voltage(a, {{"q", a}}), a) < 1e-14);
  BOOST_TEST(error_of_steps(charge_beside_a_voltage(1.0, {}), 1.0) < 1e-14);
}

BOOST_AUTO_TEST_CASE(steps_are_measured_by_what_is_given) {
  const Units units = units_of(charge_beside_a_voltage(1e-15, {{"q", 1e-15}}));
  BOOST_TEST(units.coordinates[0] == 1.0);
  BOOST_TEST(std::fabs(std::log2(units.coordinates[1] / 1e-15)) <= 0.5);
  BOOST_TEST(units.tangent[1] == units.coordinates[1]);
  BOOST_TEST(units.time == 1.0);
  // What is not named keeps the units that are found: of an orbit of an electron those of all but p_x.
  const double m = 9.109e-31, l = 1e-6, T = 1e-12;
  Json orbit = {{"system",
                 {{"type", "mechanical"},
                  {"parameters", {{"m", m}, {"k", m * l * l * l / (T * T)}}},
                  {"coordinates", {"x", "y"}},
                  {"metric", "m"},
                  {"potential", "-k/sqrt(x^2 + y^2)"}}},
                {"initial", {{"x", l}, {"y", 0}, {"p_x", 0}, {"p_y", m * l / T}}},
                {"method", {{"type", "discretize-first"}}},
                {"time", {{"step", 0.01 * T}, {"end", T}}}};
  const Units found = units_of(orbit);
  orbit["nominal"] = {{"p_x", std::ldexp(1.0, -70)}};
  const Units given = units_of(orbit);
  BOOST_TEST(given.coordinates[2] == std::ldexp(1.0, -70));
  BOOST_TEST(given.coordinates[0] == found.coordinates[0]);
  BOOST_TEST(given.coordinates[1] == found.coordinates[1]);
  BOOST_TEST(given.time == found.time);
}

// The least ((x - 3)/0.1)² + (y + 4)² on the circle: its gradient is parallel to (x, y).
BOOST_AUTO_TEST_CASE(starts_move_least_in_them) {
  Json pendulum = {
      {"system",
       {{"type", "implicit"},
        {"coordinates", {"x", "y", "v", "w"}},
        {"unknowns", {"tension"}},
        {"equations",
         {"x' - v", "y' - w", "v' + tension*x", "w' + tension*y + 1", "x^2 + y^2 - 1"}}}},
      {"initial", {{"x", 3}, {"y", -4}, {"v", 0}, {"w", 0}}},
      {"nominal", {{"x", 0.1}}}};
  const VectorXd x = consistent_start(read_experiment_document(pendulum)).point.x;
  BOOST_TEST(std::fabs(x[0] * x[0] + x[1] * x[1] - 1.0) < 1e-12);
  BOOST_TEST(std::fabs(100.0 * (x[0] - 3.0) * x[1] - (x[1] + 4.0) * x[0]) < 1e-5);
  BOOST_TEST(x[0] > 0.9);
}

// With sizes that are wrong by 10^±6, of each coordinate and unknown another.
BOOST_AUTO_TEST_CASE(no_decision_knows_them) {
  for (const char* name :
       {"pendulum", "pendulum_cartesian", "network_rlc", "network_ladder_index_2", "christ_lee",
        "inconsistent_lagrangian", "rolling_disk", "four_bar", "crane", "christ_lee_quartic"}) {
    Json document =
        Json::parse(read_text("experiments/" + std::string(name) + ".json"), nullptr, true, true);
    const Experiment plain = read_experiment_document(document);
    const std::string expected = in_words(consistent_start(plain));
    const ImplicitSystem& system = *plain.model.system;
    const std::vector<Index> units = system.manifold()->scaling_symmetries().point;
    for (const int turn : {0, 1}) {
      Json nominal = Json::object();
      int k = turn;
      for (std::size_t i = 0; i < units.size(); ++i)
        if (units[i] != Manifold::ScalingSymmetries::none &&
            std::ranges::count(units, units[i]) == 1)
          nominal[system.names().coordinates[i]] = k++ % 2 == 0 ? 1e6 : 1e-6;
      for (Index i = 0; i < plain.initial.z.values.size(); ++i)
        if (const std::string& unknown = system.names().auxiliary[static_cast<std::size_t>(i)];
            !unknown.ends_with('\''))  // velocities, of a Lagrangian
          nominal[unknown] = k++ % 2 == 0 ? 1e6 : 1e-6;
      document["nominal"] = nominal;
      const std::string problem = problem_of(document);
      BOOST_TEST_REQUIRE(problem == "", name << ": " << problem);
      const std::string found = in_words(consistent_start(read_experiment_document(document)));
      BOOST_TEST(found == expected, name << ": " << found << ", without sizes " << expected);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_a_size_is_told) {
  const auto with = [](const Json& nominal) {
    return problem_of(charge_beside_a_voltage(1.0, nominal));
  };
  const auto has = [&](const std::string& text, const std::string& part) {
    BOOST_TEST(text.find(part) != std::string::npos, text);
  };
  has(with({{"Q", 1}}), "/nominal/Q: key, column 1: unknown name \"Q\" (did you mean \"q\"?)");
  has(with({{"q", 0}}), "/nominal/q: is 0; expected a number greater than 0");
  has(with({{"q", -1e-15}}), "/nominal/q: is -1e-15; expected a number greater than 0");
  has(with({{"q", "small"}}), "/nominal/q: is \"small\"; expected a number greater than 0");
  has(with({{"q", {1, 2}}}), "/nominal/q: has 2 values; expected 1, for q, or one for all");
  has(with({{"q'", 1}}), "/nominal/q': is the size of a velocity");
  Json turning = Json::parse(read_text("experiments/spherical_pendulum.json"), nullptr, true, true);
  turning["nominal"] = {{"x", 2}};
  has(problem_of(turning), "/nominal/x: is the size of x, which has none on ");
}

BOOST_AUTO_TEST_SUITE_END()
