#include "courant/running/sensitivities_of_run.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../reading/experiment_problems.hpp"
#include "courant/running/c_program.hpp"
#include "courant/running/run_in_memory.hpp"
#include "problems.hpp"
#include "resumed_run.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the constraint set stands still while a parameter moves it
//  * a definition's rate, an energy that is differentiated or a metric forgets the parameter
//    (core/expressions/graph_parameters.cpp, reading/vocabulary.cpp)
//  * a parameter that is made of another one stays as it is (reading/vocabulary.cpp)
//  * initial values do not change with a parameter that they are made of
//  * given velocities change as momenta do not
//  * columns stand in each other's places
//  * the step does not tell its parts, in compositions
//  * a resumed run begins its directions anew
//  * a parameter that is no variable of the equations is not found out
BOOST_AUTO_TEST_SUITE(sensitivities_of_run_test)

namespace {

std::vector<double> column(const RunInMemory& run, const std::string& name) {
  return run.rows.column(name);
}

RunInMemory run_of(const Json& experiment) {
  RunInMemoryOptions options;
  options.run.backend = Backend::interpreter;
  return run_in_memory(read_experiment(experiment.dump()), options);
}

Json oscillator(const Json& method, double h, double end) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"parameters", {{"m", 0.7}, {"k", 3.1}}},
            {"coordinates", {"q"}},
            {"hamiltonian", "p_q^2/(2*m) + k*q^2/2"}}},
          {"initial", {{"q", 0.9}, {"p_q", 0}}},
          {"method", method},
          {"time", {{"step", h}, {"end", end}}},
          {"sensitivities", {{"by", {"k", "m", "q"}}, {"of", {"q", "p_q", "H"}}}}};
}

// A number in the document and how the columns call it.
struct Value {
  const char* pointer;
  const char* name;
};

// The largest distance of the columns from differences of order 8 of runs with other values, next to their size.
double distance_from_differences(const Json& experiment, const Value& value,
                                 const std::vector<std::string>& of, double part) {
  constexpr std::array weights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  const Json::json_pointer at{std::string(value.pointer)};
  const double size = part * std::abs(experiment[at].get<double>());
  const auto end = [&](double change) {
    Json changed = experiment;
    changed.erase("sensitivities");
    changed[at] = experiment[at].get<double>() + change;
    const RunInMemory run = run_of(changed);
    VectorXd last(std::ssize(of));
    for (Index i = 0; i < last.size(); ++i)
      last[i] = column(run, of[static_cast<std::size_t>(i)]).back();
    return last;
  };
  VectorXd measured = VectorXd::Zero(std::ssize(of));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double change = static_cast<double>(i + 1) * size;
    measured += weights[i] / size * (end(change) - end(-change));
  }
  Json asked = experiment;
  const std::string name = value.name;
  const bool is_initial = name.ends_with("(0)");
  asked["sensitivities"] = {{"by", {is_initial ? name.substr(0, name.size() - 3) : name}},
                            {"of", of}};
  const RunInMemory run = run_of(asked);
  VectorXd found(measured.size());
  for (Index i = 0; i < found.size(); ++i)
    found[i] = column(run, "d" + of[static_cast<std::size_t>(i)] + "/d" + name).back();
  BOOST_TEST(found.norm() > 1e-3);  // something depends on it
  return (found - measured).norm() / (1.0 + measured.norm());
}

void check_differences(const std::string& what, const Json& experiment,
                       const std::vector<Value>& values, const std::vector<std::string>& of,
                       double bound = 1e-9) {
  for (const Value& value : values)
    for (const double part : {0.02, 0.01}) {
      const double distance = distance_from_differences(experiment, value, of, part);
      BOOST_TEST(distance < bound, what << ", " << value.name << ", " << part << ": " << distance);
    }
}

Json with_method(Json experiment, const Json& method) {
  experiment["method"] = method;
  return experiment;
}

// A pendulum on a rod of length l, held by x² + y² = l²; where it is let go depends on l.
Json pendulum() {
  return {{"system",
           {{"type", "mechanical"},
            {"parameters", {{"m", 0.7}, {"l", 1.3}, {"g", 9.81}, {"w", "sqrt(g/l)"}}},
            {"coordinates", {"x", "y"}},
            {"metric", {{"m", 0}, {0, "2*m"}}},
            {"potential", "m*w^2*l*y"},
            {"holonomic", {"x^2 + y^2 - l^2"}}}},
          {"initial", {{"x", "l*sin(0.4)"}, {"y", "-l*cos(0.4)"}, {"x'", 0.5}}},
          {"method", "constrain-first"},
          {"time", {{"step", 0.05}, {"end", 0.6}}}};
}

// A skate on a slope, with a nonholonomic constraint.
Json skate() {
  return {{"system",
           {{"type", "mechanical"},
            {"parameters", {{"m", 1.4}, {"J", 0.3}, {"s", 2.0}}},
            {"coordinates", {"x", "y", "a"}},
            {"metric", {{"m", 0, 0}, {0, "m", 0}, {0, 0, "J"}}},
            {"potential", "s*x*(1 + 0.1*y^2)"},
            {"nonholonomic", {"sin(a)*x' - cos(a)*y'"}}}},
          {"initial", {{"x", 0.2}, {"y", 0.1}, {"a", 0.3}, {"x'", 0.4}, {"a'", 1.1}}},
          {"method", "constrain-first"},
          {"time", {{"step", 0.05}, {"end", 0.5}}}};
}

Json ball_on_a_sphere() {
  return {{"system",
           {{"type", "lagrangian"},
            {"parameters", {{"m", 1.7}, {"g", 4.2}}},
            {"manifold", {{"type", "sphere"}}},
            {"coordinates", {"r[3]"}},
            {"lagrangian", "m*dot(r', r')/2 - g*r[2] - r[0]^2"}}},
          {"initial", {{"r", {0.6, 0, 0.8}}, {"r'", {0, 0.7, 0}}}},
          {"method", "discretize-first"},
          {"time", {{"step", 0.05}, {"end", 0.5}}}};
}

Json damped() {
  return {{"system",
           {{"type", "port-hamiltonian"},
            {"parameters", {{"k", 2.0}, {"c", 0.3}, {"b", 1.2}}},
            {"coordinates", {"q", "p"}},
            {"J", {{0, 1}, {-1, 0}}},
            {"R", {{0, 0}, {0, "c"}}},
            {"hamiltonian", "p^2/2 + k*q^2/2 + b*q^4/4"}}},
          {"initial", {{"q", 0.8}, {"p", 0.1}}},
          {"method", "discrete-gradient"},
          {"time", {{"step", 0.05}, {"end", 1}}}};
}

std::string refusal(const Json& experiment) {
  try {
    run_of(experiment);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

// The midpoint rule turns (√(km) q, p) by θ with tan(θ/2) = ωh/2, ω² = k/m.
BOOST_AUTO_TEST_CASE(of_an_oscillator_they_are_those_of_the_closed_form) {
  const double m = 0.7, k = 3.1, q = 0.9, h = 0.1, w = std::sqrt(k / m);
  const RunInMemory run = run_of(oscillator("discretize-first", h, 20));
  const double theta = 2.0 * std::atan(0.5 * w * h), turn = h / (1.0 + 0.25 * w * w * h * h);
  BOOST_TEST(run.rows.rows() == 201u);
  for (std::size_t i = 0; i < run.rows.rows(); ++i) {
    const double n = static_cast<double>(i), s = std::sin(n * theta), c = std::cos(n * theta);
    const auto at = [&](const char* name) { return column(run, name)[i]; };
    BOOST_TEST(std::abs(at("q") - q * c) < 1e-12);
    BOOST_TEST(std::abs(at("dq/dk") + q * n * s * turn * w / (2.0 * k)) < 1e-11);
    BOOST_TEST(std::abs(at("dq/dm") - q * n * s * turn * w / (2.0 * m)) < 1e-11);
    BOOST_TEST(std::abs(at("dq/dq(0)") - c) < 1e-12);
    BOOST_TEST(std::abs(at("dp_q/dq(0)") + m * w * s) < 1e-12);
    BOOST_TEST(std::abs(at("dH/dk") - q * q / 2.0) < 1e-12);
    BOOST_TEST(std::abs(at("dH/dm")) < 1e-12);
    BOOST_TEST(std::abs(at("dH/dq(0)") - k * q) < 1e-12);
  }
  // The rows are those of a run without sensitivities.
  Json plain = oscillator("discretize-first", h, 20);
  plain.erase("sensitivities");
  BOOST_TEST((column(run_of(plain), "q") == column(run, "q")));
}

BOOST_AUTO_TEST_CASE(methods_without_constraints_agree_with_differences) {
  const std::vector<std::string> of = {"q", "p_q"};
  const std::vector<Value> by = {
      {"/system/parameters/k", "k"}, {"/system/parameters/m", "m"}, {"/initial/q", "q(0)"}};
  for (const Json& method : std::initializer_list<Json>{
           "rk4", "dopri5", Json{{"type", "discretize-first"}, {"order", 4}},
           Json{{"type", "discretize-first"}, {"damping", "l-stable"}},
           Json{{"type", "discretize-first"}, {"discretization", "verlet"}},
           Json{{"type", "discretize-first"}, {"discretization", "verlet"}, {"order", 4}},
           "discrete-gradient",
           Json{{"type", "discretize-first"},
                {"discretization", {{"type", "theta"}, {"theta", 0.3}}}}}) {
    Json experiment = oscillator(method, 0.05, 1);
    experiment["system"]["hamiltonian"] = "p_q^2/(2*m) - k*cos(q)";
    check_differences(method.dump(), experiment, by, of);
  }
}

BOOST_AUTO_TEST_CASE(constraints_that_a_parameter_moves_agree_with_differences) {
  const std::vector<std::string> of = {"x", "y", "p_x", "H"};
  const std::vector<Value> by = {
      {"/system/parameters/l", "l"}, {"/system/parameters/m", "m"}, {"/system/parameters/g", "g"}};
  check_differences("pendulum", pendulum(), by, of);
  check_differences("pendulum, order 4",
                    with_method(pendulum(), {{"type", "constrain-first"}, {"order", 4}}), by, of);
}

BOOST_AUTO_TEST_CASE(nonholonomic_steps_agree_with_differences) {
  const std::vector<std::string> of = {"x", "y", "a", "H"};
  const std::vector<Value> by = {{"/system/parameters/m", "m"},
                                 {"/system/parameters/J", "J"},
                                 {"/system/parameters/s", "s"},
                                 {"/initial/a", "a(0)"}};
  check_differences("Method 2", skate(), by, of);
  check_differences("Method 1", with_method(skate(), "discretize-first"), by, of);
}

BOOST_AUTO_TEST_CASE(spheres_and_discrete_gradients_agree_with_differences) {
  check_differences("sphere", ball_on_a_sphere(),
                    {{"/system/parameters/m", "m"}, {"/system/parameters/g", "g"}},
                    {"r[0]", "r[2]", "H"});
  check_differences("damped", damped(),
                    {{"/system/parameters/k", "k"},
                     {"/system/parameters/c", "c"},
                     {"/system/parameters/b", "b"},
                     {"/initial/p", "p(0)"}},
                    {"q", "p", "H"});
}

// Observables, through velocities and definitions too.
BOOST_AUTO_TEST_CASE(observables_are_differentiated_with_their_own_parameters) {
  Json experiment = pendulum();
  experiment["system"]["definitions"] = {{"height", "y + l"}};
  experiment["observe"] = {{"speed", "x'^2 + y'^2"}, {"fall", "height'"}, {"weight", "m*g*height"}};
  check_differences("observables", experiment, {{"/system/parameters/l", "l"}},
                    {"speed", "fall", "weight"});
}

// {"w": "sqrt(g/l)"} moves with g; by itself it is another number.
BOOST_AUTO_TEST_CASE(a_parameter_that_is_made_of_others_moves_with_them) {
  Json experiment = pendulum();
  experiment["sensitivities"] = {{"by", {"w", "g"}}, {"of", {"H"}}};
  const RunInMemory run = run_of(experiment);
  // H = T + m w² l y at a start with y = -l cos 0.4.
  const double m = 0.7, l = 1.3, w = std::sqrt(9.81 / l), y = -l * std::cos(0.4);
  BOOST_TEST(std::abs(column(run, "dH/dw")[0] - 2.0 * m * w * l * y) < 1e-12);
  BOOST_TEST(std::abs(column(run, "dH/dg")[0] - m * y) < 1e-12);
}

// By an initial value that constraints tie to others, along M_f: y moves with x.
BOOST_AUTO_TEST_CASE(initial_values_move_along_the_constraints) {
  Json experiment = pendulum();
  const double x = 0.5, l = 1.3, y = -std::sqrt(l * l - x * x);
  experiment["initial"] = {{"x", x}, {"x'", 0.5}};
  experiment["initial"]["y"] = y;
  experiment["sensitivities"] = {{"by", {"x"}}, {"of", {"x", "y"}}};
  const RunInMemory both = run_of(experiment);
  // Both are given: (1, 0) comes as near as it can, (y², -xy)/l².
  BOOST_TEST(std::abs(column(both, "dx/dx(0)")[0] - y * y / (l * l)) < 1e-12);
  BOOST_TEST(std::abs(column(both, "dy/dx(0)")[0] + x * y / (l * l)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(arrays_stand_for_their_entries) {
  Json experiment = ball_on_a_sphere();
  experiment["system"]["parameters"] = {{"k", {1.7, 4.2}}};
  experiment["system"]["lagrangian"] = "k[0]*dot(r', r')/2 - k[1]*r[2] - r[0]^2";
  experiment["sensitivities"] = {{"by", {"k"}}, {"of", {"r"}}};
  const RunInMemory run = run_of(experiment);
  const RunInMemory other = [&] {
    Json single = ball_on_a_sphere();
    single["sensitivities"] = {{"by", {"g"}}, {"of", {"r[1]"}}};
    return run_of(single);
  }();
  BOOST_TEST(std::abs(column(run, "dr[1]/dk[1]").back() - column(other, "dr[1]/dg").back()) <
             1e-12);
}

// Kepler's problem has the scale x(t; s μ, x₀, √s v₀) = x(√s t; μ, x₀, v₀):
// μ ∂x/∂μ + ½ v₀ ∂x/∂v₀ = ½ t x'.
BOOST_AUTO_TEST_CASE(keplers_scale_ties_derivatives_together) {
  std::vector<double> steps, defects;
  for (const double count : {40.0, 80.0, 160.0}) {
    const Json experiment = {{"system",
                              {{"type", "hamiltonian"},
                               {"parameters", {{"mu", 1.3}}},
                               {"coordinates", {"x", "y"}},
                               {"hamiltonian", "(p_x^2 + p_y^2)/2 - mu/sqrt(x^2 + y^2)"}}},
                             {"initial", {{"x", 1}, {"y", 0.1}, {"p_x", 0.2}, {"p_y", 1}}},
                             {"method", {{"type", "discretize-first"}, {"order", 4}}},
                             {"time", {{"step", 3.0 / count}, {"end", 3}}},
                             {"sensitivities", {{"by", {"mu", "p_x", "p_y"}}, {"of", {"x", "H"}}}}};
    const RunInMemory run = run_of(experiment);
    const auto end = [&](const char* name) { return column(run, name).back(); };
    const double left = 1.3 * end("dx/dmu") + 0.5 * (0.2 * end("dx/dp_x(0)") + end("dx/dp_y(0)"));
    steps.push_back(3.0 / count);
    defects.push_back(std::abs(left - 0.5 * 3.0 * end("p_x")));
  }
  BOOST_TEST(defects.back() < 1e-5);
  BOOST_TEST(std::abs(log_log_slope(steps, defects, 1e-12) - 4.0) < 0.3);
}

BOOST_AUTO_TEST_CASE(runs_that_are_resumed_go_on_with_their_directions) {
  Json experiment = oscillator({{"type", "discretize-first"}, {"order", 4}}, 0.05, 1);
  experiment["output"] = {{"epoch", 5}, {"at", {0.33}}};
  experiment["events"] = {{"turn", "p_q"}};
  check_resumption(experiment, {7, 13}, "sensitivities");
}

BOOST_AUTO_TEST_CASE(what_cannot_be_differentiated_is_refused_with_its_place) {
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const Json good = oscillator("discretize-first", 0.1, 1);
  const auto changed = [&](const char* pointer, const Json& value) {
    Json experiment = good;
    experiment[Json::json_pointer(pointer)] = value;
    return experiment;
  };
  BOOST_TEST(contains(problems(changed("/sensitivities/by", {"kk"})),
                      "/sensitivities/by/0: is \"kk\" (did you mean \"k\"?)"));
  BOOST_TEST(contains(problems(changed("/sensitivities/of", {"E"})), "/sensitivities/of/0: is"));
  BOOST_TEST(contains(problems(changed("/sensitivities/of", Json::array())), "/sensitivities/of"));
  BOOST_TEST(contains(problems(changed("/sensitivities/by", {"k", "k"})), "once"));
  BOOST_TEST(contains(problems(changed("/sensitivities/so", 1)), "/sensitivities/so"));
  Json none = good;
  none.erase("method");
  none.erase("time");
  BOOST_TEST(contains(problems(none), "need a trajectory"));
  // Times that move.
  Json moving = good;
  moving["time"] = {{"step", "0.1*k/3.1"}, {"end", "1*k/3.1"}};
  BOOST_TEST(contains(refusal(moving), "/time/step depends on"));
  // A method without a differential, and one that is for time.
  Json constrained = pendulum();
  constrained["sensitivities"] = {{"by", {"l"}}, {"of", {"x"}}};
  constrained["method"] = {{"type", "constrain-first"}, {"discretization", "verlet"}};
  BOOST_TEST(contains(refusal(constrained), "/sensitivities: need a method that knows"));
  // An initial value that is not given.
  Json free = pendulum();
  free["initial"].erase("y");
  free["sensitivities"] = {{"by", {"y"}}, {"of", {"x"}}};
  BOOST_TEST(contains(problems(free), "/initial does not give"));
  // Programs in C.
  BOOST_CHECK_THROW(c_program(read_experiment(good.dump())), ExperimentError);
}

// What is a number before equations are traced has no slope in them: the first step tells. And so is a bound of a sum.
BOOST_AUTO_TEST_CASE(a_parameter_that_equations_do_not_see_is_found_out) {
  Json vortices = test::experiment_file("point_vortices");
  for (const char* key : {"expect", "events", "observe", "output"}) vortices.erase(key);
  vortices["sensitivities"] = {{"by", {"strengths[0]"}}, {"of", {"x[0]"}}};
  const std::string text = refusal(vortices);
  BOOST_TEST(text.find("is \"strengths[0]\", by which the first step changes") != std::string::npos,
             text);
  Json sum = oscillator("discretize-first", 0.1, 1);
  sum["system"]["parameters"]["n"] = 2;
  sum["system"]["hamiltonian"] = "p_q^2/(2*m) + sum(i, 1, n, k*q^2/2)";
  sum["sensitivities"]["by"] = {"n"};
  BOOST_TEST(!refusal(sum).empty());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
