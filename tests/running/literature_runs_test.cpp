// Problems of the literature in the units and from the starts that they are given with, run by the
// methods that apply, against closed forms and the same problem in other units.
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include "problems.hpp"
#include "run_in.hpp"

namespace courant {
namespace {

const Json kRungeKutta = {{"type", "rk4"}};
const Json kMethod1 = {{"type", "discretize-first"}};
const Json kMethod2 = {{"type", "constrain-first"}};

// A pendulum with mass m on a rod of length l, in its Cartesian coordinates, from the horizontal.
test::Problem pendulum(double m, double l) {
  return test::problem({{"system",
                         {{"type", "mechanical"},
                          {"parameters", {{"m", m}, {"l", l}}},
                          {"coordinates", {"x", "y"}},
                          {"metric", "m"},
                          {"potential", "m*9.81*y"},
                          {"holonomic", "x^2 + y^2 - l^2"}}},
                        {"initial", {{"x", l}, {"y", 0}, {"p_x", 0}, {"p_y", 0}}}});
}

// A crane (Blajer, Kołodziejczyk 2004) that carries its load along (X(t), Z(t)) from rest: what the
// equations are solved for at the start does without derivatives that the motion needs.
test::Problem crane() {
  const Json equations = {"s' - vs",
                          "x' - vx",
                          "z' - vz",
                          "l' - vl",
                          "10*vs' - F - T*(x - s)/l",
                          "100*vx' + T*(x - s)/l",
                          "100*vz' - 981 + T*z/l",
                          "10*vl' - T + u",
                          "x - t^4*(1 - t/4)/4",
                          "z - 4 + t^4/10",
                          "l^2 - (x - s)^2 - z^2"};
  return test::problem(
      {{"system",
        {{"type", "implicit"},
         {"coordinates", {"s", "vs", "x", "vx", "z", "vz", "l", "vl"}},
         {"unknowns", {"F", "u", "T"}},
         {"equations", equations}}},
       {"initial",
        {{"s", 0}, {"vs", 0}, {"x", 0}, {"vx", 0}, {"z", 4}, {"vz", 0}, {"l", 4}, {"vl", 0}}}});
}

Json on_a_circle_of_latitude(const Json& point) {
  return {{"system",
           {{"type", "mechanical"},
            {"manifold", "sphere"},
            {"coordinates", {"xi[3]"}},
            {"holonomic", "xi[2] - 0.6"}}},
          {"initial", {{"xi", point}, {"p_xi", {0, 0, 0}}}}};
}

}  // namespace
}  // namespace courant

// Mistakes that these cases have to notice:
//  * unknowns whose coefficients cancel stay in the equations (core/algebra/elimination.cpp)
//  * a shorter step is advised where equations contradict each other
//    (integrators/step/step_solver.cpp)
//  * a constraint takes the place of a velocity of the structure, and is singular elsewhere
//    (integrators/step/vector_field.cpp)
//  * a step back to where it began is no step (integrators/methods/constrain_first_projection.cpp)
//  * the weight of a body at rest tells no unit of time (integrators/step/natural_units.cpp)
//  * components of a vector have units of their own (integrators/step/natural_units.cpp)
//  * slopes count next to the size of the energy (running/observed_quantities.cpp)
//  * a search that found no point in the units of the experiment is a doubt
//    (running/consistent_start.cpp)
//  * what is normal to a sphere has the mass of 1 (structures/generating_family.cpp)
BOOST_AUTO_TEST_SUITE(literature_runs)

using namespace courant;

// l² m and the time √l are the units. Forces of 10⁻⁸ N and derivatives of 10⁹ are solved for together.
BOOST_AUTO_TEST_CASE(a_pendulum_of_a_micrometre) {
  const test::Problem large = pendulum(1.0, 1.0), small = pendulum(1e-9, 1e-6);
  // The metric of a projector may differ, within the method's error.
  for (const auto& [method, bound] : {std::pair{kRungeKutta, 1e-10}, std::pair{kMethod2, 1e-4}}) {
    const VectorXd expected = large.end(method, 0.3, 60), found = small.end(method, 3e-4, 60);
    BOOST_TEST((1e6 * found.head(2) - expected.head(2)).norm() < bound);
    BOOST_TEST((1e12 * found.tail(2) - expected.tail(2)).norm() < bound);
  }
}

// A molecule on a rod of a nanometre, by its momenta of 10⁻³⁰ beside 10⁻⁹.
BOOST_AUTO_TEST_CASE(a_pendulum_of_a_nanometre) {
  const double m = 1e-26, l = 1e-9, T = std::sqrt(l);
  const test::Problem large = pendulum(1.0, 1.0), small = pendulum(m, l);
  for (const auto& [method, bound] : {std::pair{kMethod1, 1e-8}, std::pair{kMethod2, 1e-4}}) {
    const VectorXd expected = large.end(method, 0.6, 120), found = small.end(method, 0.6 * T, 120);
    BOOST_TEST((found.head(2) / l - expected.head(2)).norm() < bound);
    BOOST_TEST((found.tail(2) * T / (m * l) - expected.tail(2)).norm() < 3.0 * bound);
  }
}

// Kepler's problem of an electron and of a planet, with the mass as a metric: 10¹⁸ lies between positions and
// momenta, one way and the other.
BOOST_AUTO_TEST_CASE(orbits_in_si_units) {
  const auto orbit = [](double m, double l, double T) {
    return test::problem({{"system",
                           {{"type", "mechanical"},
                            {"parameters", {{"m", m}, {"k", m * l * l * l / (T * T)}}},
                            {"coordinates", {"x", "y"}},
                            {"metric", "m"},
                            {"potential", "-k/sqrt(x^2 + y^2)"}}},
                          {"initial", {{"x", l}, {"y", 0}, {"p_x", 0}, {"p_y", 1.2 * m * l / T}}}});
  };
  const std::array<double, 3> scales[] = {{9.109e-31, 1e-6, 1e-12}, {5.97e24, 1.496e11, 5e6}};
  for (const Json& method : {kMethod1, kMethod2}) {
    const VectorXd expected = orbit(1.0, 1.0, 1.0).end(method, 5.0, 100);
    for (const auto& [m, l, T] : scales) {
      const VectorXd end = orbit(m, l, T).end(method, 5.0 * T, 100);
      BOOST_TEST_CONTEXT(m << " kg, " << method) {
        BOOST_TEST((end.head(2) / l - expected.head(2)).norm() < 1e-12);
        BOOST_TEST((end.tail(2) * T / (m * l) - expected.tail(2)).norm() < 1e-12);
      }
    }
  }
}

// Molecules from starts with zeros: two atoms on a rigid bond, one of them on a spring; two rotors in a field, by
// angles, from a right angle at rest; a skate. With masses of 10⁻²⁶ kg, lengths of 10⁻¹⁰ m and times of 10⁻¹³ s as
// with 1.
BOOST_AUTO_TEST_CASE(molecules_in_si_units) {
  const auto problem = [](const char* kind, double m, double l, double T) {
    const std::string name = kind;
    Json system = {{"parameters", {{"m", m}, {"l", l}, {"E", m * l * l / (T * T)}}}}, initial;
    const double p = m * l / T;
    if (name == "bond") {
      system["type"] = "mechanical";
      system["coordinates"] = {"x", "y", "u", "v"};
      system["metric"] = {{"m", 0, 0, 0}, {0, "m", 0, 0}, {0, 0, "2*m", 0}, {0, 0, 0, "2*m"}};
      system["potential"] = "E*((x/l)^2 + 2*(y/l)^2)/2 + 0.3*E*(u/l - 1)^2";
      system["holonomic"] = "(x - u)^2 + (y - v)^2 - l^2";
      initial = {{"x", 0},   {"y", 0},         {"u", l},   {"v", 0},
                 {"p_x", 0}, {"p_y", 0.2 * p}, {"p_u", 0}, {"p_v", -0.3 * p}};
    } else if (name == "rotors") {
      system["type"] = "lagrangian";
      system["coordinates"] = {"a", "b"};
      system["lagrangian"] = "m*l^2*(a'^2 + b'^2/2 + a'*b'*cos(a - b)) + E*(2*cos(a) + cos(b))";
      initial = {{"a", "pi/2"}, {"b", 0}, {"p_a", 0}, {"p_b", 0}};
    } else {
      system["type"] = "mechanical";
      system["coordinates"] = {"x", "y", "a"};
      system["metric"] = {{"m", 0, 0}, {0, "m", 0}, {0, 0, "m*l^2"}};
      system["potential"] = "-E*x/(2*l)";
      system["nonholonomic"] = "sin(a)*x' - cos(a)*y'";
      initial = {{"x", 0}, {"y", 0}, {"a", 0}, {"p_x", 0}, {"p_y", 0}, {"p_a", p * l}};
    }
    return test::problem({{"system", system}, {"initial", initial}});
  };
  const double m = 2e-26, l = 1e-10, T = 1e-13;
  for (const auto& [kind, coordinates, length] :
       {std::tuple{"bond", Index{4}, l}, {"rotors", Index{2}, 1.0}, {"skate", Index{2}, l}}) {
    const test::Problem large = problem(kind, 1.0, 1.0, 1.0), small = problem(kind, m, l, T);
    BOOST_TEST((small.ladder.verdict == Verdict::regular));
    // The metric of a projector may differ, within the method's error.
    for (const auto& [method, bound] : {std::pair{kRungeKutta, 1e-12},
                                        {kMethod1, 1e-9},
                                        {kMethod2, std::string(kind) == "skate" ? 1e-2 : 1e-9}}) {
      const VectorXd expected = large.end(method, 2.0, 80), found = small.end(method, 2.0 * T, 80);
      BOOST_TEST_CONTEXT(kind << ", " << method) {
        BOOST_TEST((found.head(coordinates) / length - expected.head(coordinates)).norm() < bound);
      }
    }
  }
}

// On curved spaces, where points have no unit but momenta have: a dipole in a field from a right angle at rest, an
// asymmetric molecule in a field, one that may not turn about an axis of its own, a rotor whose centre is on a spring that drives it, a pendulum by its angle.
BOOST_AUTO_TEST_CASE(curved_molecules_in_si_units) {
  const auto problem = [](const char* kind, double m, double l, double T) {
    const std::string name = kind;
    const double p = m * l * l / T;
    Json system = {{"parameters",
                    {{"I", m * l * l}, {"E", m * l * l / (T * T)}, {"m", m}, {"l", l}}}},
         initial;
    if (name == "dipole") {
      system["type"] = "lagrangian";
      system["manifold"] = "sphere";
      system["coordinates"] = {"q[3]"};
      system["lagrangian"] = "I*dot(q', q')/2 + E*q[2]";
      initial = {{"q", {1, 0, 0}}, {"p_q", {0, 0, 0}}};
    } else if (name == "molecule") {
      system["type"] = "mechanical";
      system["manifold"] = "so3";
      system["coordinates"] = {"R[3][3]"};
      system["metric"] = {"I", "2*I", "2.6*I"};
      system["potential"] = "-E*(R[2][0] + 0.4*R[2][1])";
      initial = {{"R", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {"p_R", {0, 0, 0.7 * p}}};
    } else if (name == "suslov") {
      system["type"] = "mechanical";
      system["manifold"] = "so3";
      system["coordinates"] = {"R[3][3]"};
      system["metric"] = {"I", "2*I", "2.6*I"};
      system["potential"] = "0";
      system["nonholonomic"] = "v_R[0] + 0.5*v_R[2]";
      initial = {{"R", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {"p_R", {-0.5 * p, p, 2.6 * p}}};
    } else if (name == "rotor") {
      system["type"] = "lagrangian";
      system["manifold"] = {{"type", "product"}, {"factors", {"sphere", "euclidean"}}};
      system["coordinates"] = {"q[3]", "x"};
      system["lagrangian"] = "I*dot(q', q')/2 + m*x'^2/2 - E*((x/l)^2/2 - 0.5*x/l*q[2] - 0.2*q[0])";
      initial = {{"q", {0, 1, 0}}, {"x", 0}, {"p_q", {p, 0, 0}}, {"p_x", 0}};
    } else {
      system["type"] = "lagrangian";
      system["manifold"] = "torus";
      system["coordinates"] = {"a"};
      system["lagrangian"] = "I*a'^2/2 + E*cos(a)";
      initial = {{"a", "pi/2"}, {"p_a", 0}};
    }
    return test::problem({{"system", system}, {"initial", initial}});
  };
  const double m = 2e-26, l = 1e-10, T = 1e-13;
  for (const auto& [kind, numbers] : {std::pair{"dipole", Index{3}},
                                      {"molecule", Index{9}},
                                      {"suslov", Index{9}},
                                      {"rotor", Index{3}},
                                      {"pendulum", Index{1}}}) {
    const test::Problem large = problem(kind, 1.0, 1.0, 1.0), small = problem(kind, m, l, T);
    BOOST_TEST((small.ladder.verdict == Verdict::regular));
    for (const Json& method : {kRungeKutta, kMethod1, kMethod2}) {
      const VectorXd expected = large.end(method, 2.0, 80), found = small.end(method, 2.0 * T, 80);
      BOOST_TEST_CONTEXT(kind << ", " << method) {
        BOOST_TEST((expected - large.ladder.point.x).head(numbers).norm() > 0.1);
        BOOST_TEST((found - expected).head(numbers).norm() < 1e-9);
      }
    }
  }
}

// A rotor of 5·10⁵ kg m², whose numbers need no other units, as one of 1. In the stages of Runge-Kutta methods its
// momentum is not quite along the sphere, by more than the sphere is large.
BOOST_AUTO_TEST_CASE(a_heavy_rotor) {
  const auto rotor = [](double I) {
    return test::problem({{"system",
                           {{"type", "mechanical"},
                            {"manifold", "sphere"},
                            {"coordinates", {"q[3]"}},
                            {"parameters", {{"I", I}}},
                            {"metric", "I"},
                            {"potential", "-9.3*I*q[2]"}}},
                          {"initial", {{"q", {1, 0, 0}}, {"p_q", {0, 0, 0}}}}});
  };
  const test::Problem light = rotor(1.0), heavy = rotor(5e5);
  const Json momentum = {{"type", "constrain-first"}, {"projector", "momentum"}};
  for (const Json& method : {kRungeKutta, kMethod1, kMethod2, momentum}) {
    const VectorXd expected = light.end(method, 1.0, 200), found = heavy.end(method, 1.0, 200);
    BOOST_TEST(std::abs(expected[2] - 0.21482) < 1e-4, method);
    BOOST_TEST((found - expected).head(3).norm() < 1e-9, method);
  }
}

// s = X + Z X''/(g - Z'').
BOOST_AUTO_TEST_CASE(a_crane_from_rest) {
  const test::Problem problem = crane();
  const double t = 1.0, Z = 4.0 - 0.1, s = 0.1875 + Z * (3.0 - 1.25) / (9.81 + 1.2);
  for (const Json& method : {kRungeKutta, kMethod2}) {
    const VectorXd end = problem.end(method, t, 50);
    BOOST_TEST(std::fabs(end[0] - s) < 1e-7);
    BOOST_TEST(std::fabs(end[2] - 0.1875) < 1e-7);
  }
  // The velocity of the trolley is a constraint of the motion as well: its rate of change between steps.
  const double h = 1e-3, before = problem.end(kMethod2, t - h, 40)[0],
               after = problem.end(kMethod2, t + h, 40)[0];
  BOOST_TEST(std::fabs(problem.end(kMethod2, t, 40)[1] - (after - before) / (2 * h)) < 1e-5);
}

// At rest nothing tells a unit of time; what is left of a point in its tangent space is no size.
BOOST_AUTO_TEST_CASE(at_rest_on_a_circle_of_latitude) {
  const test::Problem problem = test::problem(on_a_circle_of_latitude({0.8, 0, 0.6}));
  for (const Json& method : {kRungeKutta, kMethod1, kMethod2}) {
    const VectorXd end = problem.end(method, 1.0, 10);
    BOOST_TEST((end - problem.ladder.point.x).norm() < 1e-14);
  }
}

// The circle is farther from the start than a chart of T*S² reaches.
BOOST_AUTO_TEST_CASE(a_start_that_is_charts_away) {
  for (const double angle : {0.0, 1.5}) {
    const ConstraintLadder ladder =
        test::problem(on_a_circle_of_latitude({std::cos(angle), 0, std::sin(angle)})).ladder;
    BOOST_TEST((ladder.verdict == Verdict::regular));
    BOOST_TEST((ladder.point.x.head(3) - Eigen::Vector3d(0.8, 0, 0.6)).norm() < 1e-12);
    BOOST_TEST(!ladder.is_ambiguous());
  }
}

// H is 0 all the time, a sum of terms that cancel: p·f - 1 of time-optimal motion (Zermelo 1931), and of
// the Lagrangian of Faddeev and Jackiw's method. Its round-off is no finding.
BOOST_AUTO_TEST_CASE(round_off_of_an_energy_of_zero_is_not_said) {
  const Json zermelo = {{"system",
                         {{"type", "optimal-control"},
                          {"states", {"x", "y"}},
                          {"controls", {"u"}},
                          {"dynamics", {"cos(u) + y/2", "sin(u)"}},
                          {"cost", 1}}},
                        {"initial", {{"x", 0}, {"y", 0}, {"p_x", 1}, {"p_y", 0}}}};
  const Json first_order = {{"system",
                             {{"type", "lagrangian"},
                              {"coordinates", {"a", "b", "c", "d"}},
                              {"lagrangian", "(b + c)*a' + d*c' + (d^2 - 2*b*c - c^2)/2"}}},
                            {"initial", {{"a", 0}, {"b", 1}, {"c", 0}, {"d", 0}}}};
  for (Json experiment : {zermelo, first_order})
    for (const Json& method : {kRungeKutta, kMethod1, kMethod2})
      for (const double step : {0.01, 0.005}) {
        experiment["method"] = method;
        experiment["time"] = {{"step", step}, {"end", 1}};
        const TemporaryFolder folder;
        const RunOutcome outcome = run_in(folder, experiment);
        BOOST_TEST((outcome.status == RunStatus::completed));
        BOOST_TEST(outcome.summary.warnings.empty());
      }
}

// Kunkel and Mehrmann (2006), Example 3.54: one solution, x₂ of the derivative of the first equation, but
// the matrix of a step of Method 1 is singular whatever the step. What least squares of it leave is no
// solution.
BOOST_AUTO_TEST_CASE(a_singular_step_is_refused) {
  Json experiment = {{"system",
                      {{"type", "implicit"},
                       {"coordinates", {"x1", "x2"}},
                       {"equations", {"x1 - t*x2 - sin(t)", "x1' - t*x2' - cos(2*t)"}}}},
                     {"initial", {{"x1", 0}, {"x2", 0}}},
                     {"time", {{"step", 0.01}, {"end", 1}}}};
  experiment["method"] = kMethod1;
  const TemporaryFolder refused;
  BOOST_TEST((run_in(refused, experiment).status == RunStatus::failed));
  experiment["method"] = kMethod2;
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed));
  // (x₁ - t x₂)' = cos t, so x₂ = cos 2t - cos t.
  const double exact = std::cos(2.0) - std::cos(1.0);
  BOOST_TEST(std::abs(outcome.summary.final[1].second - exact) < 1e-12);
}

// An oscillator with its energy as a third equation: no step of Method 1 obeys all three, however short it
// is, and the message does not advise one. Method 2 keeps to it.
BOOST_AUTO_TEST_CASE(an_oscillator_with_its_energy_as_an_equation) {
  Json oscillator = {{"system",
                      {{"type", "implicit"},
                       {"coordinates", {"q", "p"}},
                       {"equations", {"q' - p", "p' + q", "q^2 + p^2 - 1"}}}},
                     {"initial", {{"q", 1}, {"p", 0}}},
                     {"time", {{"step", 0.01}, {"end", 1}}}};
  oscillator["method"] = kMethod1;
  const TemporaryFolder first;
  const RunOutcome refused = run_in(first, oscillator);
  BOOST_TEST((refused.status == RunStatus::failed));
  BOOST_TEST(refused.message.find("3 equations for 2 unknowns") != std::string::npos);
  BOOST_TEST(refused.message.find("would do") == std::string::npos);
  oscillator["method"] = kMethod2;
  const TemporaryFolder second;
  const RunOutcome right = run_in(second, oscillator);
  BOOST_TEST(std::abs(final_value(right, "q") - std::cos(1.0)) < 1e-4);
}

// z' = y x' given twice, from the origin: x = asinh t, y = t, z = √(1 + t²) - 1. One multiplier is as good
// as two, and what is left of the second is no unknown of a step.
BOOST_AUTO_TEST_CASE(a_nonholonomic_constraint_given_twice) {
  Json particle = {{"system",
                    {{"type", "mechanical"},
                     {"coordinates", {"x", "y", "z"}},
                     {"nonholonomic", {"z' - y*x'", "2*z' - 2*y*x'"}}}},
                   {"initial", {{"x", 0}, {"y", 0}, {"z", 0}, {"x'", 1}, {"y'", 1}}},
                   {"time", {{"step", 0.01}, {"end", 1}}}};
  for (const Json& method : {kMethod1, kMethod2}) {
    particle["method"] = method;
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, particle);
    BOOST_TEST_CONTEXT(method << outcome.message) {
      BOOST_TEST((outcome.status == RunStatus::completed));
      BOOST_TEST(std::abs(final_value(outcome, "x") - std::asinh(1.0)) < 1e-4);
      BOOST_TEST(std::abs(final_value(outcome, "z") - std::sqrt(2.0) + 1.0) < 1e-4);
    }
  }
}

// A satellite of a kilogramme in SI units: p²/2 is small next to GM/r at any random point of such a space.
BOOST_AUTO_TEST_CASE(the_energy_of_a_satellite) {
  const double r = 6.778e6, speed = 9000.0, GM = 3.986e14;
  const Json experiment = {{"system",
                            {{"type", "mechanical"},
                             {"coordinates", {"x", "y"}},
                             {"metric", 1},
                             {"potential", "-3.986e14/sqrt(x^2+y^2)"}}},
                           {"initial", {{"x", r}, {"y", 0}, {"p_x", 0}, {"p_y", speed}}},
                           {"method", kRungeKutta},
                           {"time", {{"step", 10}, {"end", 500}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  const QuantityRecord* const H = outcome.summary.observable("H");
  BOOST_TEST_REQUIRE((H != nullptr));
  const double exact = 0.5 * speed * speed - GM / r;
  BOOST_TEST(std::fabs(H->initial - exact) < 1e-12 * std::fabs(exact));
  BOOST_TEST(std::fabs(H->final - exact) < 1e-8 * std::fabs(exact));
}

// An electron at rest in a Penning trap, and a rigid molecule of water that turns: searches in SI units, where
// numbers are 10²⁰ apart, end without a point, and are no reason to doubt the one that is found in natural units.
BOOST_AUTO_TEST_CASE(starts_in_si_units_are_certain) {
  const test::Problem trap = test::problem(
      {{"system",
        {{"type", "lagrangian"},
         {"parameters",
          {{"m", 9.109e-31}, {"q", -1.602e-19}, {"B", 5.0}, {"U", -10.0}, {"d", 3.5e-3}}},
         {"coordinates", {"x", "y", "z"}},
         {"lagrangian",
          "m*(x'^2 + y'^2 + z'^2)/2 + q*B*(x*y' - y*x')/2 - q*U*(2*z^2 - x^2 - y^2)/(2*d^2)"}}},
       {"initial", {{"x", 1e-5}, {"y", 0}, {"z", 1e-5}, {"x'", 0}, {"y'", 0}, {"z'", 0}}}});
  BOOST_TEST((trap.ladder.verdict == Verdict::regular));
  BOOST_TEST(!trap.ladder.is_ambiguous());
  const double axial = std::sqrt(2.0 * 1.602e-19 * 10.0 / (9.109e-31 * 3.5e-3 * 3.5e-3));
  const double end = 1e-9;
  const Json fourth = {{"type", "constrain-first"}, {"order", 4}};
  BOOST_TEST(std::abs(trap.end(fourth, end, 1000)[2] / 1e-5 - std::cos(axial * end)) < 1e-9);

  const double r = 0.9572e-10, half = 0.5 * 104.52 * std::numbers::pi / 180.0, w = 1e13;
  const double a = r * std::sin(half), b = r * std::cos(half);
  const Json water = {
      {"system",
       {{"type", "lagrangian"},
        {"parameters", {{"M", 2.657e-26}, {"m", 1.674e-27}, {"r", r}, {"s", 2.0 * a}}},
        {"coordinates", {"o[3]", "h[3]", "k[3]"}},
        {"lagrangian", "(M*dot(o', o') + m*dot(h', h') + m*dot(k', k'))/2"},
        {"holonomic",
         {"dot(o - h, o - h) - r^2", "dot(o - k, o - k) - r^2", "dot(k - h, k - h) - s^2"}}}},
      {"initial",
       {{"o", {0, 0, 0}},
        {"h", {a, b, 0}},
        {"k", {-a, b, 0}},
        {"o'", {0, 0, 0}},
        {"h'", {0, 0, -w * a}},
        {"k'", {0, 0, w * a}}}}};
  const test::Problem molecule = test::problem(water);
  BOOST_TEST((molecule.ladder.verdict == Verdict::regular));
  BOOST_TEST(molecule.ladder.degrees_of_freedom == 12);
  BOOST_TEST(!molecule.ladder.is_ambiguous());
  BOOST_TEST(std::abs(molecule.end(fourth, 2e-13, 200)[3] / a - std::cos(w * 2e-13)) < 1e-8);
}

// An electron in a field of a tesla.
BOOST_AUTO_TEST_CASE(the_energy_of_an_electron) {
  const double m = 9.109e-31, speed = 1e6;
  const Json experiment = {
      {"system", {{"type", "charged-particle"}, {"m", m}, {"Q", 1.602e-19}, {"B", 1.0}}},
      {"initial", {{"x", 0}, {"y", 0}, {"p_x", m * speed}, {"p_y", 0}}},
      {"method", kMethod1},
      {"time", {{"step", 1e-13}, {"end", 1e-11}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  const QuantityRecord* const H = outcome.summary.observable("H");
  BOOST_TEST_REQUIRE((H != nullptr));
  BOOST_TEST(std::fabs(H->final - 0.5 * m * speed * speed) < 1e-10 * m * speed * speed);
}

// Veselova's body may not turn about the vertical, an axis that moves in the body: what the constraint says of
// the third angular velocity is nothing where this axis is at right angles to the third one. A method that
// solves for velocities beside a method on the constraint set.
BOOST_AUTO_TEST_CASE(a_body_that_may_not_turn_about_the_vertical) {
  const double c = std::cos(0.6), s = std::sin(0.6);
  Json experiment = {
      {"system",
       {{"type", "lagrangian"},
        {"manifold", "so3"},
        {"coordinates", {"R[3][3]"}},
        {"parameters", {{"I", {1.0, 2.0, 2.6}}}},
        {"lagrangian", "sum(i,0,2,I[i]*v_R[i]^2)/2 - 1.5*R[2][0]^2"},
        {"nonholonomic", {"R[2][0]*v_R[0]+R[2][1]*v_R[1]+R[2][2]*v_R[2]"}}}},
      {"initial", {{"R", {{1, 0, 0}, {0, c, -s}, {0, s, c}}}, {"v_R", {1.0, 0.8, -0.8 * s / c}}}},
      {"method", kRungeKutta},
      {"time", {{"step", 0.01}, {"end", 2}}}};
  const TemporaryFolder first, second;
  const RunOutcome explicitly = run_in(first, experiment);
  BOOST_TEST_REQUIRE((explicitly.status == RunStatus::completed));
  BOOST_TEST(explicitly.summary.max_violation.value_or(1.0) < 1e-7);
  experiment["method"] = {{"type", "constrain-first"}, {"order", 4}};
  const RunOutcome constrained = run_in(second, experiment);
  for (const char* coordinate : {"R[2][0]", "R[2][2]", "p_R[0]", "p_R[1]"})
    BOOST_TEST(std::fabs(final_value(explicitly, coordinate) -
                         final_value(constrained, coordinate)) < 1e-6,
               coordinate);
}

// y³ + y = 2 + cos t, which has an extremum at each multiple of π: there a step leads back to where it began.
BOOST_AUTO_TEST_CASE(a_prescribed_motion_through_its_extrema) {
  const Json experiment = {
      {"system", {{"type", "implicit"}, {"coordinates", {"y"}}, {"equations", {"y^3+y-2-cos(t)"}}}},
      {"initial", {{"y", 1.2134}}},
      {"method", kMethod2},
      {"time", {{"step", 0.1}, {"end", 12}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST((outcome.status == RunStatus::completed));
  const double y = final_value(outcome, "y");
  BOOST_TEST(std::fabs(y * y * y + y - 2.0 - std::cos(12.0)) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
