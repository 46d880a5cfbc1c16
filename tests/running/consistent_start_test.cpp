#include "courant/running/consistent_start.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <vector>

// Mistakes that these cases have to notice:
//  * residuals that are a visible part of their terms count as none
//    (integrators/certificate/consistent_point.cpp)
//  * an unknown that is given goes to another branch with the velocity
//    (integrators/certificate/consistent_point.cpp)
//  * a point is consistent next to what a search came by (integrators/certificate/consistent_point.cpp)
//  * residuals in squares of small lengths are compared with 1, or with other equations
//    (integrators/certificate/consistent_point.cpp, nearest_zero.cpp)
//  * small lengths count as round-off of zeros, for the units of equations or beside large units
//    (integrators/certificate/natural_scaling.cpp, consistent_point.cpp)
//  * velocities that cannot be kept are forgotten (running/start_stages.cpp)
//  * round-off of an exponential stays as a voltage at rest
//    (integrators/certificate/nearest_zero.cpp)
//  * units may be no numbers when they are multiplied (integrators/methods/integrator_in_units.cpp)
//  * coordinates give way before velocities
//  * what nothing determines is taken as it was guessed
//  * what was to be kept is kept though nothing was found with it
//  * a point that solves nothing is taken because it has what is given
//  * velocities that give way forget the momenta that belong to them
//  * coordinates that are given move where velocities contradict an equation
//  * momenta of velocities that contradict an equation of the system are forgotten
//  * momenta that nobody gave may move at will
//  * unknowns that nobody gave are 0 beside those that are given
//  * of points at which velocities can be kept any is taken, not the nearest
BOOST_AUTO_TEST_SUITE(consistent_start_test)

using namespace courant;

namespace {

// A pendulum with its rod as a constraint: x² + y² = 1, and x v + y w = 0 behind it.
Json pendulum(const Json& initial) {
  return {{"system",
           {{"type", "implicit"},
            {"coordinates", {"x", "y", "v", "w"}},
            {"unknowns", {"tension"}},
            {"equations",
             {"x' - v", "y' - w", "v' + tension*x", "w' + tension*y + 1", "x^2 + y^2 - 1"}}}},
          {"initial", initial}};
}

ConstraintLadder start(const Json& experiment) {
  return consistent_start(read_experiment(experiment.dump()));
}

std::string problem(const Json& experiment) {
  try {
    start(experiment);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(consistent_values_stay) {
  const ConstraintLadder ladder =
      start(pendulum({{"x", 0.6}, {"y", -0.8}, {"v", 0.8}, {"w", 0.6}}));
  BOOST_TEST((ladder.verdict == Verdict::regular));
  BOOST_TEST((ladder.point.x - (VectorXd(4) << 0.6, -0.8, 0.8, 0.6).finished()).norm() < 1e-12);
  BOOST_TEST(ladder.moves.empty());
}

// A crane whose load follows x = γ, z = 4 + γ: a ladder of index 4 without anything to choose. With the
// tension l = m (g - γ'')/z the trolley is at s = γ + γ'' z/(g - γ''), not where it is given; searches
// that hold it there end far away, where nothing is solved. At rest it may stay.
BOOST_AUTO_TEST_CASE(a_crane_starts_where_its_path_tells) {
  for (const bool is_at_rest : {true, false}) {
    const std::string path = is_at_rest ? "0*t" : "0.3*(1 - cos(t))";
    const double acceleration = is_at_rest ? 0.0 : 0.3, g = 9.81;
    const ConstraintLadder ladder =
        start({{"system",
                {{"type", "implicit"},
                 {"coordinates", {"x", "z", "s", "n", "vx", "vz", "vs", "vn"}},
                 {"unknowns", {"l", "F", "N"}},
                 {"equations",
                  {"x' - vx", "z' - vz", "s' - vs", "n' - vn", "100*vx' + l*(x - s)",
                   "100*vz' + l*z - 981", "10*vs' - F - l*(x - s)", "5*vn' + N - l*n",
                   "(x - s)^2 + z^2 - n^2", "x - " + path, "z - 4 - " + path}}}},
               {"initial", {{"x", 0}, {"z", 4}, {"s", 0}, {"n", 4}}}});
    BOOST_TEST((ladder.verdict == Verdict::regular), ladder.reason);
    BOOST_TEST(!ladder.is_ambiguous());
    BOOST_TEST(ladder.degrees_of_freedom == 0);
    BOOST_TEST(ladder.index == 4);
    const double s = acceleration * 4.0 / (g - acceleration);
    BOOST_TEST(std::fabs(ladder.point.x[2] - s) < 1e-10);
    BOOST_TEST(std::fabs(ladder.point.x[3] - std::hypot(s, 4.0)) < 1e-10);
    BOOST_TEST(std::fabs(ladder.point.z[0] - 100.0 * (g - acceleration) / 4.0) < 1e-8);
  }
}

// q'' = 0 but for 10⁻²⁹⁸: units of such numbers are none that can be calculated with.
BOOST_AUTO_TEST_CASE(numbers_at_the_end_of_their_range_are_taken_as_they_are) {
  for (const char* power : {"1000", "1070"}) {
    const ConstraintLadder ladder =
        start({{"system",
                {{"type", "hamiltonian"},
                 {"coordinates", {"q"}},
                 {"hamiltonian", "((p_q^2 + q^2)/2)^" + std::string(power)}}},
               {"initial", {{"q", 1}, {"p_q", 0}}}});
    BOOST_TEST((ladder.verdict == Verdict::regular), ladder.reason);
    BOOST_TEST(ladder.degrees_of_freedom == 2);
  }
}

// The model of Christ and Lee with velocities that turn: the angular momentum has to be 0, so that of
// p = (x' + z y, y' - z x) = (0.56, -0.2) what points away from the centre is left, (0.5, 0.1).
BOOST_AUTO_TEST_CASE(velocities_that_contradict_a_constraint_move_no_farther_than_they_must) {
  const ConstraintLadder ladder =
      start({{"system",
              {{"type", "lagrangian"},
               {"coordinates", {"x", "y", "z"}},
               {"lagrangian", "((x' + z*y)^2 + (y' - z*x)^2)/2 - (x^2 + y^2)/2"}}},
             {"initial", {{"x", 1}, {"y", 0.2}, {"z", 0.3}, {"x'", 0.5}, {"y'", 0.1}}}});
  BOOST_TEST((ladder.verdict == Verdict::gauge), ladder.reason);
  const VectorXd& x = ladder.point.x;
  BOOST_TEST((x.head(3) - Eigen::Vector3d(1.0, 0.2, 0.3)).norm() < 1e-12);
  BOOST_TEST(std::fabs(x[0] * x[4] - x[1] * x[3]) < 1e-12);
  BOOST_TEST((x.segment(3, 2) - Eigen::Vector2d(0.5, 0.1)).norm() < 0.02);
  BOOST_TEST(ladder.moves.size() == 2u);
}

// A carriage on two wheels, whose velocities are rounded to two digits: along itself it moves by (cos 0.2, sin 0.2),
// nearly (0.98, 0.2). Those of its wheels are not given and turn as they must, on a level and at an axle that is
// ahead of the centre of mass.
BOOST_AUTO_TEST_CASE(rounded_velocities_move_no_farther_than_they_must) {
  for (const double l : {0.0, 0.3}) {
    const ConstraintLadder ladder = start(
        {{"system",
          {{"type", "lagrangian"},
           {"coordinates", {"x", "y", "th", "a", "b"}},
           {"parameters", {{"m", 10}, {"l", l}, {"J", 2}, {"K", 0.2}, {"R", 0.15}, {"c", 0.4}}},
           {"lagrangian",
            "m/2*(x'^2 + y'^2) + m*l*th'*(y'*cos(th) - x'*sin(th)) + J/2*th'^2 + K/2*(a'^2 + "
            "b'^2)"},
           {"nonholonomic",
            {"x'*cos(th) + y'*sin(th) + c*th' + R*a'", "x'*cos(th) + y'*sin(th) - c*th' + R*b'",
             "y'*cos(th) - x'*sin(th)"}}}},
         {"initial",
          {{"x", 0},
           {"y", 0},
           {"th", 0.2},
           {"a", 0},
           {"b", 0},
           {"x'", 0.98},
           {"y'", 0.2},
           {"th'", 1.5}}}});
    BOOST_TEST((ladder.verdict == Verdict::regular), ladder.reason);
    const VectorXd& v = ladder.point.v;
    BOOST_TEST(ladder.point.x[2] == 0.2);
    BOOST_TEST((v.head(3) - Eigen::Vector3d(0.98, 0.2, 1.5)).norm() < 0.01);
    BOOST_TEST(std::fabs(v[1] * std::cos(0.2) - v[0] * std::sin(0.2)) < 1e-12);
    BOOST_TEST(std::fabs(0.15 * v[3] + std::hypot(v[0], v[1]) + 0.4 * v[2]) < 1e-12);
  }
}

// A body whose velocity about its third axis has to be 0, with its attitude and an advected direction: momenta about
// that axis go, and hardly anything else. The equations of the attitude depend on each other.
BOOST_AUTO_TEST_CASE(what_no_constraint_contains_stays) {
  const ConstraintLadder ladder =
      start({{"system",
              {{"type", "euler-poincare"},
               {"algebra", "so3"},
               {"advected", {"G[3]"}},
               {"representation", "vectors"},
               {"attitude", {"R[3][3]"}},
               {"lagrangian", "(xi[0]^2 + 2*xi[1]^2 + 3*xi[2]^2)/2 - G[2] - 0.3*G[0]"},
               {"nonholonomic", "xi[2]"}}},
             {"initial",
              {{"mu", {0.5, 0.4, 0.9}},
               {"G", {0.6, 0, 0.8}},
               {"R", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}}});
  BOOST_TEST((ladder.verdict == Verdict::regular), ladder.reason);
  const VectorXd& x = ladder.point.x;
  const VectorXd nearest{{0.5, 0.4, 0.0, 0.6, 0.0, 0.8, 1, 0, 0, 0, 1, 0, 0, 0, 1}};
  BOOST_REQUIRE(x.size() == nearest.size());
  BOOST_TEST((x - nearest).lpNorm<Eigen::Infinity>() < 1e-5);
}

// Diodes that block conduct 10⁻¹⁰ times what they do at 0.6 V; what is around a start says nothing of the
// equations there. At rest, and with a charged capacitor.
BOOST_AUTO_TEST_CASE(a_bridge_rectifier_starts) {
  const auto element = [](const char* type, const char* name, const char* from, const char* to) {
    return Json{{"type", type}, {"name", name}, {"from", from}, {"to", to}};
  };
  for (const double leak : {1e-12, 1e-9, 1e-6})
    for (const double charge : {0.0, 1e-4, 1e-3}) {
      Json elements = Json::array();
      const auto add = [&](Json made, const Json& more) {
        made.update(more);
        elements.push_back(std::move(made));
      };
      add(element("voltage-source", "V", "s", "b"), {{"value", "10*sin(100*pi*t)"}});
      add(element("resistor", "RS", "s", "a"), {{"value", 1}});
      const char* const ends[][3] = {
          {"D1", "a", "p"}, {"D2", "b", "p"}, {"D3", "0", "a"}, {"D4", "0", "b"}};
      for (const auto& [name, from, to] : ends)
        add(element("diode", name, from, to),
            {{"saturation", 1e-12}, {"emission", 1.8}, {"leak", leak}});
      add(element("capacitor", "C", "p", "0"), {{"value", 1e-4}});
      add(element("resistor", "R", "p", "0"), {{"value", 1e3}});
      add(element("resistor", "RG", "b", "0"), {{"value", 1e7}});
      const ConstraintLadder ladder = start(
          {{"system",
            {{"type", "network"}, {"nodes", {"0", "s", "a", "b", "p"}}, {"elements", elements}}},
           {"initial", {{"q_C", charge}}}});
      BOOST_TEST_CONTEXT("leak " << leak << ", charge " << charge) {
        BOOST_TEST((ladder.verdict == Verdict::regular));
        BOOST_TEST(ladder.moves.empty());
        BOOST_TEST(!ladder.is_ambiguous());
        BOOST_TEST(ladder.point.x[0] == charge);
        // At rest nothing is left of what exp (v/45 mV) - 1 takes from 1.
        BOOST_TEST((charge != 0.0 || ladder.point.z.isZero(0.0)));
      }
    }
}

// Voltages of diodes that no coordinate stores, where nothing flows yet. Coils do not say what they are.
BOOST_AUTO_TEST_CASE(a_ring_of_diodes_is_at_rest) {
  std::ifstream file("experiments/ring_modulator_index_2.json");
  const ConstraintLadder ladder = consistent_start(read_experiment(Json::parse(file).dump()));
  BOOST_TEST(ladder.point.x.isZero(0.0));
  BOOST_TEST(ladder.point.z.isZero(0.0));
}

// All coordinates are given as 0, which solves nothing: currents between capacitors add up to what is left.
// The sums that contain no velocity vanish where the search ends, each next to its terms.
BOOST_AUTO_TEST_CASE(diodes_and_transistors_start_from_zeros) {
  const auto check = [](const char* name, const Json& coordinates, const Json& equations,
                        const auto& sums) {
    Json initial = Json::object();
    for (const Json& coordinate : coordinates) initial[coordinate.get<std::string>()] = 0;
    const ConstraintLadder ladder = start(
        {{"system", {{"type", "implicit"}, {"coordinates", coordinates}, {"equations", equations}}},
         {"initial", initial}});
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST((ladder.verdict == Verdict::regular));
      BOOST_TEST(!ladder.is_ambiguous());
      for (const auto& [sum, size] : sums(ladder.point.x))
        BOOST_TEST(std::abs(sum) < 1e-11 * size, sum << " of " << size);
    }
  };
  using Sums = std::vector<std::pair<double, double>>;
  const auto grown = [](double voltage) { return std::exp(voltage / 0.026) - 1.0; };
  check("a diode in units of 1", {"a", "b"},
        {"a' - b' + a - 6", "b' - a' + b + 1e-6 * (exp(b / 0.026) - 1)"}, [&](const VectorXd& x) {
          return Sums{{x[0] - 6.0 + x[1] + 1e-6 * grown(x[1]), 6.0}};
        });
  check("a capacitor and a diode", {"a", "b"},
        {"1e-6 * (a' - b') + (a - 9) / 1e3", "1e-6 * (b' - a') + 1e-12 * (exp(b / 0.026) - 1)"},
        [&](const VectorXd& x) {
          return Sums{{(x[0] - 9.0) / 1e3 + 1e-12 * grown(x[1]), 9e-3}};
        });
  // The transistor amplifier of the test set (F. Mazzia, C. Magherini) with one transistor.
  const std::string f = "1e-6 * (exp((u2 - u3) / 0.026) - 1)";
  check("a transistor amplifier", {"u1", "u2", "u3", "u4", "u5"},
        {"1e-6 * (u1' - u2') + (u1 - 0.1 * sin(200 * pi * t)) / 1000",
         "1e-6 * (u2' - u1') - 6 / 9000 + u2 * (1 / 9000 + 1 / 9000) + (1 - 0.99) * " + f,
         "2e-6 * u3' + u3 / 9000 - " + f, "3e-6 * (u4' - u5') + u4 / 9000 - 6 / 9000 + 0.99 * " + f,
         "3e-6 * (u5' - u4') + u5 / 9000"},
        [&](const VectorXd& x) {
          const double current = 1e-6 * grown(x[1] - x[2]);
          return Sums{{x[0] / 1e3 - 6.0 / 9e3 + x[1] / 4.5e3 + 0.01 * current, 6.0 / 9e3},
                      {(x[3] + x[4] - 6.0) / 9e3 + 0.99 * current, 6.0 / 9e3}};
        });
}

// The velocities of a Lagrangian are unknowns of its equations, too: what is given is where these
// are evaluated first. At rest none of these Lagrangians has a derivative.
BOOST_AUTO_TEST_CASE(velocities_of_a_lagrangian_enter_the_first_evaluation) {
  const auto lagrangian = [](const Json& coordinates, const char* formula, const Json& initial) {
    return start({{"system",
                   {{"type", "lagrangian"}, {"coordinates", coordinates}, {"lagrangian", formula}}},
                  {"initial", initial}});
  };
  const ConstraintLadder logarithm = lagrangian({"x"}, "log(x') - x^2/2", {{"x", 1}, {"x'", 0.5}});
  BOOST_TEST((logarithm.verdict == Verdict::regular));
  BOOST_TEST(logarithm.point.x[1] == 2.0, boost::test_tools::tolerance(1e-12));  // p = 1 / x'
  BOOST_TEST(logarithm.point.z[0] == 0.5, boost::test_tools::tolerance(1e-12));

  const ConstraintLadder ray =
      lagrangian({"x", "y"}, "sqrt(x'^2 + y'^2)", {{"x", 1}, {"y", 0}, {"x'", 3}, {"y'", 4}});
  BOOST_TEST((ray.verdict == Verdict::gauge));
  BOOST_TEST((ray.point.x.tail(2) - Eigen::Vector2d(0.6, 0.8)).norm() < 1e-12);
  BOOST_TEST((ray.point.v.head(2) - Eigen::Vector2d(3.0, 4.0)).norm() < 1e-12);

  const ConstraintLadder particle = lagrangian({"time", "x"}, "-sqrt(time'^2 - x'^2)",
                                               {{"time", 0}, {"x", 0}, {"time'", 1}, {"x'", 0.6}});
  BOOST_TEST((particle.verdict == Verdict::gauge));
  BOOST_TEST((particle.point.x.tail(2) - Eigen::Vector2d(-1.25, 0.75)).norm() < 1e-12);

  const Json no_velocity = {
      {"system",
       {{"type", "lagrangian"}, {"coordinates", {"x"}}, {"lagrangian", "log(x') - x^2/2"}}},
      {"initial", {{"x", 1}}}};
  BOOST_TEST(problem(no_velocity).find("with 0 for what is not given") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_moves_is_told) {
  const ConstraintLadder ladder = start(pendulum({{"x", 3}, {"y", -4}, {"v", 0}, {"w", 0}}));
  BOOST_TEST(ladder.point.x[0] == 0.6, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(ladder.point.x[1] == -0.8, boost::test_tools::tolerance(1e-9));
  BOOST_REQUIRE(ladder.moves.size() == 2u);
  BOOST_TEST(ladder.moves[0].name == "x");
  BOOST_TEST(ladder.moves[0].from == 3.0);
}

BOOST_AUTO_TEST_CASE(what_is_held_stays_and_the_others_move) {
  Json experiment = pendulum({{"x", 0.5}, {"y", -4}, {"v", 0}, {"w", 0}});
  experiment["hold"] = {"x"};
  const ConstraintLadder ladder = start(experiment);
  BOOST_TEST(ladder.point.x[0] == 0.5);
  BOOST_TEST(ladder.point.x[1] == -std::sqrt(0.75), boost::test_tools::tolerance(1e-9));
}

// y = 4 instead of -4 chooses the other of the two points with x = 0.5.
BOOST_AUTO_TEST_CASE(given_values_choose_the_branch) {
  Json experiment = pendulum({{"x", 0.5}, {"y", 4}, {"v", 0}, {"w", 0}});
  experiment["hold"] = {"x"};
  BOOST_TEST(start(experiment).point.x[1] == std::sqrt(0.75), boost::test_tools::tolerance(1e-9));
}

// The least 100 (x - 3)² + (y + 4)² on the circle: its gradient is parallel to (x, y).
BOOST_AUTO_TEST_CASE(weights_say_what_moving_costs) {
  Json experiment = pendulum({{"x", 3}, {"y", -4}, {"v", 0}, {"w", 0}});
  experiment["weights"] = {{"x", 100}};
  const VectorXd x = start(experiment).point.x;
  BOOST_TEST(std::abs(x[0] * x[0] + x[1] * x[1] - 1) < 1e-12);
  BOOST_TEST(std::abs(100 * (x[0] - 3) * x[1] - (x[1] + 4) * x[0]) < 1e-5);
  BOOST_TEST(x[0] > 0.9);
  experiment["weights"] = {{"tension", 1}, {"x", -1}};
  BOOST_TEST(
      problem(experiment).find("/weights/tension: is the weight of something") != std::string::npos,
      problem(experiment));
  BOOST_TEST(problem(experiment).find("/weights/x: ") != std::string::npos);
}

// Three of four coordinates held: the fourth follows from the hidden constraint.
BOOST_AUTO_TEST_CASE(several_values_are_held) {
  Json experiment = pendulum({{"x", 0.6}, {"y", -0.8}, {"v", 0.4}, {"w", 7}});
  experiment["hold"] = {"x", "y", "v"};
  const ConstraintLadder ladder = start(experiment);
  BOOST_TEST((ladder.point.x - (VectorXd(4) << 0.6, -0.8, 0.4, 0.3).finished()).norm() < 1e-9);
  BOOST_REQUIRE_EQUAL(ladder.moves.size(), 1U);
  BOOST_TEST(ladder.moves[0].name == "w");
}

BOOST_AUTO_TEST_CASE(what_is_held_against_the_constraints_is_an_error) {
  Json experiment = pendulum({{"x", 2}, {"y", -4}, {"v", 0}, {"w", 0}});
  experiment["hold"] = {"x", "y"};
  BOOST_TEST(problem(experiment).find("/hold: what is held contradicts the constraints") == 0u,
             problem(experiment));
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_found_where_it_is_determined) {
  // w from x v + y w = 0.
  const ConstraintLadder ladder = start(pendulum({{"x", 0.6}, {"y", -0.8}, {"v", 0.8}}));
  BOOST_TEST(ladder.point.x[3] == 0.6, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(ladder.moves.empty());
  const std::string missing = problem(pendulum({{"x", 0.6}, {"y", -0.8}}));
  BOOST_TEST(missing.find("/initial: nothing determines v, w; expected more initial values") == 0u,
             missing);
}

// Rest is recommended where it was tried: not where a position is missing, nor where a constraint moves.
BOOST_AUTO_TEST_CASE(rest_is_recommended_where_it_determines_the_start) {
  const auto bead = [](const Json& initial, const std::string& constraint) {
    return problem({{"system",
                     {{"type", "mechanical"},
                      {"coordinates", {"x", "y"}},
                      {"potential", "9.81*y"},
                      {"holonomic", {constraint}}}},
                    {"initial", initial}});
  };
  const std::string circle = "x^2 + y^2 - 1", recommended = "or \"rest\": true";
  const std::string still = bead({{"x", 0.6}, {"y", -0.8}}, circle);
  BOOST_TEST(still.find(recommended) != std::string::npos, still);
  const std::string moving = bead({{"x", 1}, {"y", 0}}, "x - cos(t) - 0.5*t");
  BOOST_TEST(moving.find("nothing determines") != std::string::npos, moving);
  BOOST_TEST(moving.find(recommended) == std::string::npos, moving);
  const std::string nowhere = problem(
      {{"system", {{"type", "mechanical"}, {"coordinates", {"x", "y"}}}}, {"initial", {{"x", 1}}}});
  BOOST_TEST(nowhere.find(recommended) == std::string::npos, nowhere);
}

// Without a matrix of all coordinates, which took more memory than there is.
BOOST_AUTO_TEST_CASE(what_is_missing_of_many_coordinates_is_told) {
  const std::string many = std::to_string(20'000);
  Json experiment = {{"system",
                      {{"type", "hamiltonian"},
                       {"coordinates", {"r[" + many + "]"}},
                       {"hamiltonian", "p_r[0]^2/2 + r[0]^2"}}},
                     {"initial", {{"r[0]", 1}}}};
  BOOST_TEST(problem(experiment) ==
             "/initial: nothing determines r[1], r[2], r[3], r[4], r[5], …; expected more initial "
             "values");
}

BOOST_AUTO_TEST_CASE(velocities_determine_momenta) {
  const Json experiment = {
      {"system",
       {{"type", "lagrangian"}, {"coordinates", {"q"}}, {"lagrangian", "3*q'^2/2 - q^2"}}},
      {"initial", {{"q", 1}, {"q'", 0.5}}}};
  const ConstraintLadder ladder = start(experiment);
  BOOST_TEST(ladder.point.x[0] == 1.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(ladder.point.x[1] == 1.5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(ladder.moves.empty());
  Json without = experiment;
  without["initial"].erase("q'");
  BOOST_TEST(problem(without).find("/initial: nothing determines p_q") == 0u, problem(without));
}

BOOST_AUTO_TEST_CASE(a_velocity_that_cannot_be_kept_gives_way) {
  const Json experiment = {{"system",
                            {{"type", "lagrangian"},
                             {"coordinates", {"x", "y"}},
                             {"lagrangian", "x*y' - x^2/2 - y^2/2"}}},
                           {"initial", {{"x", 1}, {"y", 0}, {"x'", 7}}}};
  const ConstraintLadder ladder = start(experiment);
  BOOST_TEST((ladder.verdict == Verdict::regular));
  BOOST_TEST(ladder.point.x[0] == 1.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::abs(ladder.point.v[0]) < 1e-9);  // x' = -y
  bool told = false;
  for (const Movement& move : ladder.moves) told = told || move.name == "x'";
  BOOST_TEST(told);
}

// A bicycle that leans and steers: its front wheel is on the ground for a small pitch of the frame, which
// nobody can guess. That has to give way, and hardly anything else.
BOOST_AUTO_TEST_CASE(a_pitch_gives_way_and_the_motion_that_is_given_stays) {
  std::ifstream file("experiments/bicycle.json");
  Json experiment = Json::parse(file);
  experiment.erase("expect");
  const Json motions[] = {{{"phi'", 0.1}, {"del'", 0.1}, {"tR'", 15}},
                          {{"psi'", 0}, {"x'", 4.6}, {"tR'", 15}}};
  for (const Json& motion : motions) {
    Json initial = {{"x", 0},  {"y", 0},     {"psi", 0.3}, {"phi", 0.1},
                    {"th", 0}, {"del", 0.2}, {"tR", 0},    {"tF", 0}};
    initial.update(motion);
    experiment["initial"] = initial;
    const ConstraintLadder ladder = start(experiment);
    BOOST_TEST_CONTEXT(motion << ": " << ladder.reason) {
      BOOST_TEST((ladder.verdict == Verdict::regular));
      BOOST_TEST(!ladder.is_ambiguous());
      BOOST_TEST(ladder.degrees_of_freedom == 10);
      BOOST_TEST(ladder.moved < 2e-3);
    }
    if (!motion.contains("phi'")) continue;
    for (const Movement& move : ladder.moves) BOOST_TEST(move.name.back() != '\'');
  }
}

BOOST_AUTO_TEST_CASE(values_that_are_near_no_point_are_an_error) {
  const Json experiment = {{"system",
                            {{"type", "hamiltonian"},
                             {"manifold", {{"type", "cotangent-bundle"}, {"base", "so3"}}},
                             {"coordinates", {"R[3][3]"}},
                             {"hamiltonian", "dot(p_R, p_R)"}}},
                           {"initial", {{"p_R", {1, 0, 0}}}}};
  BOOST_TEST(problem(experiment) ==
             "/initial: no point of CotangentBundle(SpecialOrthogonal3(exponential)) is near the "
             "initial values (with 0 for what is not given): A has determinant "
             "0; expected one above 0, as near a rotation.");
}

BOOST_AUTO_TEST_CASE(equations_that_are_not_finite_are_an_error) {
  const Json experiment = {
      {"system",
       {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", "p_q^2/2 - 1/q"}}},
      {"initial", {{"q", 0}, {"p_q", 1}}}};
  BOOST_TEST(problem(experiment) ==
             "/initial: 1/q in equation 2 has no value at the initial values: the divisor is 0");
}

// 2z² - 3z + 1 = 0 at (1, 1), with zeros 1 and 1/2: the velocity, which is not given, does not draw z away.
BOOST_AUTO_TEST_CASE(an_unknown_that_is_given_chooses_the_branch) {
  Json experiment = {
      {"system",
       {{"type", "implicit"},
        {"coordinates", {"y1", "y2"}},
        {"unknowns", {"z"}},
        {"equations", {"y1' - y1*y2^2*z^2", "y2' - y1^2*y2^2 + 3*y2^2*z", "y1^2*y2 - 1"}}}}};
  for (const double z : {0.6, 0.8, 0.9, 1.2}) {
    experiment["initial"] = {{"y1", 1}, {"y2", 1}, {"z", z}};
    BOOST_TEST(start(experiment).point.z[0] == (z > 0.75 ? 1.0 : 0.5),
               boost::test_tools::tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(an_inconsistent_system_is_a_finding) {
  const Json experiment = {
      {"system", {{"type", "lagrangian"}, {"coordinates", {"q"}}, {"lagrangian", "q' + q"}}},
      {"initial", {{"q", 0}}}};
  BOOST_TEST((start(experiment).verdict == Verdict::inconsistent));
}

// A position and a velocity of a pendulum in four digits: both move in the fifth.
BOOST_AUTO_TEST_CASE(a_rounded_start_keeps_its_speed) {
  const ConstraintLadder ladder =
      start({{"system",
              {{"type", "mechanical"},
               {"coordinates", {"x", "y"}},
               {"potential", "9.81*y"},
               {"holonomic", "x^2 + y^2 - 1"}}},
             {"initial", {{"x", 0.8415}, {"y", -0.5403}, {"x'", 0.7024}, {"y'", 1.0939}}}});
  BOOST_TEST((ladder.verdict == Verdict::regular));
  BOOST_TEST(!ladder.is_ambiguous());
  const VectorXd& x = ladder.point.x;
  BOOST_TEST(std::fabs(x[0] * x[3] - x[1] * x[2] - 1.3) < 1e-4);
  BOOST_TEST(std::fabs(x[0] * x[2] + x[1] * x[3]) < 1e-14);
  BOOST_TEST(ladder.moves.size() == 4u);
  BOOST_TEST(ladder.moved < 1e-4);
}

// The component of the velocity along the point goes, and no other.
BOOST_AUTO_TEST_CASE(a_rounded_start_on_a_sphere_keeps_its_velocity) {
  const ConstraintLadder ladder =
      start({{"system",
              {{"type", "mechanical"},
               {"manifold", "sphere"},
               {"coordinates", {"x[3]"}},
               {"potential", "x[2]"}}},
             {"initial", {{"x", {0.4801, 0.6, 0.64}}, {"x'", {0.5, -0.4, 0.01}}}}});
  BOOST_TEST((ladder.verdict == Verdict::regular));
  const Eigen::Vector3d given(0.4801, 0.6, 0.64), velocity(0.5, -0.4, 0.01), q = given.normalized();
  BOOST_TEST((ladder.point.x.head(3) - q).norm() < 1e-12);
  BOOST_TEST((ladder.point.v.head(3) - (velocity - q * q.dot(velocity))).norm() < 1e-9);
}

// Positions first: those of an ellipse that is a millionth away, and p there without its part along the gradient.
BOOST_AUTO_TEST_CASE(momenta_are_projected_at_the_nearest_position) {
  const ConstraintLadder ladder =
      start({{"system",
              {{"type", "mechanical"},
               {"coordinates", {"x", "y"}},
               {"metric", 1.0},
               {"potential", "9.81*y"},
               {"holonomic", {"x^2 + 9*y^2 - 9"}}}},
             {"initial", {{"x", 3}, {"y", 0.001}, {"p_x", 0.001}, {"p_y", 1}}}});
  BOOST_TEST((ladder.verdict == Verdict::regular));
  BOOST_TEST(ladder.moved < 1.6e-6);
  const Eigen::Vector2d q = ladder.point.x.head(2), p(0.001, 1), normal(q[0], 9.0 * q[1]);
  BOOST_TEST((q - Eigen::Vector2d(3, 0.001)).norm() < 1.6e-6);
  BOOST_TEST((ladder.point.x.tail(2) - (p - normal * normal.dot(p) / normal.squaredNorm())).norm() <
             1e-9);
}

// What SciPy finds: the position moves by 0.0106, the momentum by 0.861.
BOOST_AUTO_TEST_CASE(a_slider_crank_with_a_momentum_that_does_not_fit_starts_near) {
  const ConstraintLadder ladder = start(
      {{"system",
        {{"type", "mechanical"},
         {"coordinates", {"a", "b", "s"}},
         {"metric", {1, 1, 1}},
         {"holonomic", {"cos(a)+3*cos(b)-s", "sin(a)-3*sin(b)"}}}},
       {"initial", {{"a", 0.5}, {"b", 0.16}, {"s", 3.8}, {"p_a", 0.001}, {"p_b", 0}, {"p_s", 1}}}});
  BOOST_TEST((ladder.verdict == Verdict::regular));
  const VectorXd given{{0.5, 0.16, 3.8, 0.001, 0.0, 1.0}};
  const double position = (ladder.point.x - given).head(3).norm();
  BOOST_TEST(position < 0.05);
  BOOST_TEST(position == ladder.moved, boost::test_tools::tolerance(1e-6));
  BOOST_TEST((ladder.point.x - given).norm() < 0.9);
}

// 3² + 3.9² - 25 = -0.79.
BOOST_AUTO_TEST_CASE(a_violation_by_what_is_held_is_told_in_the_numbers_of_the_experiment) {
  const Json experiment = {{"system",
                            {{"type", "implicit"},
                             {"coordinates", {"x", "y"}},
                             {"unknowns", {"l"}},
                             {"equations", {"x' + l*x", "y' + l*y - 1", "x^2 + y^2 - 25"}}}},
                           {"initial", {{"x", 3}, {"y", 3.9}}},
                           {"hold", {"x", "y"}}};
  BOOST_TEST(problem(experiment)
                 .starts_with("/hold: what is held contradicts the constraints: the "
                              "equation \"x^2 + y^2 - 25\" is -0.79; they hold near by with x"),
             problem(experiment));
}

BOOST_AUTO_TEST_CASE(held_momenta_against_held_positions_are_an_error) {
  Json experiment = {{"system",
                      {{"type", "mechanical"},
                       {"coordinates", {"x", "y"}},
                       {"metric", 1.0},
                       {"potential", "9.81*y"},
                       {"holonomic", {"x^2+y^2-1"}}}},
                     {"initial", {{"x", 1}, {"y", 0}, {"p_x", 1}, {"p_y", 0}}},
                     {"hold", {"x", "y", "p_x"}}};
  BOOST_TEST(problem(experiment).find("/hold: what is held contradicts the constraints") == 0u,
             problem(experiment));
}

// An angle of four bars and its velocity, which are meant, beside values of the others that are guesses.
BOOST_AUTO_TEST_CASE(what_is_held_is_held_to_the_bit) {
  const ConstraintLadder ladder =
      start({{"system",
              {{"type", "mechanical"},
               {"coordinates", {"u", "v", "w"}},
               {"parameters",
                {{"a", 0.25},
                 {"b", 0.6},
                 {"c", 0.5},
                 {"d", 0.65},
                 {"m1", 0.7},
                 {"m2", 1.86},
                 {"g", 9.81}}},
               {"metric",
                {{"(m1/3+m2)*a^2", "m2*a*b*cos(u-v)/2", 0},
                 {"m2*a*b*cos(u-v)/2", "m2*b^2/3", 0},
                 {0, 0, "1.4*c^2/3"}}},
               {"potential", "g*(m1*a*sin(u)/2 + m2*(a*sin(u)+b*sin(v)/2) + 0.7*c*sin(w))"},
               {"holonomic", {"a*cos(u)+b*cos(v)-c*cos(w)-d", "a*sin(u)+b*sin(v)-c*sin(w)"}}}},
             {"initial", {{"u", 1.1}, {"v", 0.5}, {"w", 1.5}, {"u'", 0.6}, {"v'", 0}, {"w'", 0}}},
             {"hold", {"u", "u'"}}});
  BOOST_TEST((ladder.verdict == Verdict::regular));
  BOOST_TEST(ladder.point.x[0] == 1.1);
  BOOST_TEST(ladder.point.v[0] == 0.6);
  const double u = 1.1, v = ladder.point.x[1], w = ladder.point.x[2];
  BOOST_TEST(std::fabs(0.25 * std::sin(u) + 0.6 * std::sin(v) - 0.5 * std::sin(w)) < 1e-13);
  for (const Movement& move : ladder.moves)
    BOOST_TEST((move.name != "u" && move.name != "u'"), move.name);
}

BOOST_AUTO_TEST_CASE(nothing_moves_where_nothing_is_consistent) {
  const ConstraintLadder ladder =
      start({{"system",
              {{"type", "implicit"},
               {"coordinates", {"x", "y"}},
               {"equations", {"x' + x + y", "y' - y - 1", "x + 2*y - 3"}}}},
             {"initial", {{"x", 1}, {"y", 1}}}});
  BOOST_TEST((ladder.verdict == Verdict::inconsistent));
  BOOST_TEST(ladder.moves.empty());
  BOOST_TEST(ladder.moved == 0.0);
}

// At (10⁹, 1) residuals of thousands are round-off next to the numbers of the start, and none at a point.
BOOST_AUTO_TEST_CASE(a_point_is_consistent_by_its_own_numbers) {
  const ConstraintLadder ladder = start(pendulum({{"x", 1e9}, {"y", 1}, {"v", 0}, {"w", 0}}));
  const VectorXd& x = ladder.point.x;
  BOOST_TEST((ladder.verdict == Verdict::regular));
  BOOST_TEST(std::fabs(x[0] * x[0] + x[1] * x[1] - 1.0) < 1e-12);
}

namespace {

// Points on circles of radius l, with a weight, without one, and as equations.
std::vector<Json> on_a_circle(double l) {
  const std::string circle = "x^2 + y^2 - (" + Json(l).dump() + ")^2";
  return {{{"type", "mechanical"}, {"coordinates", {"x", "y"}}, {"holonomic", circle}},
          {{"type", "mechanical"},
           {"coordinates", {"x", "y"}},
           {"metric", 1e-3},
           {"potential", "1e-3*9.81*y"},
           {"holonomic", circle}},
          {{"type", "implicit"},
           {"coordinates", {"x", "y", "v", "w"}},
           {"unknowns", {"s"}},
           {"equations", {"x' - v", "y' - w", "v' + s*x", "w' + s*y", circle}}},
          {{"type", "implicit"},
           {"coordinates", {"x", "y", "v", "w"}},
           {"unknowns", {"s"}},
           {"equations", {"x' - v", "y' - w", "v' + s*x", "w' + s*y + 9.81", circle}}}};
}

}  // namespace

// The nearest point of x² + y² = l² is l (x, y) / |(x, y)|, whatever metres are called.
BOOST_AUTO_TEST_CASE(small_lengths_are_measured_by_themselves) {
  for (const double l : {1.0, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10})
    for (const Json& system : on_a_circle(l))
      for (const double part : {0.6001, 0.65, 0.7}) {
        const VectorXd given = l * VectorXd{{part, -0.8}};
        const ConstraintLadder ladder = start(
            {{"system", system}, {"initial", {{"x", given[0]}, {"y", given[1]}, {"rest", true}}}});
        const VectorXd nearest = l / given.norm() * given;
        BOOST_TEST((ladder.verdict == Verdict::regular), system.dump());
        BOOST_TEST((ladder.point.x.head(2) - nearest).norm() < 1e-9 * l,
                   system.dump() << " from " << part << ": " << ladder.point.x.transpose() / l);
        BOOST_TEST(std::fabs(ladder.moved - (given - nearest).norm()) < 1e-9 * l, system.dump());
      }
}

BOOST_AUTO_TEST_CASE(small_lengths_that_are_held_off_their_circle_are_an_error) {
  for (const double l : {1.0, 1e-8, 1e-10})
    for (const Json& system : on_a_circle(l)) {
      const Json experiment = {{"system", system},
                               {"initial", {{"x", 0.9 * l}, {"y", -0.8 * l}, {"rest", true}}},
                               {"hold", {"x", "y"}}};
      BOOST_TEST(problem(experiment).find("/hold: what is held contradicts the constraints") == 0u,
                 system.dump() << ": " << problem(experiment));
    }
}

// Three rods of some 10⁻¹⁰ m between masses of 10⁻²⁶ kg, whose given distances are off by 7·10⁻⁵ of themselves. A triangle
// of the right sides that has moved by what they lack is a nearest one to first order; distances tell that it is one.
BOOST_AUTO_TEST_CASE(a_molecule_starts_with_its_bonds) {
  constexpr double bond = 9.572e-11, between = 1.5139e-10;
  const ConstraintLadder ladder =
      start({{"system",
              {{"type", "mechanical"},
               {"coordinates", {"o[2]", "a[2]", "b[2]"}},
               {"metric", {2.657e-26, 2.657e-26, 1.674e-27, 1.674e-27, 1.674e-27, 1.674e-27}},
               {"potential", "-1e-11*a[1]"},
               {"holonomic",
                {"(o[0]-a[0])^2 + (o[1]-a[1])^2 - 9.572e-11^2",
                 "(o[0]-b[0])^2 + (o[1]-b[1])^2 - 9.572e-11^2",
                 "(a[0]-b[0])^2 + (a[1]-b[1])^2 - 1.5139e-10^2"}}}},
             {"initial",
              {{"o", {0, 0}},
               {"a", {5.859e-11, 7.57e-11}},
               {"b", {5.859e-11, -7.57e-11}},
               {"rest", true}}}});
  const VectorXd& x = ladder.point.x;
  BOOST_TEST((ladder.verdict == Verdict::regular));
  BOOST_TEST((x.segment(2, 2) - x.head(2)).norm() == bond, boost::test_tools::tolerance(1e-10));
  BOOST_TEST((x.segment(4, 2) - x.head(2)).norm() == bond, boost::test_tools::tolerance(1e-10));
  BOOST_TEST((x.segment(4, 2) - x.segment(2, 2)).norm() == between,
             boost::test_tools::tolerance(1e-10));
  BOOST_TEST(ladder.moved < 2e-4 * bond);
}

// y y' = -1 has a point as near to y = 0 as one likes, with a velocity beyond all bounds, and none at 0.
BOOST_AUTO_TEST_CASE(an_impasse_is_no_start) {
  Json experiment = {
      {"system", {{"type", "implicit"}, {"coordinates", {"y"}}, {"equations", {"y*y'+1"}}}},
      {"initial", {{"y", 0}}}};
  const auto found = [&] { return consistent_start(read_experiment(experiment.dump())); };
  BOOST_TEST(found().impasse.find("the equations have no solution at the initial values") == 0u,
             found().impasse);
  BOOST_TEST(found().is_ambiguous());
  experiment["initial"]["y"] = 0.01;
  BOOST_TEST(found().impasse == "");
}

// Unknowns that were given nothing, where their being 0 has no value: what equations give them, one after the other.
BOOST_AUTO_TEST_CASE(unknowns_that_divide) {
  const auto find = [](const Json& unknowns, const Json& equations, const Json& initial) {
    return start({{"system",
                   {{"type", "implicit"},
                    {"coordinates", {"x"}},
                    {"unknowns", unknowns},
                    {"equations", equations}}},
                  {"initial", initial}});
  };
  const ConstraintLadder one = find({"z"}, {"x' - 1/z", "z - x"}, {{"x", 2}});
  BOOST_TEST((one.verdict == Verdict::regular));
  BOOST_TEST(one.point.z[0] == 2.0);
  BOOST_TEST(std::abs(one.point.v[0] - 0.5) < 1e-15);
  // w by z, z by x; the equation of z is not linear.
  const ConstraintLadder chain =
      find({"w", "z"}, {"x' - 1/w", "w*z - 6", "exp(z) - x"}, {{"x", std::exp(3.0)}});
  BOOST_TEST((chain.verdict == Verdict::regular));
  BOOST_TEST(std::abs(chain.point.z[0] - 2.0) < 1e-14);
  BOOST_TEST(std::abs(chain.point.z[1] - 3.0) < 1e-14);
  // A value that is given is one too.
  const ConstraintLadder given =
      find({"w", "z"}, {"x' - 1/w", "w - z", "z^2 - x"}, {{"x", 4}, {"z", -2}});
  BOOST_TEST((given.verdict == Verdict::regular));
  BOOST_TEST(given.point.z[0] == -2.0);
}

// At 0 a root has a value and no derivative. Two throttles in a row take half of the pressure each, which no equation gives
// alone.
BOOST_AUTO_TEST_CASE(unknowns_under_a_root) {
  const auto find = [](const Json& unknowns, const Json& equations) {
    return start({{"system",
                   {{"type", "implicit"},
                    {"coordinates", {"x"}},
                    {"unknowns", unknowns},
                    {"equations", equations}}},
                  {"initial", {{"x", 1}}}});
  };
  const ConstraintLadder one = find({"P", "Q"}, {"x' + Q", "P - 4*x", "Q - sqrt(P)"});
  BOOST_TEST((one.verdict == Verdict::regular));
  BOOST_TEST(std::abs(one.point.v[0] + 2.0) < 1e-14);
  const ConstraintLadder two =
      find({"P1", "P2", "Q"}, {"x' + Q", "P1 + P2 - 8*x", "Q - sqrt(P1)", "Q - sqrt(P2)"});
  BOOST_TEST((two.verdict == Verdict::regular));
  BOOST_TEST(std::abs(two.point.v[0] + 2.0) < 1e-13);
}

// A line with three loads of constant power has two states: one with voltages, and one in which all of the source falls
// off on the way. Which of them is meant the voltages tell that are given, at one node as at all; those by hand are
// v₃ = v, v₂ = v₃ + 0.3·5000/v₃, … up to 230 V at the source.
BOOST_AUTO_TEST_CASE(unknowns_that_nobody_gave_follow_from_those_that_are_given) {
  const std::vector<double> loaded = {196.63057513845058, 178.07188147653466, 169.20716066};
  const std::vector<double> dark = {139.180860613613, 78.0225851129575, 43.68858};
  const auto check = [&](const Json& given, const std::vector<double>& right) {
    Json initial = given;
    initial["q"] = 1;
    const ConstraintLadder found =
        start({{"system",
                {{"type", "implicit"},
                 {"coordinates", {"q"}},
                 {"unknowns", {"v1", "v2", "v3"}},
                 {"equations",
                  {"q' + q - v1/230", "((230-v1)/0.5 - (v1-v2)/0.4)*v1 - 4000",
                   "((v1-v2)/0.4 - (v2-v3)/0.3)*v2 - 3000", "((v2-v3)/0.3)*v3 - 5000"}}}},
               {"initial", initial}});
    BOOST_TEST_CONTEXT(given) {
      BOOST_TEST_REQUIRE((found.verdict == Verdict::regular), found.reason);
      for (Index i = 0; i < 3; ++i)
        BOOST_TEST(std::abs(found.point.z[i] - right[static_cast<std::size_t>(i)]) < 1e-3);
    }
  };
  for (const Json& given :
       {Json{{"v1", 220}}, Json{{"v2", 205}}, Json{{"v3", 190}}, Json{{"v3", 160}},
        Json{{"v1", 200}, {"v3", 170}}, Json{{"v1", 220}, {"v2", 210}, {"v3", 205}}})
    check(given, loaded);
  for (const Json& given : {Json{{"v3", 40}}, Json{{"v1", 140}, {"v2", 80}, {"v3", 45}}})
    check(given, dark);
}

// Positions that are 5·10⁻⁸ from a consistent one: a start at rest that is nearer by rounding was taken, and momenta were lost.
BOOST_AUTO_TEST_CASE(rounded_positions_keep_the_motion) {
  const double starts[][4] = {{0.94269, 0.33367, 0.48912, -2.07283},
                              {0.98236, -0.187, -0.01446, -0.11392},
                              {-0.76719, -0.64142, 1.07268, -1.92451}};
  for (const auto& [x, y, p_x, p_y] : starts) {
    const Json pendulum = {{"system",
                            {{"type", "mechanical"},
                             {"coordinates", {"x", "y"}},
                             {"metric", {2, 3}},
                             {"potential", "9.81*y"},
                             {"holonomic", "x^2 + y^2 - 1"}}},
                           {"initial", {{"x", x}, {"y", y}, {"p_x", p_x}, {"p_y", p_y}}},
                           {"start", "nearest"}};
    const ConsistentStart found = consistent_start(read_experiment(pendulum.dump()));
    BOOST_TEST((found.point.x - VectorXd{{x, y, p_x, p_y}}).norm() < 2e-5);
  }
}

// A bead on a hoop that turns: rounded positions, and of the velocities those that the turning does not give. The start
// that the search met first, 0.12 away, had these velocities too.
BOOST_AUTO_TEST_CASE(rounded_positions_with_some_velocities_start_at_the_nearest) {
  const Json hoop = {{"system",
                      {{"type", "lagrangian"},
                       {"parameters", {{"m", 0.1}, {"R", 0.25}, {"w", 8}}},
                       {"coordinates", {"x", "y", "z"}},
                       {"lagrangian", "m*(x'^2 + y'^2 + z'^2)/2 - m*9.81*z"},
                       {"holonomic", {"x^2 + y^2 + z^2 - R^2", "x*sin(w*t) - y*cos(w*t)"}}}},
                     {"initial", {{"x", 0.1768}, {"y", 0}, {"z", -0.1768}, {"x'", 0}, {"z'", 0}}}};
  const ConsistentStart found = consistent_start(read_experiment(hoop.dump()));
  BOOST_TEST((found.verdict == Verdict::regular));
  BOOST_TEST(found.is_nearest);
  const double beside = 0.25 * std::sqrt(0.5);
  const VectorXd expected{{beside, 0.0, -beside, 0.0, 0.1 * 8.0 * beside, 0.0}};
  BOOST_TEST((found.point.x - expected).norm() < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
