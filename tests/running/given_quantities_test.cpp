#include "courant/running/given_quantities.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/consistent_start.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(given_quantities_test)

namespace {

Json circuit(const Json& initial) {
  return {{"system",
           {{"type", "network"},
            {"nodes", {"0", "a", "b", "c"}},
            {"definitions", {{"twice", "2*q_C"}}},
            {"elements",
             {{{"type", "voltage-source"}, {"name", "V"}, {"from", "a"}, {"to", "0"}, {"value", 1}},
              {{"type", "resistor"}, {"name", "R1"}, {"from", "a"}, {"to", "b"}, {"value", 1}},
              {{"type", "inductor"}, {"name", "L"}, {"from", "b"}, {"to", "c"}, {"value", 0.2}},
              {{"type", "capacitor"}, {"name", "C"}, {"from", "c"}, {"to", "0"}, {"value", 3}}}}}},
          {"initial", initial}};
}

VectorXd start(const Json& initial, const Json& hold = nullptr) {
  Json document = circuit(initial);
  if (!hold.is_null()) document["hold"] = hold;
  return consistent_start(read_experiment_document(document)).point.x;
}

}  // namespace

// phi = L i, q = C v; whatever quantity says it.
BOOST_AUTO_TEST_CASE(a_start_is_given_by_what_can_be_observed) {
  for (const Json& initial :
       {Json{{"v_C", 0.5}, {"i_L", 2}}, Json{{"potential_c", 0.5}, {"i_R1", 2}},
        Json{{"twice", 3}, {"potential_b", -1}}, Json{{"q_C", 1.5}, {"v_R1", 2}}}) {
    const VectorXd x = start(initial);
    BOOST_TEST(std::abs(x[0] - 0.4) < 1e-11, initial.dump());
    BOOST_TEST(std::abs(x[1] - 1.5) < 1e-11, initial.dump());
  }
  BOOST_TEST(std::abs(start({{"v_C", 0.5}}, {"v_C"})[1] - 1.5) < 1e-11);
}

BOOST_AUTO_TEST_CASE(a_quantity_that_is_not_kept_is_told) {
  // Two capacitors side by side have one voltage.
  Json document = circuit({{"v_C", 0.5}, {"v_C2", 1.0}});
  document["system"]["elements"].push_back(
      {{"type", "capacitor"}, {"name", "C2"}, {"from", "c"}, {"to", "0"}, {"value", 1}});
  const auto ladder = consistent_start(read_experiment_document(document));
  std::vector<std::string> moved;
  for (const Movement& move : ladder.moves) moved.push_back(move.name);
  BOOST_TEST((std::ranges::find(moved, "v_C2") != moved.end()));
  document["hold"] = {"v_C2", "v_C"};
  BOOST_CHECK_THROW(consistent_start(read_experiment_document(document)), ExperimentError);
  BOOST_CHECK_THROW(start({{"v_Cc", 1}}), ExperimentError);
}

// x - 0.3 is 5.6e-17 at the double next to 0.1 + 0.2: no other value than 0, also where that is held.
BOOST_AUTO_TEST_CASE(rounding_of_a_zero_is_no_other_value) {
  const auto moves = [](double x) {
    return consistent_start(
               read_experiment_document({{"system",
                                          {{"type", "lagrangian"},
                                           {"coordinates", {"x"}},
                                           {"definitions", {{"d", "x - 0.3"}}},
                                           {"lagrangian", "x'^2/2"}}},
                                         {"initial", {{"x", x}, {"d", 0}, {"rest", true}}},
                                         {"hold", {"d"}}}))
        .moves;
  };
  BOOST_TEST(moves(0.1 + 0.2).empty());
  BOOST_CHECK_THROW(moves(0.3 + 1e-9), ExperimentError);
}

namespace {

ConsistentStart start_of(const char* nodes, const char* elements, const char* initial,
                         const Json& hold = nullptr) {
  Json document = {
      {"system",
       {{"type", "network"}, {"nodes", Json::parse(nodes)}, {"elements", Json::parse(elements)}}},
      {"initial", Json::parse(initial)}};
  if (!hold.is_null()) document["hold"] = hold;
  return consistent_start(read_experiment_document(document));
}

const char* const kTwoCapacitors = R"json([
  { "type": "capacitor", "name": "C1", "from": "a", "to": "0", "value": 2e-6 },
  { "type": "capacitor", "name": "C2", "from": "a", "to": "0", "value": 4e-6 },
  { "type": "inductor", "name": "L", "from": "a", "to": "d", "value": 0.1 },
  { "type": "resistor", "name": "R", "from": "d", "to": "0", "value": 1000 } ])json";

}  // namespace

// What stores have is conserved by the impulse, whether it is typed or follows from what is typed: the voltage afterwards
// is (2 µF 6 V + 4 µF 0 V)/6 µF, the velocity that of both masses, the current that of both fluxes.
BOOST_AUTO_TEST_CASE(contradictory_quantities_are_where_an_impulse_begins) {
  for (const char* const initial :
       {R"({ "v_C1": 6, "v_C2": 0 })", R"({ "q_C1": 12e-6, "v_C2": 0 })",
        R"({ "v_C1": 6, "q_C2": 0 })", R"({ "v_C1": 6, "v_C2": 0, "potential_d": 3 })",
        R"({ "q_C1": 12e-6, "q_C2": 0, "v_R": 3 })"}) {
    const auto found = start_of(R"(["0", "a", "d"])", kTwoCapacitors, initial);
    BOOST_TEST(found.is_impulse, initial);
    BOOST_TEST(std::abs(found.point.x[0] - 4e-6) < 1e-15, initial);
    BOOST_TEST(std::abs(found.point.x[1] - 8e-6) < 1e-15, initial);
  }
  const auto collision = start_of(R"(["0", "a", "b"])", R"json([
    { "type": "mass", "name": "M1", "at": "a", "value": 2 },
    { "type": "mass", "name": "M2", "at": "b", "value": 6 },
    { "type": "velocity-source", "name": "U", "from": "a", "to": "b", "value": 0 } ])json",
                                  R"({ "v_M1": 4, "v_M2": 0 })");
  BOOST_TEST((collision.point.x - VectorXd{{2.0, 6.0}}).norm() < 1e-12);
  const auto coils = start_of(R"(["0", "b", "c"])", R"json([
    { "type": "inductor", "name": "L1", "from": "0", "to": "b", "value": 1 },
    { "type": "inductor", "name": "L2", "from": "b", "to": "c", "value": 3 },
    { "type": "resistor", "name": "R", "from": "c", "to": "0", "value": 1 } ])json",
                              R"({ "i_L1": 2, "i_L2": 0 })");
  BOOST_TEST((coils.point.x - VectorXd{{0.5, 1.5}}).norm() < 1e-12);
  // T = T₀ exp (S/C): the entropy 100 ln (400/300) is that of 400 J/K at 300 (4/3)^(1/4) K.
  const auto heat = start_of(R"(["0", "a"])", R"json([
    { "type": "heat-capacity", "name": "H1", "at": "a", "value": 100 },
    { "type": "heat-capacity", "name": "H2", "at": "a", "value": 300 } ])json",
                             R"({ "T_H1": 400, "T_H2": 300 })");
  const double each = 0.25 * std::log(4.0 / 3.0);
  BOOST_TEST((heat.point.x - VectorXd{{100.0 * each, 300.0 * each}}).norm() < 1e-10);
}

// The currents of coupled coils, φ = (4 1; 1 1) i, are functions of both fluxes: one of them alone determines none.
BOOST_AUTO_TEST_CASE(as_many_quantities_as_coordinates_determine_them) {
  const char* const coupled = R"json([
    { "type": "inductor", "name": "L1", "from": "0", "to": "b", "value": 4 },
    { "type": "inductor", "name": "L2", "from": "c", "to": "0", "value": 1 },
    { "type": "mutual-inductance", "name": "K", "inductors": ["L1", "L2"], "value": 1 },
    { "type": "resistor", "name": "R1", "from": "b", "to": "0", "value": 1 },
    { "type": "resistor", "name": "R2", "from": "c", "to": "0", "value": 1 } ])json";
  const char* const nodes = R"(["0", "b", "c"])";
  const auto both = start_of(nodes, coupled, R"({ "i_L1": 2, "i_L2": -1 })");
  BOOST_TEST((both.point.x - VectorXd{{7.0, 1.0}}).norm() < 1e-12);
  const auto mixed = start_of(nodes, coupled, R"({ "i_L1": 2, "phi_L2": 5 })");
  BOOST_TEST((mixed.point.x - VectorXd{{11.0, 5.0}}).norm() < 1e-12);
  // The least fluxes with φ₁ - φ₂ = 3 · 2.
  const auto one = start_of(nodes, coupled, R"({ "i_L1": 2 })");
  BOOST_TEST((one.point.x - VectorXd{{3.0, -3.0}}).norm() < 1e-11);
}

BOOST_AUTO_TEST_CASE(a_quantity_that_is_held_is_kept_and_others_follow) {
  const char* const nodes = R"(["0", "a", "d"])";
  const auto start = [&](const char* initial, const Json& hold) {
    return start_of(nodes, kTwoCapacitors, initial, hold).point.x;
  };
  const char* const two = R"({ "v_C1": 6, "v_C2": 3 })";
  BOOST_TEST((start(two, {"v_C1"}).head(2) - VectorXd{{12e-6, 24e-6}}).norm() < 1e-15);
  BOOST_TEST((start(two, {"v_C2"}).head(2) - VectorXd{{6e-6, 12e-6}}).norm() < 1e-15);
  BOOST_CHECK_THROW(start(two, {"v_C1", "v_C2"}), ExperimentError);
  // Two words for one voltage.
  const VectorXd x = start(R"({ "v_C1": 6, "potential_a": 3 })", {"v_C1"});
  BOOST_TEST((x.head(2) - VectorXd{{12e-6, 24e-6}}).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(rest_is_no_velocity) {
  const auto point = [](const char* system, const Json& initial) {
    return consistent_start(
               read_experiment_document({{"system", Json::parse(system)}, {"initial", initial}}))
        .point;
  };
  const char* const mechanical =
      R"json({ "type": "mechanical", "coordinates": ["x", "y"], "potential": "y" })json";
  BOOST_TEST(point(mechanical, {{"x", 1}, {"y", 2}, {"rest", true}}).x == (VectorXd{{1, 2, 0, 0}}));
  BOOST_TEST(point(mechanical, {{"x", 1}, {"y", 2}, {"p_x", 3}, {"rest", true}}).x ==
             (VectorXd{{1, 2, 3, 0}}));
  // A velocity by an equation, x' - v.
  const char* const implicit =
      R"json({ "type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["l"],
    "equations": ["x' - v", "y' - w", "v' + l*x", "w' + l*y + 1", "x^2 + y^2 - 1"] })json";
  const auto pendulum = point(implicit, {{"x", 0.6}, {"y", -0.8}, {"rest", true}});
  BOOST_TEST(pendulum.x == (VectorXd{{0.6, -0.8, 0, 0}}));
  BOOST_CHECK_THROW(
      point(R"json({ "type": "implicit", "coordinates": ["x"], "equations": ["x' + x"] })json",
            "rest"),
      ExperimentError);
  // All of a network that is not given is 0.
  BOOST_TEST(start("rest").isZero(0.0));
  // Of a rotation the velocity has three numbers, and its matrix nine.
  const char* const body =
      R"json({ "type": "mechanical", "coordinates": ["R[3][3]"], "manifold": "so3",
    "metric": [1, 2, 3] })json";
  const Json one = Json::parse("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
  BOOST_TEST(point(body, {{"R", one}, {"rest", true}}).x.tail(3).isZero(0.0));
  BOOST_TEST(point(body, {{"R", one}, {"rest", true}, {"p_R", {1, 2, 3}}}).x.tail(3) ==
             (VectorXd{{1, 2, 3}}));
  BOOST_TEST((point(body, {{"R", one}, {"rest", true}, {"v_R", {1, 1, 1}}}).x.tail(3) -
              VectorXd{{1, 2, 3}})
                 .norm() < 1e-14);
}

namespace {

// A pendulum with the angle from the lowest point beside its coordinates.
Json pendulum(const Json& initial) {
  return {{"system",
           {{"type", "mechanical"},
            {"coordinates", {"x", "y"}},
            {"potential", "9.81*y"},
            {"definitions", {{"angle", "atan2(x, -y)"}}},
            {"holonomic", "x^2 + y^2 - 1"}}},
          {"initial", initial}};
}

}  // namespace

// Momenta that come out of the search for positions as round-off were given by nobody.
BOOST_AUTO_TEST_CASE(a_position_is_no_momentum) {
  const auto start = [](const Json& initial) {
    return consistent_start(read_experiment_document(pendulum(initial)));
  };
  BOOST_CHECK_EXCEPTION(
      start({{"x", 0.6}, {"angle", 0.6435}}), ExperimentError, [](const ExperimentError& error) {
        return std::string(error.what()).find("nothing determines p_x, p_y") != std::string::npos;
      });
  const ConsistentStart resting = start({{"x", 0.6}, {"angle", 0.6435}, {"rest", true}});
  BOOST_TEST(resting.point.x.tail(2) == VectorXd::Zero(2));
  // x x' + y y' = 0.
  const VectorXd moving = start({{"x", 0.6}, {"angle", 0.6435}, {"y'", 0.3}}).point.x;
  BOOST_TEST(std::abs(moving[2] + moving[1] * moving[3] / moving[0]) < 1e-12);
  BOOST_TEST(std::abs(moving[3] - 0.3) < 1e-6);
}

// Equations of what is given alone move nothing, however far from a solution they are.
BOOST_AUTO_TEST_CASE(a_quantity_of_given_coordinates_is_told) {
  for (const double angle : {0.6, 0.9, 3.0}) {
    const ConsistentStart start = consistent_start(read_experiment_document(
        pendulum({{"x", 0.6}, {"y", -0.8}, {"angle", angle}, {"rest", true}})));
    BOOST_TEST((start.point.x.head(2) - VectorXd{{0.6, -0.8}}).norm() == 0.0);
    BOOST_REQUIRE_EQUAL(start.moves.size(), 1U);
    BOOST_TEST(start.moves[0].name == "angle");
    BOOST_TEST(std::abs(start.moves[0].to - std::atan2(0.6, 0.8)) < 1e-15);
  }
  // (2, -2) goes to the nearest point of the circle.
  const ConsistentStart far = consistent_start(
      read_experiment_document(pendulum({{"x", 2}, {"y", -2}, {"angle", 0.9}, {"rest", true}})));
  BOOST_TEST((far.point.x.head(2) - VectorXd{{std::sqrt(0.5), -std::sqrt(0.5)}}).norm() < 1e-9);
}

// Four bars in a plane that close, all angles given: the last is the joint that closes the loop, no coordinate.
BOOST_AUTO_TEST_CASE(all_angles_of_a_loop_may_be_given) {
  const auto bar = [] { return Json{{"mass", 1}, {"center", {0.5, 0}}}; };
  const auto joint = [](const char* parent, const char* child, double origin) {
    return Json{
        {"type", "revolute"}, {"parent", parent}, {"child", child}, {"origin", {origin, 0, 0}}};
  };
  Json closing = joint("b", "c", 1);
  closing["child_origin"] = {1, 0, 0};
  const auto start = [&](double C) {
    return consistent_start(read_experiment_document(
        {{"system",
          {{"type", "mechanism"},
           {"plane", true},
           {"bodies", {{"a", bar()}, {"b", bar()}, {"c", bar()}}},
           {"joints",
            {{"A", joint("ground", "a", 0)},
             {"B", joint("a", "b", 1)},
             {"C", joint("ground", "c", 1)},
             {"D", closing}}}}},
         {"initial", {{"A", 1.2}, {"B", -1.2}, {"C", C}, {"D", 1.2}, {"rest", true}}}}));
  };
  // A parallelogram.
  const VectorXd closed = start(1.2).point.x;
  BOOST_TEST((closed.head(3) - VectorXd{{1.2, -1.2, 1.2}}).norm() == 0.0);
  BOOST_TEST(closed.tail(3) == VectorXd::Zero(3));
  // One that is open by some 0.05: what moves is told, and it closes.
  const ConsistentStart open = start(1.25);
  const VectorXd q = open.point.x.head(3);
  BOOST_TEST(std::abs(std::cos(q[0]) + std::cos(q[0] + q[1]) - 1.0 - std::cos(q[2])) < 1e-9);
  BOOST_TEST(std::abs(std::sin(q[0]) + std::sin(q[0] + q[1]) - std::sin(q[2])) < 1e-9);
  BOOST_TEST((q - VectorXd{{1.2, -1.2, 1.25}}).norm() < 0.05);
}

namespace {

// A particle of mass 2, also on a circle, with its velocities and the square of its speed by names.
Json particle(const Json& initial, bool is_on_circle) {
  Json document = {{"system",
                    {{"type", "mechanical"},
                     {"coordinates", {"x", "y"}},
                     {"metric", 2},
                     {"potential", "19.62*y"},
                     {"definitions", {{"vx", "x'"}, {"vy", "y'"}, {"square", "x'^2 + y'^2"}}}}},
                   {"initial", initial}};
  if (is_on_circle) document["system"]["holonomic"] = "x^2 + y^2 - 1";
  return document;
}

ConstraintLadder start_of_particle(Json initial, bool is_on_circle) {
  initial["x"] = 0.6;
  initial["y"] = -0.8;
  return consistent_start(read_experiment_document(particle(initial, is_on_circle)));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_velocity_of_zero_is_a_value) {
  for (const double vx : {0.0, 1e-17}) {
    const VectorXd x = start_of_particle({{"vx", vx}, {"vy", 1}}, false).point.x;
    BOOST_TEST(x == Eigen::Vector4d(0.6, -0.8, 2.0 * vx, 2.0), vx);
  }
  BOOST_TEST(start_of_particle({{"vx", 0}}, true).point.x == Eigen::Vector4d(0.6, -0.8, 0, 0));
}

// (1, 0.75) along the circle, with the length that the square of the speed has.
BOOST_AUTO_TEST_CASE(a_speed_is_met_near_given_velocities) {
  const VectorXd p =
      start_of_particle({{"x'", 1}, {"y'", 0.75}, {"square", 1.6}}, true).point.x.tail(2);
  BOOST_TEST((p - std::sqrt(1.6) * Eigen::Vector2d(1.6, 1.2)).norm() < 1e-9);
}

// H is a quantity as others: it is met near the velocities that are given, and without any it tells no way.
BOOST_AUTO_TEST_CASE(an_energy_is_met) {
  const auto point = [](const Json& system, const Json& initial) {
    return consistent_start(read_experiment_document({{"system", system}, {"initial", initial}}))
        .point.x;
  };
  const Json by_angle = {
      {"type", "mechanical"}, {"coordinates", {"q"}}, {"potential", "1 - cos(q)"}};
  const VectorXd p =
      start_of_particle({{"x'", 1}, {"y'", 0.75}, {"H", 1.6 - 0.8 * 19.62}}, true).point.x.tail(2);
  BOOST_TEST((p - std::sqrt(1.6) * Eigen::Vector2d(1.6, 1.2)).norm() < 1e-9);
  BOOST_CHECK_THROW(point(by_angle, {{"q", 0.5}, {"H", 2}}), ExperimentError);
  // A word of the system's own comes first, and an equation has no energy.
  const Json own = {{"type", "implicit"}, {"coordinates", {"H"}}, {"equations", {"H' + H"}}};
  BOOST_TEST(point(own, {{"H", 3}})[0] == 3.0);
  const Json none = {{"type", "implicit"}, {"coordinates", {"x"}}, {"equations", {"x' + x"}}};
  BOOST_CHECK_THROW(point(none, {{"x", 3}, {"H", 3}}), ExperimentError);
}

// At rest nothing tells which way a speed is.
BOOST_AUTO_TEST_CASE(a_speed_at_rest_is_an_error) {
  for (const bool is_on_circle : {false, true})
    for (const Json& initial : {Json{{"square", 2}}, Json{{"square", 2}, {"rest", true}}})
      BOOST_CHECK_EXCEPTION(
          start_of_particle(initial, is_on_circle), ExperimentError, [](const auto& error) {
            return std::string(error.what()).find("does not change to first order") !=
                   std::string::npos;
          });
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
