#include "courant/running/tangent_of_run.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../reading/experiment_problems.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/running/c_program.hpp"
#include "courant/running/run_files.hpp"
#include "problems.hpp"
#include "resumed_run.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * at rest or on an axis, coordinates that are constant on the constraint set are equations
//    (integrators/methods/constrain_first_differential.cpp)
//  * equations whose coefficients vary are chosen as readily as others
//    (integrators/step/vector_field.cpp)
//  * the tangent map does not go on with the steps (running/observer.cpp)
//  * the defects stand in each other's columns (running/observer.cpp)
//  * a resumed run begins its tangent map anew (running/observer.cpp)
//  * composed steps have no parts where defects are asked for (running/runner.cpp)
//  * rows between steps have no defects (running/observer_elsewhere.cpp)
//  * constraints are not looked at
//  * gauge freedom is found out at the first step, in other words
//  * a defect that is not defined is not refused
//  * momenta that follow from positions stop a run with defects
BOOST_AUTO_TEST_SUITE(tangent_of_run_test)

namespace {

using Values = std::vector<double>;

const Json both = {"symplecticity", "volume"};

Json pendulum(const Json& method, double step, double end) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"parameters", {{"m", 0.7}, {"g", 3.1}}},
            {"coordinates", {"q"}},
            {"hamiltonian", "p_q^2/(2*m) - m*g*cos(q)"}}},
          {"initial", {{"q", 1.9}, {"p_q", 0}}},
          {"method", method},
          {"time", {{"step", step}, {"end", end}}},
          {"defects", both}};
}

// m x'' + c x' + k x = 0 on T*R, where the structure is canonical.
Json damped(const Json& method, double step, double end) {
  return {{"system",
           {{"type", "mechanical"},
            {"parameters", {{"m", 2.0}, {"k", 5.0}, {"c", 0.6}}},
            {"coordinates", {"x"}},
            {"metric", "m"},
            {"potential", "k*x^2/2"},
            {"damping", "c"}}},
          {"initial", {{"x", 0.1}, {"x'", 0}}},
          {"method", method},
          {"time", {{"step", step}, {"end", end}}},
          {"defects", both}};
}

// det of the step of the midpoint rule for this system, of (1 - hA/2)⁻¹ (1 + hA/2) with tr A = -c/m,
// det A = k/m.
double contraction(double h) {
  const double trace = -0.6 / 2.0, determinant = 5.0 / 2.0;
  return (1.0 + 0.5 * h * trace + 0.25 * h * h * determinant) /
         (1.0 - 0.5 * h * trace + 0.25 * h * h * determinant);
}

Json catalogue_entry(const std::string& name, double steps) {
  Json experiment = test::experiment_file(name);
  experiment.erase("expect");
  experiment["time"]["end"] = steps * experiment["time"]["step"].get<double>();
  experiment["output"] = Json::object();
  experiment["defects"] = both;
  return experiment;
}

struct DefectsOfRun {
  explicit DefectsOfRun(const Json& experiment) {
    const TemporaryFolder folder;
    outcome = run_in(folder, experiment);
    BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
    const Run run = read_run(folder / "run");
    const auto column = [&](const std::string& name) {
      const auto values = run.trajectory.column(name);
      return Values(values.begin(), values.end());
    };
    t = column("t");
    if (run.trajectory.contains("symplecticity_defect"))
      symplecticity = column("symplecticity_defect");
    if (run.trajectory.contains("volume_defect")) volume = column("volume_defect");
  }
  RunOutcome outcome;
  Values t, symplecticity, volume;
};

double largest(const Values& values) {
  double found = 0.0;
  for (const double value : values) found = std::max(found, std::abs(value));
  return found;
}

// What a run says that cannot be begun; nothing is written then.
std::string refusal(const Json& experiment) {
  const TemporaryFolder folder;
  try {
    run_in(folder, experiment);
  } catch (const ExperimentError& error) {
    BOOST_TEST(!std::filesystem::exists(folder / "run"));
    BOOST_TEST(error.problems().size() == 1u);
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(symplectic_methods_keep_the_form_over_a_thousand_steps) {
  for (const Json& method :
       {Json("discretize-first"), Json({{"type", "discretize-first"}, {"order", 4}})}) {
    const DefectsOfRun run(pendulum(method, 0.05, 50));
    BOOST_TEST_REQUIRE(run.t.size() == 1001u);
    BOOST_TEST(run.symplecticity.front() == 0.0);
    BOOST_TEST(largest(run.symplecticity) < 1e-10, method);
    BOOST_TEST(largest(run.volume) < 1e-10, method);
    BOOST_TEST(largest(run.symplecticity) > 0.0);  // something was measured
  }
  // On T*S², and a Poisson map, that of a composition, on se(3)*.
  for (const char* name : {"spherical_pendulum", "body_in_fluid"}) {
    const DefectsOfRun run(catalogue_entry(name, 50));
    BOOST_TEST(largest(run.symplecticity) < 1e-10, name);
    BOOST_TEST(largest(run.volume) < 1e-10, name);
    BOOST_TEST(largest(run.symplecticity) > 0.0, name);
  }
}

// Of (p² + q²)/2 the step of RK4 is a polynomial in h A with det = |R(ih)|² = 1 - h⁶/72 + h⁸/576.
BOOST_AUTO_TEST_CASE(the_defect_of_rk4_grows_as_its_closed_form) {
  Json oscillator = pendulum("rk4", 0.5, 20);
  oscillator["system"]["hamiltonian"] = "(p_q^2 + q^2)/2";
  oscillator["expect"] = {{{"state", {{"volume_defect", "(1 - 0.5^6/72 + 0.5^8/576)^(t/0.5) - 1"}}},
                           {"tolerance", 1e-14}},
                          {{"observable", "symplecticity_defect"}, {"min", 0}, {"max", 0.01}}};
  const DefectsOfRun run(oscillator);
  BOOST_TEST(run.outcome.as_expected());
  const double h = 0.5, one = 1.0 - std::pow(h, 6) / 72.0 + std::pow(h, 8) / 576.0;
  for (std::size_t k = 0; k < run.t.size(); ++k) {
    const double exact = std::pow(one, static_cast<double>(k)) - 1.0;
    BOOST_TEST(std::abs(run.volume[k] - exact) < 1e-14);
    // On a plane the form is the area.
    BOOST_TEST(std::abs(run.symplecticity[k] + exact) < 1e-14);
    if (k > 0) BOOST_TEST(run.symplecticity[k] > run.symplecticity[k - 1]);
  }
  const QuantityRecord* told = run.outcome.summary.observable("symplecticity_defect");
  BOOST_REQUIRE(told != nullptr);
  BOOST_TEST(told->max == run.symplecticity.back());
  // A bound that does not hold fails.
  oscillator["expect"] = {{{"observable", "symplecticity_defect"}, {"max", 1e-10}}};
  BOOST_TEST(!DefectsOfRun(oscillator).outcome.as_expected());
}

// At a fixed time that of a nonlinear system has the order of the method, or one more.
BOOST_AUTO_TEST_CASE(the_defect_of_rk4_has_an_order) {
  std::vector<double> steps, defects;
  for (const double count : {40.0, 80.0, 160.0, 320.0}) {
    const DefectsOfRun run(pendulum("rk4", 2.0 / count, 2.0));
    steps.push_back(2.0 / count);
    defects.push_back(run.symplecticity.back());
  }
  const double order = log_log_slope(steps, defects, 1e-13);
  BOOST_TEST(order > 3.85, order);
  BOOST_TEST(order < 5.25, order);
}

BOOST_AUTO_TEST_CASE(damping_contracts_volumes_as_its_closed_form) {
  const double h = 0.2;
  Json experiment = damped("discretize-first", h, 4);
  experiment["output"]["at"] = {0, 0.2, 0.25, 0.4, 1.1, 3.95, 4};
  experiment["events"] = {{"turn", "p_x"}};
  const DefectsOfRun run(experiment);
  BOOST_TEST_REQUIRE(run.t.size() == 7u);
  for (std::size_t i = 0; i < run.t.size(); ++i) {
    const double whole = std::floor(run.t[i] / h + 1e-9), part = run.t[i] - whole * h;
    const double exact = std::pow(contraction(h), whole) * contraction(part);
    BOOST_TEST(std::abs(run.volume[i] + 1.0 - exact) < 1e-13, run.t[i]);
    BOOST_TEST(std::abs(run.symplecticity[i] - (1.0 - exact)) < 1e-13, run.t[i]);
  }
  // The same as equations, for which no structure is known.
  Json equations = experiment;
  equations["system"] = {{"type", "implicit"},
                         {"parameters", {{"m", 2.0}, {"k", 5.0}, {"c", 0.6}}},
                         {"coordinates", {"x", "p_x"}},
                         {"equations", {"m*x' - p_x", "p_x' + k*x + c*x'"}}};
  equations["initial"] = {{"x", 0.1}, {"p_x", 0}};
  equations["defects"] = {"volume"};
  const DefectsOfRun again(equations);
  BOOST_TEST(again.symplecticity.empty());
  BOOST_TEST_REQUIRE(again.volume.size() == 7u);
  for (std::size_t i = 0; i < again.volume.size(); ++i)
    BOOST_TEST(std::abs(again.volume[i] - run.volume[i]) < 1e-13);
}

// The rod as a holonomic constraint: M_f is T*S¹ with the form that is pulled back, a plane.
BOOST_AUTO_TEST_CASE(on_constraint_sets_the_form_is_pulled_back) {
  std::vector<double> steps, defects;
  for (const double h : {0.04, 0.02, 0.01, 0.005}) {
    Json experiment = catalogue_entry("pendulum_holonomic", 1);
    experiment["time"] = {{"step", h}, {"end", 0.6}};
    const DefectsOfRun run(experiment);
    for (std::size_t k = 0; k < run.t.size(); ++k)
      BOOST_TEST(std::abs(run.symplecticity[k] - std::abs(run.volume[k])) < 1e-12);
    steps.push_back(h);
    defects.push_back(run.symplecticity.back());
  }
  const double order = log_log_slope(steps, defects, 1e-13);
  BOOST_TEST(order > 1.85, order);
  BOOST_TEST(order < 3.3, order);
}

BOOST_AUTO_TEST_CASE(a_run_that_was_killed_goes_on_with_the_same_defects) {
  Json experiment = damped({{"type", "discretize-first"}, {"order", 4}}, 0.2, 10);
  experiment["events"] = {{"turn", "p_x"}};
  experiment["output"] = {{"epoch", 16}, {"at", {0, 0.25, 5.01, 10}}};
  check_resumption(experiment, {20, 47}, "order 4, rows between steps");
  Json held = catalogue_entry("pendulum_holonomic", 50);
  held["output"]["epoch"] = 16;
  check_resumption(held, {17, 40}, "on a constraint set");
}

// Only the numbers that are asked for have columns, and nothing else changes.
BOOST_AUTO_TEST_CASE(who_does_not_ask_has_no_columns) {
  Json experiment = pendulum("discretize-first", 0.1, 2);
  const DefectsOfRun with(experiment);
  experiment["defects"] = {"volume"};
  const DefectsOfRun one(experiment);
  BOOST_TEST(one.symplecticity.empty());
  BOOST_TEST((one.volume == with.volume));
  experiment.erase("defects");
  const DefectsOfRun none(experiment);
  BOOST_TEST(none.volume.empty());
  BOOST_TEST((none.outcome.summary.final == with.outcome.summary.final));
}

BOOST_AUTO_TEST_CASE(what_is_no_list_of_defects_is_refused_with_its_place) {
  Json experiment = pendulum("discretize-first", 0.1, 2);
  const auto problem_of = [&](const Json& defects) {
    experiment["defects"] = defects;
    return problems(experiment);
  };
  BOOST_TEST(problem_of(both) == "");
  BOOST_TEST(problem_of(true).find("/defects: is true; expected an array") == 0u, problem_of(true));
  BOOST_TEST(problem_of(Json::array()) ==
             "/defects: is an empty array; expected \"symplecticity\", \"volume\" or both");
  BOOST_TEST(
      problem_of({"volumes"}).find("/defects/0: unknown \"volumes\" (did you mean \"volume\"?)") ==
          0u,
      problem_of({"volumes"}));
  BOOST_TEST(problem_of({"volume", "volume"}) ==
             "/defects/1: is there twice; expected each defect once");
  experiment["system"]["parameters"]["volume_defect"] = 1.0;
  BOOST_TEST(problem_of({"volume"}).find("/defects/0: has the column volume_defect, but") == 0u,
             problem_of({"volume"}));
  experiment["system"]["parameters"].erase("volume_defect");
  experiment["observe"] = {{"volume_defect", "q"}};
  BOOST_TEST(problem_of({"volume"}).find("/observe/volume_defect: key, ") == 0u,
             problem_of({"volume"}));
  BOOST_TEST(problem_of({"symplecticity"}) == "");
  experiment.erase("observe");
  // Names of defects that no column has.
  experiment["expect"] = {{{"observable", "volume_defect"}, {"max", 1}}};
  BOOST_TEST(problem_of({"symplecticity"}).find("/expect/0/observable: ") == 0u,
             problem_of({"symplecticity"}));
  experiment.erase("expect");
  experiment.erase("method");
  experiment.erase("time");
  BOOST_TEST(problem_of(both) == "/defects: need a trajectory; expected \"method\" and \"time\"");
}

BOOST_AUTO_TEST_CASE(runs_without_a_tangent_map_are_refused_in_a_line) {
  Json transformed = pendulum("discretize-first", 0.1, 2);
  transformed["time"]["transformation"] = "1 + q^2";
  BOOST_TEST(
      refusal(transformed).find("does not know the differential of its steps") != std::string::npos,
      refusal(transformed));
  BOOST_TEST(refusal(transformed).find("/defects: ") == 0u);
  const auto gauge = refusal(catalogue_entry("light_ray", 5));
  BOOST_TEST(gauge.find("/defects: are not defined with gauge freedom") == 0u, gauge);
  Json equations = pendulum("discretize-first", 0.1, 2);
  equations["system"] = {
      {"type", "implicit"}, {"coordinates", {"q", "p_q"}}, {"equations", {"q' - p_q", "p_q' + q"}}};
  BOOST_TEST(refusal(equations).find("/defects/0: is not defined at the initial point") == 0u,
             refusal(equations));
  // The set of a nonholonomic system has no form that is regular on it.
  Json particle = catalogue_entry("nonholonomic_particle", 5);
  particle["defects"] = {"volume"};
  BOOST_TEST(refusal(particle).find("/defects/0: is not defined at the initial point") == 0u,
             refusal(particle));
}

BOOST_AUTO_TEST_CASE(programs_in_c_have_no_defects) {
  const Experiment experiment = read_experiment(pendulum("discretize-first", 0.1, 2).dump());
  BOOST_CHECK_EXCEPTION(c_program(experiment), ExperimentError, [](const ExperimentError& error) {
    return std::string(error.what()) ==
           "/defects: are not measured by a program in C; expected an experiment without";
  });
}

// x x' + 1 = 0 by the midpoint rule: x₁² = x₀² - 2h, whose end is no function of its beginning at x₁ = 0.
BOOST_AUTO_TEST_CASE(a_step_without_a_tangent_map_is_said) {
  const auto [experiment, ladder] = test::problem(
      {{"system", {{"type", "implicit"}, {"coordinates", {"x"}}, {"equations", {"x*x' + 1"}}}},
       {"initial", {{"x", 1}}},
       {"method", "discretize-first"},
       {"time", {{"step", 0.1}, {"end", 0.4}}},
       {"defects", {"volume"}}});
  const test::Problem problem{experiment, ladder};
  const auto method = problem.prepare("discretize-first", 0.5);
  Observer observer(experiment, ladder, Backend::interpreter);
  observer.follow(*tangent_of_run(experiment, ladder, method));
  observer.begin(ladder.point);
  Step step{.h = 0.5, .before = ladder.point, .after = ladder.point, .stage = ladder.point};
  step.after.t = 0.5;
  step.after.x[0] = 0.0;
  step.stage.x[0] = 0.5;
  step.stage.v[0] = -2.0;
  BOOST_CHECK_EXCEPTION(observer.advance(step), std::domain_error, [](const std::exception& error) {
    return std::string(error.what())
               .find(
                   "The step to t = 0.5 has no tangent map, which the "
                   "defects are of: ") == 0u;
  });
}

// L = a(x, y) x' - H has α = a dx and moves by X = (∂H/∂y, -∂H/∂x)/∂a/∂y. A step leads from q̄ - θhX(q̄) to
// q̄ + (1-θ)hX(q̄): on the plane dα is kept as far as ∂a/∂y times the area is. Method 2 keeps it for linear α and
// θ = ½ (Proposition 6.3), and neither for another θ (Remark 6.4) nor for another α.
BOOST_AUTO_TEST_CASE(proposition_6_3_in_both_directions) {
  using Eigen::Matrix2d;
  using Eigen::Vector2d;
  struct Case {
    const char* form;
    double (*density)(const Vector2d&);  // ∂a/∂y
    bool is_linear;
  };
  const std::vector<Case> cases = {
      {"0.7*y+0.2*x", [](const Vector2d&) { return 0.7; }, true},
      {"y+y^3/3+x*y", [](const Vector2d& q) { return 1.0 + q[1] * q[1] + q[0]; }, false},
      {"y*exp(x/2)", [](const Vector2d& q) { return std::exp(0.5 * q[0]); }, false},
      {"2*y-cos(x*y)/3", [](const Vector2d& q) { return 2.0 + q[0] * std::sin(q[0] * q[1]) / 3.0; },
       false}};
  constexpr double h = 0.1;
  constexpr long steps = 20;
  const auto slopes = [](const Vector2d& q) {  // of H = x²/2 + y²/2 + x⁴/4
    return Vector2d(q[0] + q[0] * q[0] * q[0], q[1]);
  };
  for (const Case& of : cases)
    for (const double theta : {0.3, 0.5, 0.6}) {
      const auto field = [&](const Vector2d& q) -> Vector2d {
        const Vector2d dH = slopes(q);
        return Vector2d(dH[1], -dH[0]) / of.density(q);
      };
      const auto turned = [&](const Vector2d& q) {
        Matrix2d D;
        for (int j = 0; j < 2; ++j) {
          const Vector2d by = 1e-5 * Vector2d::Unit(j);
          D.col(j) = (field(q + by) - field(q - by)) / 2e-5;
        }
        return D;
      };
      const Vector2d start(0.5, 0.3);
      Vector2d q = start;
      double area = 1.0;
      for (long k = 0; k < steps; ++k) {
        Vector2d middle = q;
        for (int i = 0; i < 100; ++i) middle = q + theta * h * field(middle);
        const Matrix2d D = h * turned(middle), one = Matrix2d::Identity();
        area *= (one + (1.0 - theta) * D).determinant() / (one - theta * D).determinant();
        q = middle + (1.0 - theta) * h * field(middle);
      }
      const double defect = std::abs(of.density(q) / of.density(start) * area - 1.0);
      const DefectsOfRun run(
          {{"system",
            {{"type", "lagrangian"},
             {"coordinates", {"x", "y"}},
             {"lagrangian", "(" + std::string(of.form) + ")*x' - x^2/2 - y^2/2 - x^4/4"}}},
           {"initial", {{"x", start[0]}, {"y", start[1]}}},
           {"method",
            {{"type", "constrain-first"},
             {"projector", "momentum"},
             {"discretization", {{"type", "theta"}, {"theta", theta}}}}},
           {"time", {{"step", h}, {"end", h * static_cast<double>(steps)}}},
           {"defects", {"symplecticity"}}});
      BOOST_TEST_CONTEXT(of.form << ", theta = " << theta) {
        BOOST_TEST_REQUIRE(run.symplecticity.size() == static_cast<std::size_t>(steps + 1));
        BOOST_TEST(std::abs(run.symplecticity.back() - defect) < 1e-8);
        if (of.is_linear && theta == 0.5)
          BOOST_TEST(largest(run.symplecticity) < 1e-12);
        else
          BOOST_TEST(largest(run.symplecticity) > 1e-6);
      }
    }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
