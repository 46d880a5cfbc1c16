#include "courant/running/other_values.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {
BOOST_AUTO_TEST_SUITE(other_values_test)

namespace {

LadderReport report(const char* unknowns, const char* equations, const char* initial) {
  const Experiment experiment = read_experiment(
      std::string(R"({"system": {"type": "implicit", "coordinates": ["x", "v"], "unknowns": )") +
      unknowns + R"(, "equations": )" + equations + R"(}, "initial": )" + initial + "}");
  return report_of_start(experiment, consistent_start(experiment));
}

}  // namespace

// x² + y² = 1 at x = 0: y = 1 and y = -1.
BOOST_AUTO_TEST_CASE(the_other_branch_is_told) {
  const char* const circle = R"(["x' - v", "v' + y - x", "x^2 + y^2 - 1"])";
  const auto found = report(R"(["y"])", circle, R"({"x": 0, "v": 1})");
  BOOST_TEST_REQUIRE(found.choices.size() == 1u);
  BOOST_TEST(found.choices[0].name == "y");
  BOOST_TEST(std::abs(std::abs(found.choices[0].from) - 1.0) < 1e-12);
  BOOST_TEST(std::abs(found.choices[0].from + found.choices[0].to) < 1e-12);
  BOOST_TEST(read_ladder_report(to_json(found)).choices.size() == 1u);
  // What is given was chosen.
  BOOST_TEST(report(R"(["y"])", circle, R"({"x": 0, "v": 1, "y": 1})").choices.empty());
}

BOOST_AUTO_TEST_CASE(an_unknown_that_has_one_value_is_none) {
  BOOST_TEST(report(R"(["y"])", R"(["x' - v", "v' + y - x", "2*y - x - 3"])", R"({"x": 0, "v": 1})")
                 .choices.empty());
  BOOST_TEST(report(R"(["y"])", R"(["x' - v", "v' + y - x", "y^3 + y - 2"])", R"({"x": 0, "v": 1})")
                 .choices.empty());
}

// y² = 4, in which y stands alone: also of the solution with the other values of all else, -y alone is another one.
BOOST_AUTO_TEST_CASE(the_branch_of_an_unknown_that_stands_alone_is_told) {
  const auto found =
      report(R"(["y"])", R"(["x' - v", "v' + x", "y^2 - 4"])", R"({"x": 0, "v": 1})");
  BOOST_TEST_REQUIRE(found.choices.size() == 1u);
  BOOST_TEST(std::abs(found.choices[0].from + found.choices[0].to) < 1e-12);
}

// Charges of junctions grow with their voltages, currents of resistors are linear: each charge has one voltage, and all
// else follows. In coulombs its equation has terms of 10⁻¹² C, which are not round-off of volts beside them.
BOOST_AUTO_TEST_CASE(an_equation_of_small_numbers_vanishes_next_to_its_own_terms) {
  const Experiment pair = read_experiment(R"({
    "system": {"type": "network", "nodes": ["0", "vcc", "vee", "c1", "e", "c2"], "elements": [
      {"type": "voltage-source", "name": "Vcc", "from": "vcc", "to": "0", "value": 12.0},
      {"type": "voltage-source", "name": "Vee", "from": "vee", "to": "0", "value": -12.0},
      {"type": "bipolar-transistor", "name": "Q1", "collector": "c1", "base": "0", "emitter": "e",
       "polarity": "npn", "saturation": 2e-15, "thermal_voltage": 0.02586492, "leak": 1e-12,
       "forward_gain": 200, "emitter_capacitance": 1e-12, "emitter_junction": 0.75,
       "emitter_grading": 0.33, "forward_transit": 0, "collector_capacitance": 5e-13,
       "collector_junction": 0.75, "collector_grading": 0.33, "reverse_transit": 0},
      {"type": "bipolar-transistor", "name": "Q2", "collector": "c2", "base": "0", "emitter": "e",
       "polarity": "npn", "saturation": 2e-15, "thermal_voltage": 0.02586492, "leak": 1e-12,
       "forward_gain": 200, "emitter_capacitance": 1e-12, "emitter_junction": 0.75,
       "emitter_grading": 0.33, "forward_transit": 0, "collector_capacitance": 5e-13,
       "collector_junction": 0.75, "collector_grading": 0.33, "reverse_transit": 0},
      {"type": "resistor", "name": "Rc1", "from": "vcc", "to": "c1", "value": 5000},
      {"type": "resistor", "name": "Rc2", "from": "vcc", "to": "c2", "value": 5000},
      {"type": "resistor", "name": "Re", "from": "e", "to": "vee", "value": 5600}]},
    "initial": {"q_be_Q1": 8.777197738836217e-13, "q_bc_Q1": -2.1115218119432853e-12,
                "q_be_Q2": 8.777197738836217e-13, "q_bc_Q2": -2.1115218119432853e-12}})");
  BOOST_TEST(report_of_start(pair, consistent_start(pair)).choices.empty());
}

// The current of a load beside a capacitor that keeps the voltage of its supply away is 0 at the operating point.
BOOST_AUTO_TEST_CASE(round_off_is_no_other_solution) {
  const Experiment amplifier = read_experiment(R"json({
    "system": {"type": "network", "nodes": ["0", "vcc", "in", "b", "c", "e", "out", "q1_rc_inside", "q1_rb_inside"],
      "elements": [
      {"type": "voltage-source", "name": "VCC", "from": "vcc", "to": "0", "value": 12.0},
      {"type": "voltage-source", "name": "Vin", "from": "in", "to": "0", "value": "0.01*sin(2*pi*1000*t)"},
      {"type": "capacitor", "name": "C1", "from": "in", "to": "b", "value": 1e-05},
      {"type": "resistor", "name": "R1", "from": "vcc", "to": "b", "value": 47000},
      {"type": "resistor", "name": "R2", "from": "b", "to": "0", "value": 10000},
      {"type": "resistor", "name": "RC", "from": "vcc", "to": "c", "value": 2200},
      {"type": "resistor", "name": "RE", "from": "e", "to": "0", "value": 1000},
      {"type": "capacitor", "name": "CE", "from": "e", "to": "0", "value": 0.0001},
      {"type": "capacitor", "name": "C2", "from": "c", "to": "out", "value": 1e-05},
      {"type": "resistor", "name": "RL", "from": "out", "to": "0", "value": 10000},
      {"type": "resistor", "name": "Q1_rc", "from": "c", "to": "q1_rc_inside", "value": 1},
      {"type": "resistor", "name": "Q1_rb", "from": "b", "to": "q1_rb_inside", "value": 10},
      {"type": "bipolar-transistor", "name": "Q1", "collector": "q1_rc_inside", "base": "q1_rb_inside",
       "emitter": "e", "polarity": "npn", "saturation": 1.434e-14, "thermal_voltage": 0.02586492,
       "leak": 1e-12, "forward_gain": 255.9, "reverse_gain": 6.092, "emitter_leak": 1.434e-14,
       "emitter_leak_emission": 1.307, "early_forward": 74.03, "knee_forward": 0.2847,
       "emitter_capacitance": 2.201e-11, "emitter_junction": 0.75, "emitter_grading": 0.377,
       "forward_transit": 4.111e-10, "collector_capacitance": 7.306e-12, "collector_junction": 0.75,
       "collector_grading": 0.3416, "reverse_transit": 4.691e-08}]},
    "initial": {"q_C1": -2.036542671425003e-05, "q_CE": 0.00013846059735817662, "q_C2": 8.972202068764346e-05,
                "q_be_Q1": 1.8874061654583374e-11, "q_bc_Q1": -3.018964948174021e-11}})json");
  BOOST_TEST(report_of_start(amplifier, consistent_start(amplifier)).choices.empty());
}

// Two transistors that drive each other, without charges of their own: capacitors at the same voltages go with the one on
// or the other.
BOOST_AUTO_TEST_CASE(the_other_state_of_a_multivibrator_is_told) {
  const Experiment astable = read_experiment(R"json({
    "system": {"type": "network", "nodes": ["0", "vcc", "c1", "b2", "b1", "c2"], "elements": [
        {"type": "voltage-source", "name": "Vcc", "from": "vcc", "to": "0", "value": 5.0},
        {"type": "resistor", "name": "R1", "from": "vcc", "to": "c1", "value": 1000.0},
        {"type": "resistor", "name": "R2", "from": "vcc", "to": "b2", "value": 47000.0},
        {"type": "resistor", "name": "R3", "from": "vcc", "to": "b1", "value": 47000.0},
        {"type": "resistor", "name": "R4", "from": "vcc", "to": "c2", "value": 1000.0},
        {"type": "capacitor", "name": "C1", "from": "c1", "to": "b2", "value": 1e-08},
        {"type": "capacitor", "name": "C2", "from": "c2", "to": "b1", "value": 1e-08},
        {"type": "bipolar-transistor", "name": "Q1", "collector": "c1", "base": "b1", "emitter": "0", "polarity": "npn", "saturation": 1e-15, "thermal_voltage": 0.02586492, "leak": 1e-12},
        {"type": "bipolar-transistor", "name": "Q2", "collector": "c2", "base": "b2", "emitter": "0", "polarity": "npn", "saturation": 1e-15, "thermal_voltage": 0.02586492, "leak": 1e-12}]},
    "initial": {"q_C1": 3.1e-8, "q_C2": 4.3e-8}})json");
  const auto found = report_of_start(astable, consistent_start(astable)).choices;
  BOOST_TEST_REQUIRE(!found.empty());
  BOOST_TEST(found[0].name == "v_Q1_be");
  BOOST_TEST(found[0].from < 0.0);  // off
  BOOST_TEST(std::abs(found[0].to - 0.7) < 0.1);
}

// A pendulum of length l on a rod, whose tension is 2 λ l.
BOOST_AUTO_TEST_CASE(formulas_have_parameters_by_name) {
  const Experiment experiment = read_experiment(R"({
    "system": {"type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["lambda"],
               "parameters": {"m": 2, "g": 9.81, "l": 1.5, "wind": 0},
               "equations": ["x' - v", "y' - w", "m*v' + 2*lambda*x - wind*m", "m*w' + 2*lambda*y + m*g",
                             "x^2 + y^2 - l^2"]},
    "initial": {"x": 0.9, "y": -1.2, "v": 0.8, "w": 0.6}})");
  const ConstraintFormulas found = formulas_of_start(experiment, consistent_start(experiment));
  BOOST_TEST_REQUIRE(found.constraints.size() == 2u);
  BOOST_TEST(found.constraints[0].formula == "x^2 + y^2 - l^2");
  BOOST_TEST(found.constraints[1].formula == "x*v + y*w");
  BOOST_TEST_REQUIRE(found.values.size() == 1u);
  BOOST_TEST(found.values[0].formula == "m*(v^2 + w^2 - g*y)/(2*l^2)");
}

// A bound of a sum is an integer and no name.
BOOST_AUTO_TEST_CASE(what_counts_terms_is_a_number) {
  const Experiment experiment = read_experiment(R"json({
    "system": {"type": "implicit", "coordinates": ["x[3]"], "parameters": {"n": 3, "k": 2},
               "equations": ["x[0]' - k*x[1]", "x[1]' + k*x[2]", "sum(i, 0, n - 1, x[i])"]},
    "initial": {"x": [1, 0, -1]}})json");
  const ConstraintFormulas found = formulas_of_start(experiment, consistent_start(experiment));
  BOOST_TEST_REQUIRE(found.velocities.size() == 3u);
  BOOST_TEST(found.velocities[0].formula == "k*x[1]");
}

// That a - b is 0 only the numbers say: x = 0 is a constraint, and y = 0 then too.
BOOST_AUTO_TEST_CASE(formulas_have_numbers_where_names_say_less) {
  const Experiment experiment = read_experiment(R"({
    "system": {"type": "implicit", "coordinates": ["x", "y"], "parameters": {"a": 2, "b": 2},
               "equations": ["x' - b*y", "(a - b)*y' + x"]},
    "initial": {"x": 0, "y": 0}})");
  const ConstraintFormulas found = formulas_of_start(experiment, consistent_start(experiment));
  BOOST_TEST_REQUIRE(found.constraints.size() == 2u);
  BOOST_TEST(found.constraints[0].formula == "x");
  BOOST_TEST(found.constraints[1].formula == "y");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
