#include "courant/running/impulsive_start.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/consistent_start.hpp"
#include "run_in.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(impulsive_start_test)

namespace {

ConsistentStart start(const char* experiment) {
  return consistent_start(read_experiment(experiment));
}

}  // namespace

// 2 µF at 6 V and 4 µF at 0 V: the charge of both, 12 µC, is kept, and 2 V are left.
BOOST_AUTO_TEST_CASE(capacitors_that_are_connected_keep_their_charge) {
  const auto found = start(R"json({
    "system": { "type": "network", "nodes": ["0", "a"], "elements": [
      { "type": "capacitor", "name": "C1", "from": "a", "to": "0", "value": 2e-6 },
      { "type": "capacitor", "name": "C2", "from": "a", "to": "0", "value": 4e-6 },
      { "type": "resistor", "name": "R", "from": "a", "to": "0", "value": 1e5 } ] },
    "initial": { "q_C1": 12e-6, "q_C2": 0 } })json");
  BOOST_TEST(found.is_impulse);
  BOOST_TEST(std::abs(found.point.x[0] - 4e-6) < 1e-17);
  BOOST_TEST(std::abs(found.point.x[1] - 8e-6) < 1e-17);
  BOOST_TEST_REQUIRE(found.moves.size() == 2u);
  BOOST_TEST(found.moves[0].from == 12e-6);
}

BOOST_AUTO_TEST_CASE(rotors_that_are_joined_keep_their_momentum) {
  const auto found = start(R"json({
    "system": { "type": "network", "nodes": ["0", "a"], "elements": [
      { "type": "inertia", "name": "J1", "at": "a", "value": 3 },
      { "type": "inertia", "name": "J2", "at": "a", "value": 1 },
      { "type": "rotational-damper", "name": "D", "from": "a", "to": "0", "value": 0.1 } ] },
    "initial": { "l_J1": 6, "l_J2": -2 } })json");
  BOOST_TEST(found.is_impulse);
  BOOST_TEST(std::abs(found.point.x[0] - 3.0) < 1e-12);
  BOOST_TEST(std::abs(found.point.x[1] - 1.0) < 1e-12);
}

// T = T₀ exp (S/C) is the same of both where S is 100 s and 300 s: the entropy, 15.98 + 3.95, is kept. The search meets
// exponentials that are no doubles in their units.
BOOST_AUTO_TEST_CASE(heat_capacities_that_are_joined_keep_their_entropy) {
  const auto found = start(R"json({
    "system": { "type": "network", "nodes": ["0", "a"], "elements": [
      { "type": "heat-capacity", "name": "H1", "at": "a", "value": 100 },
      { "type": "heat-capacity", "name": "H2", "at": "a", "value": 300 } ] },
    "initial": { "S_H1": 15.9818, "S_H2": 3.95238 } })json");
  BOOST_TEST(found.is_impulse);
  const double s = (15.9818 + 3.95238) / 400.0;
  BOOST_TEST((found.point.x - VectorXd{{100.0 * s, 300.0 * s}}).norm() < 1e-10);
}

// A source of 10 mA in front of coils of 10 µH and L at rest: both have the flux of its impulse, 10 mA 10 µH L/(10 µH + L), of whatever
// size L is. A current that is given stays.
BOOST_AUTO_TEST_CASE(what_is_not_given_begins_at_0) {
  const auto fluxes = [](double L, const Json& initial) {
    Json document = Json::parse(R"json({
      "system": { "type": "network", "nodes": ["0", "a", "b"], "elements": [
        { "type": "current-source", "name": "I", "from": "0", "to": "a", "value": 0.01 },
        { "type": "inductor", "name": "L1", "from": "a", "to": "0", "value": 1e-5 },
        { "type": "inductor", "name": "L2", "from": "a", "to": "b" },
        { "type": "resistor", "name": "R", "from": "b", "to": "0", "value": 47 } ] } })json");
    document["system"]["elements"][2]["value"] = L;
    document["initial"] = initial;
    return consistent_start(read_experiment_document(document)).point.x;
  };
  for (const double L : {1e-5, 2.2e-5, 3.1e-5, 4e-5}) {
    const double flux = 0.01 * 1e-5 * L / (1e-5 + L);
    for (const Json& initial : {Json::object(), Json("rest"), Json{{"phi_L1", 0}, {"phi_L2", 0}}})
      BOOST_TEST((fluxes(L, initial) - VectorXd{{flux, flux}}).norm() < 1e-12 * flux,
                 L << ' ' << initial.dump());
    const VectorXd given{{0.008 * 1e-5, 0.002 * L}};
    for (const Json& initial :
         {Json{{"i_L2", 0.002}}, Json{{"phi_L1", 8e-8}}, Json{{"i_R", 0.002}}})
      BOOST_TEST((fluxes(L, initial) - given).norm() < 1e-12, L << ' ' << initial.dump());
  }
}

// 12 C on 2 F beside 4 F, of which 0 C are given, and 6 F, of which nothing is: 1 V. One voltage that is given is that of all.
BOOST_AUTO_TEST_CASE(a_capacitor_of_which_nothing_is_given_has_no_charge_of_its_own) {
  Json document = Json::parse(R"json({
    "system": { "type": "network", "nodes": ["0", "a"], "elements": [
      { "type": "capacitor", "name": "C1", "from": "a", "to": "0", "value": 2 },
      { "type": "capacitor", "name": "C2", "from": "a", "to": "0", "value": 4 },
      { "type": "capacitor", "name": "C3", "from": "a", "to": "0", "value": 6 },
      { "type": "resistor", "name": "R", "from": "a", "to": "0", "value": 1 } ] },
    "initial": { "q_C1": 12, "q_C2": 0 } })json");
  const VectorXd jumped = consistent_start(read_experiment_document(document)).point.x;
  BOOST_TEST((jumped - VectorXd{{2.0, 4.0, 6.0}}).norm() < 1e-12);
  document["initial"] = {{"q_C1", 12}};
  const VectorXd kept = consistent_start(read_experiment_document(document)).point.x;
  BOOST_TEST((kept - VectorXd{{12.0, 24.0, 36.0}}).norm() < 1e-12);
}

// Of two masses on a rod the momenta move along the reaction, (x, y) of the bob and the opposite of the block's x; nothing that the given
// metric says enters, and the masses do.
BOOST_AUTO_TEST_CASE(momenta_move_along_the_reaction) {
  const auto found = start(R"json({
    "system": { "type": "mechanical", "coordinates": ["s", "x", "y"], "metric": [[5, 0, 0], [0, 1, 0], [0, 0, 1]],
      "potential": "9.81*y", "holonomic": "(x - s)^2 + y^2 - 1" },
    "initial": { "s": 0, "x": 0.6, "y": -0.8, "p_s": 0, "p_x": 1, "p_y": 1 } })json");
  BOOST_TEST(found.is_impulse);
  const VectorXd moved = found.point.x - VectorXd{{0.0, 0.6, -0.8, 0.0, 1.0, 1.0}};
  BOOST_TEST(moved.head(3).norm() < 1e-12);
  BOOST_TEST(std::abs(moved[3] + moved[4]) < 1e-12);              // the momentum along x
  BOOST_TEST(std::abs(moved[4] * -0.8 - moved[5] * 0.6) < 1e-8);  // along the rod
  const double vs = found.point.x[3] / 5.0, vx = found.point.x[4], vy = found.point.x[5];
  BOOST_TEST(std::abs(0.6 * (vx - vs) - 0.8 * vy) < 1e-12);
}

// Positions beside a constraint: no impulse moves them.
BOOST_AUTO_TEST_CASE(positions_move_as_before) {
  const auto found = start(R"json({
    "system": { "type": "mechanical", "coordinates": ["x", "y"], "potential": "y", "holonomic": "x^2 + y^2 - 1" },
    "initial": { "x": 1.2, "y": 0, "p_x": 0, "p_y": 1 } })json");
  BOOST_TEST(!found.is_impulse);
  BOOST_TEST(std::abs(found.point.x[0] - 1.0) < 1e-10);
}

BOOST_AUTO_TEST_CASE(what_is_consistent_and_what_is_weighted_is_left_alone) {
  const char* const consistent = R"json({
    "system": { "type": "network", "nodes": ["0", "a"], "elements": [
      { "type": "capacitor", "name": "C1", "from": "a", "to": "0", "value": 2 },
      { "type": "capacitor", "name": "C2", "from": "a", "to": "0", "value": 4 },
      { "type": "resistor", "name": "R", "from": "a", "to": "0", "value": 1 } ] },
    "initial": { "q_C1": 2, "q_C2": 4 } })json";
  BOOST_TEST(!start(consistent).is_impulse);
  Json weighted = Json::parse(consistent);
  weighted["initial"]["q_C2"] = 0;
  weighted["weights"] = {{"q_C1", 2}};
  BOOST_TEST(!consistent_start(read_experiment_document(weighted)).is_impulse);
}

// At a corner where an equation of no velocity bends, a coordinate jumps and the run goes on: x grows by 1/2 and falls by 1.
BOOST_AUTO_TEST_CASE(a_coordinate_jumps_at_a_corner) {
  const Json experiment = {{"system",
                            {{"type", "implicit"},
                             {"coordinates", {"x", "z"}},
                             {"equations", {"x' - z", "z - if(t < 0.5, 1, -2)"}}}},
                           {"initial", {{"x", 0}}},
                           {"method", "constrain-first"},
                           {"time", {{"step", 0.05}, {"end", 1}, {"corners", {0.5}}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), outcome.message);
  BOOST_TEST(std::abs(final_value(outcome, "x") + 0.5) < 1e-9);
  BOOST_TEST(std::abs(final_value(outcome, "z") + 2.0) < 1e-12);
  BOOST_TEST_REQUIRE(outcome.summary.warnings.size() == 1u);
  BOOST_TEST(outcome.summary.warnings[0].starts_with(
      "At the corner t = 0.5 there is a jump: z from 1 to -2"));
}

// A voltage of 1 V that becomes 3 V across two capacitors of 2 F in a row: 2 C go through both, and what is between them, which only
// the resistor of 1 Ω to the ground changes, keeps its charge. Before and after it 4 v' = -v there.
BOOST_AUTO_TEST_CASE(a_step_of_voltage_across_capacitors) {
  const Json experiment = Json::parse(R"json({
    "system": { "type": "network", "nodes": ["0", "a", "b"], "elements": [
      { "type": "voltage-source", "name": "V", "from": "a", "to": "0", "value": "if(t < 0.5, 1, 3)" },
      { "type": "capacitor", "name": "C1", "from": "a", "to": "b", "value": 2 },
      { "type": "capacitor", "name": "C2", "from": "b", "to": "0", "value": 2 },
      { "type": "resistor", "name": "R", "from": "b", "to": "0", "value": 1 } ] },
    "initial": { "v_C1": 0.25 },
    "method": "constrain-first",
    "time": { "step": 0.005, "end": 1, "corners": [0.5] } })json");
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), outcome.message);
  const double before = 0.75 * std::exp(-0.5 / 4.0), v = (before + 1.0) * std::exp(-0.5 / 4.0);
  BOOST_TEST(std::abs(final_value(outcome, "q_C2") - 2.0 * v) < 1e-5);
  BOOST_TEST(std::abs(final_value(outcome, "q_C1") - 2.0 * (3.0 - v)) < 1e-5);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
