#include "courant/running/run_sensitivities.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <string>

#include "courant/running/run_in_memory.hpp"
#include "resumed_run.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a parameter moves the equations but not what is typed for initial values, or the other way around
//  * the start moves along a direction off M_f(θ), or moves values that are given
//  * quantities forget that v and z move with the state, or that they contain the parameter itself
//  * a parameter that the system takes as a number when it is read has the derivative 0
//  * a run that goes on has other derivatives
//  * exponents are those of a single step
BOOST_AUTO_TEST_SUITE(run_sensitivities)

namespace {

RunInMemory run_of(const Json& document) {
  RunInMemoryOptions options;
  options.run.backend = Backend::interpreter;
  RunInMemory run = run_in_memory(read_experiment_document(document), options);
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  return run;
}

std::string refusal_of(const Json& document) {
  try {
    run_in_memory(read_experiment_document(document));
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

void test_refusal(const Json& document, const std::string& words) {
  const std::string what = refusal_of(document);
  BOOST_TEST(what.find(words) != std::string::npos, what << " has not: " << words);
  BOOST_TEST(std::count(what.begin(), what.end(), '\n') == 0, what);
}

// Where the number stands that a name is, and what it is.
struct Typed {
  std::string name, pointer;
};

// Each column of the run, at its last row, by differences of order 8 of whole runs without the key.
void compare_with_runs(Json document, const std::vector<Typed>& by,
                       const std::vector<std::string>& of, double tolerance,
                       const std::string& what) {
  Json plain = document;
  document["sensitivities"] = {{"by", Json::array()}, {"of", of}};
  for (const Typed& typed : by) document["sensitivities"]["by"].push_back(typed.name);
  const RunInMemory run = run_of(document);
  constexpr std::array weights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  for (const auto& [name, pointer] : by) {
    const Json::json_pointer place(pointer);
    const double value = plain.at(place).get<double>();
    const double size = value == 0.0 ? 0.1 : std::abs(value);
    std::map<std::string, std::array<double, 2>> measured;
    const std::array steps = {0.004 * size, 0.002 * size};
    for (std::size_t pass = 0; pass < steps.size(); ++pass)
      for (std::size_t i = 0; i < weights.size(); ++i)
        for (const double sign : {1.0, -1.0}) {
          Json moved = plain;
          moved[place] = value + sign * static_cast<double>(i + 1) * steps[pass];
          const RunInMemory other = run_of(moved);
          for (const std::string& quantity : of)
            measured[quantity][pass] +=
                sign * weights[i] / steps[pass] * other.rows.column(quantity).back();
        }
    for (const std::string& quantity : of) {
      const double found = run.rows.column("d(" + quantity + ")/d(" + name + ")").back();
      const auto& both = measured[quantity];
      const double off = std::min(std::abs(found - both[0]), std::abs(found - both[1]));
      BOOST_TEST(off < tolerance * (1.0 + std::abs(found)),
                 what << ": d(" << quantity << ")/d(" << name << ") is " << found << ", measured "
                      << both[0] << " and " << both[1] << ", off by " << off);
    }
  }
  // The run itself is as it is without the key.
  const RunInMemory without = run_of(plain);
  BOOST_TEST((without.rows.column(of[0]) == run.rows.column(of[0])), what);
}

Json oscillator() {
  return {{"system",
           {{"type", "hamiltonian"},
            {"parameters", {{"m", 0.7}, {"k", 2.3}}},
            {"coordinates", {"q"}},
            {"hamiltonian", "p_q^2/(2*m) + k*q^2/2"}}},
          {"initial", {{"q", 0.8}, {"p_q", 0.1}}},
          {"method", "discretize-first"},
          {"time", {{"step", 0.1}, {"end", 3.7}}}};
}

// A pendulum in the plane: Lagrangian in Cartesian coordinates with |r| = L.
Json pendulum(const Json& method) {
  return {{"system",
           {{"type", "lagrangian"},
            {"parameters", {{"m", 0.7}, {"L", 1.3}, {"g", 9.81}, {"a", 0.4}, {"c", "m*g"}}},
            {"coordinates", {"x", "y"}},
            {"lagrangian", "m*(x'^2 + y'^2)/2 - c*y"},
            {"holonomic", "x^2 + y^2 - L^2"}}},
          {"initial",
           {{"x", "L*sin(a)"}, {"y", "-L*cos(a)"}, {"x'", "0.6*cos(a)"}, {"y'", "0.6*sin(a)"}}},
          {"method", method},
          {"observe", {{"height", "y + L"}, {"speed", "sqrt(x'^2 + y'^2)"}}},
          {"time", {{"step", 0.02}, {"end", 0.4}}}};
}

Json sleigh(const Json& method) {
  return {
      {"system",
       {{"type", "lagrangian"},
        {"parameters", {{"m", 3.0}, {"I", 0.5}, {"a", 0.2}, {"w0", 2.0}}},
        {"coordinates", {"x", "y", "theta"}},
        {"lagrangian",
         "m*((x' - a*sin(theta)*theta')^2 + (y' + a*cos(theta)*theta')^2)/2 + I*theta'^2/2"},
        {"nonholonomic", "sin(theta)*x' - cos(theta)*y'"}}},
      {"initial", {{"x", 0.1}, {"y", 0}, {"theta", 0}, {"x'", 0.3}, {"y'", 0}, {"theta'", "w0"}}},
      {"method", method},
      {"time", {{"step", 0.02}, {"end", 0.4}}}};
}

}  // namespace

// The midpoint rule turns (√(mk) q, p) by θ a step, tan(θ/2) = h √(k/m)/2.
BOOST_AUTO_TEST_CASE(derivatives_of_a_linear_run_are_those_of_its_closed_form) {
  Json document = oscillator();
  document["sensitivities"] = {{"by", {"k", "q"}}, {"of", {"q", "H"}}};
  const RunInMemory run = run_of(document);
  const double m = 0.7, k = 2.3, h = 0.1, q0 = 0.8, p0 = 0.1;
  const double w = std::sqrt(k / m), r = std::sqrt(m * k), dw = w / (2.0 * k), dr = r / (2.0 * k);
  const double turn = 2.0 * std::atan(0.5 * w * h), dturn = h * dw / (1.0 + 0.25 * w * w * h * h);
  for (const std::size_t n : {0UL, 1UL, 20UL, 37UL}) {
    const double a = static_cast<double>(n) * turn, da = static_cast<double>(n) * dturn;
    const double by_k =
        -q0 * std::sin(a) * da + p0 * (std::cos(a) * da / r - std::sin(a) * dr / (r * r));
    BOOST_TEST(std::abs(run.rows.column("d(q)/d(k)")[n] - by_k) < 1e-12);
    BOOST_TEST(std::abs(run.rows.column("d(q)/d(q)")[n] - std::cos(a)) < 1e-12);
    // H is that of the start.
    BOOST_TEST(std::abs(run.rows.column("d(H)/d(q)")[n] - k * q0) < 1e-12);
    BOOST_TEST(std::abs(run.rows.column("d(H)/d(k)")[n] - q0 * q0 / 2.0) < 1e-12);
  }
  const Json& told = run.outcome.summary.sensitivities;
  BOOST_TEST(told["final"]["q"]["k"] == run.rows.column("d(q)/d(k)").back());
  BOOST_TEST(read_run_summary(to_json(run.outcome.summary)).sensitivities == told);
}

// By Methods 1 and 2, projections, compositions: through constraints that the length moves, and through what is typed
// for the start.
BOOST_AUTO_TEST_CASE(derivatives_are_those_of_whole_runs_through_constraints) {
  const std::vector<Typed> by = {{"L", "/system/parameters/L"},
                                 {"m", "/system/parameters/m"},
                                 {"g", "/system/parameters/g"},
                                 {"a", "/system/parameters/a"}};
  const std::vector<std::string> of = {"x", "y", "p_x", "H", "height", "speed"};
  for (const Json& method :
       {Json{{"type", "constrain-first"}}, Json{{"type", "constrain-first"}, {"order", 4}},
        Json{{"type", "constrain-first"},
             {"projector", {{"type", "orthogonal"}, {"metric", "euclidean"}}}},
        Json{{"type", "rk4"}}, Json{{"type", "dopri5"}}})
    compare_with_runs(pendulum(method), by, of, 1e-9, method.dump());
}

BOOST_AUTO_TEST_CASE(derivatives_are_those_of_whole_runs_of_method_1_with_constraints) {
  Json document = pendulum({{"type", "discretize-first"}});
  document["time"] = {{"step", 0.02}, {"end", 0.2}};
  compare_with_runs(document, {{"L", "/system/parameters/L"}, {"a", "/system/parameters/a"}},
                    {"x", "y", "H"}, 1e-8, "discretize-first");
}

BOOST_AUTO_TEST_CASE(derivatives_are_those_of_whole_nonholonomic_runs) {
  const std::vector<Typed> by = {{"a", "/system/parameters/a"},
                                 {"I", "/system/parameters/I"},
                                 {"w0", "/system/parameters/w0"},
                                 {"x", "/initial/x"},
                                 {"x'", "/initial/x'"}};
  for (const Json& method : {Json{{"type", "constrain-first"}}, Json{{"type", "rk4"}},
                             Json{{"type", "constrain-first"}, {"projector", "momentum"}}})
    compare_with_runs(sleigh(method), by, {"x", "y", "theta", "H"}, 1e-9, method.dump());
}

BOOST_AUTO_TEST_CASE(derivatives_are_those_of_whole_runs_without_constraints) {
  const std::vector<Typed> by = {{"k", "/system/parameters/k"},
                                 {"m", "/system/parameters/m"},
                                 {"q", "/initial/q"},
                                 {"p_q", "/initial/p_q"}};
  Json quartic = oscillator();
  quartic["system"]["hamiltonian"] = "p_q^2/(2*m) + k*q^4/4 + sin(q)/m";
  for (const Json& method :
       {Json{{"type", "discretize-first"}, {"discretization", "verlet"}},
        Json{{"type", "discretize-first"}, {"discretization", "verlet"}, {"order", 4}},
        Json{{"type", "discrete-gradient"}}, Json{{"type", "discretize-first"}, {"order", 6}},
        Json{{"type", "constrain-first"}}, Json{{"type", "rkf78"}},
        Json{{"type", "discretize-first"}, {"damping", "l-stable"}}}) {
    quartic["method"] = method;
    compare_with_runs(quartic, by, {"q", "p_q", "H"}, 1e-9, method.dump());
  }
}

// x is given and moves, y follows on the circle, and the velocity that is given stays.
BOOST_AUTO_TEST_CASE(what_is_not_given_follows_the_constraints) {
  Json document = pendulum("constrain-first");
  document["initial"] = {{"x", 0.5}, {"y", -1.2}, {"x'", 0.3}};
  document["sensitivities"] = {{"by", {"x", "x'", "L"}}, {"of", {"x", "y", "p_x", "p_y"}}};
  document["hold"] = {"x"};
  const RunInMemory run = run_of(document);
  BOOST_TEST(std::abs(run.rows.column("y").front() + 1.2) < 1e-12);
  // y is given and would stay; the start moves it all the same, since x is held.
  const double x = 0.5, y = -1.2, L = 1.3, m = 0.7, u = 0.3;
  const auto first = [&](const char* name) { return run.rows.column(name).front(); };
  BOOST_TEST(std::abs(first("d(x)/d(x)") - 1.0) < 1e-9);
  BOOST_TEST(std::abs(first("d(y)/d(x)") + x / y) < 1e-9);
  BOOST_TEST(std::abs(first("d(x)/d(L)")) < 1e-9);
  BOOST_TEST(std::abs(first("d(y)/d(L)") - L / y) < 1e-9);
  BOOST_TEST(std::abs(first("d(p_x)/d(x')") - m) < 1e-9);
  BOOST_TEST(std::abs(first("d(p_y)/d(x')") + m * x / y) < 1e-9);
  // p_y = -m x u/y
  BOOST_TEST(std::abs(first("d(p_y)/d(x)") + m * u / y * (1.0 + x * x / (y * y))) < 1e-8);
}

BOOST_AUTO_TEST_CASE(a_step_of_no_time_is_the_start) {
  // Of an array, its elements.
  Json document = {{"system",
                    {{"type", "implicit"},
                     {"parameters", {{"w", {1.0, 2.0}}}},
                     {"coordinates", {"r[2]"}},
                     {"equations", {"r[0]' - w[0]*r[1]", "r[1]' + w[1]*r[0]"}}}},
                   {"initial", {{"r", {1.0, 0.5}}}},
                   {"method", "rk4"},
                   {"sensitivities", {{"by", {"w", "r"}}}},
                   {"time", {{"step", 0.1}, {"end", 1.0}}}};
  const RunInMemory run = run_of(document);
  for (const char* name : {"d(r[0])/d(w[0])", "d(r[1])/d(w[1])", "d(r[0])/d(r[1])"})
    BOOST_TEST(run.rows.column(name).size() == 11u);
  BOOST_TEST(run.rows.column("d(r[0])/d(r[0])").front() == 1.0);
  document.erase("sensitivities");
  compare_with_runs(document,
                    {{"w[0]", "/system/parameters/w/0"}, {"w[1]", "/system/parameters/w/1"}},
                    {"r[0]", "r[1]"}, 1e-10, "array");
}

BOOST_AUTO_TEST_CASE(a_run_that_goes_on_has_the_same_derivatives) {
  Json document = pendulum({{"type", "constrain-first"}, {"order", 4}});
  document["sensitivities"] = {{"by", {"L", "g"}}, {"of", {"x", "speed"}}, {"lyapunov", true}};
  document["output"] = {{"epoch", 5}};
  check_resumption(document, {7, 16}, "csv");
  document["output"]["format"] = "npy";
  check_resumption(document, {7}, "npy");
}

// H = (p² - ω² q²)/2: the midpoint rule stretches by (1 ± hω/2)/(1 ∓ hω/2) a step.
BOOST_AUTO_TEST_CASE(exponents_of_a_saddle_are_those_of_its_factors) {
  Json document = oscillator();
  document["system"]["hamiltonian"] = "(p_q^2 - 2.89*q^2)/2 + 0*k*m";
  document["initial"] = {{"q", 1e-3}, {"p_q", -1.7e-3}};
  document["sensitivities"] = {{"lyapunov", true}};
  document["time"] = {{"step", 0.1}, {"end", 40}};
  const RunInMemory run = run_of(document);
  const Json& rates = run.outcome.summary.sensitivities["lyapunov_exponents"];
  const double exact = std::log((1.0 + 0.085) / (1.0 - 0.085)) / 0.1;
  BOOST_TEST_REQUIRE(rates.size() == 2u);
  BOOST_TEST(std::abs(rates[0].get<double>() - exact) < 1.0 / 40.0);
  BOOST_TEST(std::abs(rates[0].get<double>() + rates[1].get<double>()) < 1e-12);
}

// At the row of an event the time is that of the event and does not move.
BOOST_AUTO_TEST_CASE(an_event_that_ends_a_run_has_the_derivatives_up_to_there) {
  Json document = oscillator();
  document["events"] = {{"turn", {{"zero", "p_q"}, {"stop", true}}}};
  document["sensitivities"] = {{"by", {"q"}}, {"of", {"q", "H"}}};
  const RunInMemory run = run_of(document);
  BOOST_TEST(run.rows.rows() < 38u);
  const double k = 2.3;
  // H of the whole steps is kept; of a part, to the order of the method.
  BOOST_TEST(std::abs(run.rows.column("d(H)/d(q)").back() - k * 0.8) < 1e-2);
  BOOST_TEST(run.outcome.summary.sensitivities["final"]["q"]["q"] ==
             run.rows.column("d(q)/d(q)").back());
}

BOOST_AUTO_TEST_CASE(what_cannot_be_varied_is_refused_with_its_place) {
  const auto with = [](Json document, const Json& by, const Json& of = Json::array()) {
    document["sensitivities"] = {{"by", by}};
    if (!of.empty()) document["sensitivities"]["of"] = of;
    return document;
  };
  test_refusal(with(oscillator(), {"kk"}), "/sensitivities/by/0: unknown name \"kk\"");
  test_refusal(with(oscillator(), {"k", "k"}), "/sensitivities/by/1: has k, which is there twice");
  test_refusal(with(oscillator(), {"k"}, {"E"}), "/sensitivities/of/0: \"E\" is no quantity");
  test_refusal(with(oscillator(), Json::array()), "/sensitivities: asks for nothing");
  // Not given.
  test_refusal(with(sleigh("constrain-first"), {"p_x"}),
               "/sensitivities/by/0: the initial value of p_x");
  // The times of the steps.
  Json timed = oscillator();
  timed["time"] = {{"step", "m/7"}, {"end", "37*m/7"}};
  test_refusal(with(timed, {"m"}), "/sensitivities/by/0: m cannot be varied: the times");
  // A number of coordinates.
  Json sized = {{"system",
                 {{"type", "implicit"},
                  {"parameters", {{"n", 2}}},
                  {"coordinates", {"r[n]"}},
                  {"equations", {"r[0]'", "r[1]' + n*r[0]"}}}},
                {"initial", {{"r", {1.0, 0.5}}}},
                {"method", "rk4"},
                {"time", {{"step", 0.1}, {"end", 1.0}}}};
  test_refusal(with(sized, {"n"}), "/sensitivities/by/0: n cannot be varied");
  // A number at the edge of what initial values are defined for.
  Json edge = oscillator();
  edge["system"]["parameters"]["ecc"] = 0.999;
  edge["initial"]["q"] = "sqrt(1 - ecc)";
  test_refusal(with(edge, {"ecc"}),
               "/sensitivities/by/0: ecc cannot be varied: the experiment is none with");
  // A method without differential.
  Json rattle = pendulum({{"type", "constrain-first"}, {"discretization", "verlet"}});
  test_refusal(with(rattle, {"x"}), "do not know their differential");
  // Held, and fixed by what is held beside it.
  Json held = pendulum("constrain-first");
  held["hold"] = {"x", "y"};
  test_refusal(with(held, {"x"}),
               "/sensitivities/by/0: x cannot be varied: what is held beside it");
  // A number that is one of the space.
  Json boundary = oscillator();
  boundary["boundary"] = {{"final", {{"q", 0}}}};
  test_refusal(with(boundary, {"k"}), "/sensitivities: are those of a run from initial values");
  Json transformed = oscillator();
  transformed["time"]["transformation"] = "1 + q^2";
  test_refusal(with(transformed, {"k"}), "/sensitivities: are those of steps");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
