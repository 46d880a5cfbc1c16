// Each element of networks, in a network of SI values whose motion is known in closed form.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

#include "courant/reading/network_element.hpp"
#include "courant/running/run_files.hpp"
#include "run_in.hpp"

namespace courant::test {
BOOST_AUTO_TEST_SUITE(network_elements)

namespace {

struct Case {
  const char* nodes;
  const char* elements;
  const char* initial;
  double end;
  std::vector<std::pair<std::string, double>> expected;  // at the end
};

double e(double a) { return std::exp(-a); }

// Where sources are on from the beginning, at rest.
const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      // Current source, resistor and capacitor
      {R"(["0", "a"])",
       R"json([{"type":"current-source","name":"I1","from":"0","to":"a","value":0.002},
          {"type":"resistor","name":"R1","from":"a","to":"0","value":500},
          {"type":"capacitor","name":"C1","from":"a","to":"0","value":1e-06}])json",
       R"({})",
       0.001,
       {{"potential_a", 1 - e(2)}}},
      // Inductor
      {R"(["0", "a", "b"])",
       R"json([{"type":"voltage-source","name":"V1","from":"a","to":"0","value":5},
          {"type":"resistor","name":"R1","from":"a","to":"b","value":100},
          {"type":"inductor","name":"L1","from":"b","to":"0","value":0.001}])json",
       R"({})",
       2e-05,
       {{"i_R1", 0.05 * (1 - e(2))}}},
      // Mutual inductance
      {R"(["0", "a", "b"])",
       R"json([{"type":"voltage-source","name":"V1","from":"a","to":"0","value":5},
          {"type":"inductor","name":"L1","from":"a","to":"0","value":0.004},
          {"type":"inductor","name":"L2","from":"b","to":"0","value":0.001},
          {"type":"mutual-inductance","name":"K1","inductors":["L1","L2"],"value":0.001},
          {"type":"voltage-source","name":"V2","from":"b","to":"0","value":0}])json",
       R"({})",
       0.001,
       {{"i_L1", 5e-3 / 3e-3}, {"i_L2", -5e-3 / 3e-3}}},
      // Diode
      {R"(["0", "a", "b"])",
       R"json([{"type":"current-source","name":"I1","from":"0","to":"a","value":0.001},
          {"type":"diode","name":"D1","from":"a","to":"0","saturation":1e-14,"emission":1.5},
          {"type":"resistor","name":"R1","from":"b","to":"0","value":1000.0},
          {"type":"capacitor","name":"C1","from":"b","to":"0","value":1e-06}])json",
       R"({})",
       0.0001,
       {{"v_D1", 1.5 * 0.025852 * std::log1p(1e11)}}},
      // Bipolar transistor as a diode, whose current is saturation (1 + 1/gain) (exp (v/V_T) - 1)
      {R"(["0", "a", "b"])",
       R"json([{"type":"current-source","name":"I1","from":"0","to":"a","value":0.001},
          {"type":"bipolar-transistor","name":"Q1","collector":"a","base":"a","emitter":"0","forward_gain":50},
          {"type":"resistor","name":"R1","from":"b","to":"0","value":1000.0},
          {"type":"capacitor","name":"C1","from":"b","to":"0","value":1e-06}])json",
       R"({})",
       0.0001,
       {{"v_Q1_be", 0.025852 * std::log1p(1e13 / 1.02)}}},
      // Field-effect transistor that empties a capacitor from a = 2 V, where it ceases to be saturated:
      // v = 2 a/(1 + exp (β a t/C))
      {R"(["0", "a", "g"])",
       R"json([{"type":"voltage-source","name":"V1","from":"g","to":"0","value":3},
          {"type":"mos-transistor","name":"M1","drain":"a","gate":"g","source":"0","bulk":"0","threshold":1,"transconductance":1e-3},
          {"type":"capacitor","name":"C1","from":"a","to":"0","value":1e-9}])json",
       R"({"q_C1": 2e-9})",
       1e-6,
       {{"potential_a", 4.0 / (1.0 + std::exp(2.0))}}},
      // Ideal transformer
      {R"(["0", "a", "b", "c"])",
       R"json([{"type":"voltage-source","name":"V1","from":"a","to":"0","value":6},
          {"type":"ideal-transformer","name":"T1","from":"a","to":"0","secondary":["b","0"],"ratio":3},
          {"type":"resistor","name":"R1","from":"b","to":"c","value":2},
          {"type":"inductor","name":"L1","from":"c","to":"0","value":0.5}])json",
       R"({})",
       0.25,
       {{"i_R1", 1 - e(1)}, {"i_T1_1", (1 - e(1)) / 3}, {"v_T1_2", 2.0}}},
      // Gyrator
      {R"(["0", "a", "b"])",
       R"json([{"type":"voltage-source","name":"V1","from":"a","to":"0","value":5},
          {"type":"gyrator","name":"G1","from":"a","to":"0","secondary":["b","0"],"value":100},
          {"type":"capacitor","name":"C1","from":"b","to":"0","value":0.001}])json",
       R"({})",
       0.01,
       {{"q_C1", -5e-4}, {"i_G1_1", 5e-3}}},
      // Switch
      {R"(["0", "a"])",
       R"json([{"type":"capacitor","name":"C1","from":"a","to":"0","value":1e-06},
          {"type":"switch","name":"S1","from":"a","to":"0","closed":"t > 1e-3","on":1000.0}])json",
       R"({"q_C1": 5e-06})",
       0.002,
       {{"potential_a", 5 * e(1)}}},
      // Mass, damper and force
      {R"(["0", "a"])",
       R"json([{"type":"mass","name":"M1","at":"a","value":2},
          {"type":"damper","name":"D1","from":"a","to":"0","value":3},
          {"type":"force-source","name":"F1","from":"0","to":"a","value":12}])json",
       R"({})",
       0.5,
       {{"v_M1", 4 * (1 - e(0.75))}}},
      // Friction
      {R"(["0", "a"])",
       R"json([{"type":"mass","name":"M1","at":"a","value":2},
          {"type":"friction","name":"F1","from":"a","to":"0","value":3}])json",
       R"({"p_M1": 2})",
       0.4,
       {{"v_M1", 0.4}}},
      // Velocity source and spring
      {R"(["0", "a"])",
       R"json([{"type":"velocity-source","name":"V1","from":"a","to":"0","value":0.2},
          {"type":"spring","name":"K1","from":"a","to":"0","value":100}])json",
       R"({})",
       0.5,
       {{"x_K1", 0.1}, {"F_V1", -10.0}}},
      // Torque source, inertia, gear
      {R"(["0", "a", "b"])",
       R"json([{"type":"torque-source","name":"T1","from":"0","to":"a","value":6},
          {"type":"inertia","name":"J1","at":"a","value":0.5},
          {"type":"gear","name":"G1","from":"a","to":"b","ratio":2},
          {"type":"inertia","name":"J2","at":"b","value":1}])json",
       R"({})",
       1.0,
       {{"omega_J1", 8.0}, {"omega_J2", 4.0}}},
      // Rotational damper
      {R"(["0", "a"])",
       R"json([{"type":"torque-source","name":"T1","from":"0","to":"a","value":6},
          {"type":"inertia","name":"J1","at":"a","value":0.5},
          {"type":"rotational-damper","name":"D1","from":"a","to":"0","value":2}])json",
       R"({})",
       0.25,
       {{"omega_J1", 3 * (1 - e(1))}}},
      // Speed source and torsion spring
      {R"(["0", "a", "b"])",
       R"json([{"type":"speed-source","name":"S1","from":"a","to":"0","value":2},
          {"type":"torsion-spring","name":"C1","from":"a","to":"b","value":9},
          {"type":"inertia","name":"J1","at":"b","value":0.25}])json",
       R"({})",
       0.3,
       {{"omega_J1", 2 * (1 - std::cos(1.8))}}},
      // Dc motor
      {R"(["0", "a", "b", "s"])",
       R"json([{"type":"voltage-source","name":"V1","from":"a","to":"0","value":12},
          {"type":"resistor","name":"R1","from":"a","to":"b","value":3},
          {"type":"dc-motor","name":"M1","from":"b","to":"0","shaft":"s","constant":0.5},
          {"type":"inertia","name":"J1","at":"s","value":0.1}])json",
       R"({})",
       1.2,
       {{"omega_J1", 24 * (1 - e(1))}}},
      // Voice coil
      {R"(["0", "a", "b", "c"])",
       R"json([{"type":"voltage-source","name":"V1","from":"a","to":"0","value":4},
          {"type":"resistor","name":"R1","from":"a","to":"b","value":8},
          {"type":"voice-coil","name":"K1","from":"b","to":"0","cone":"c","constant":2},
          {"type":"mass","name":"M1","at":"c","value":0.01}])json",
       R"({})",
       0.02,
       {{"v_M1", 2 * (1 - e(1))}}},
      // Electromagnet
      {R"(["0", "a", "x"])",
       R"json([{"type":"voltage-source","name":"V1","from":"a","to":"0","value":3},
          {"type":"electromagnet","name":"M1","from":"a","to":"0","armature":"x","inductance":"0.5/(1 + x_M1/0.1)"},
          {"type":"mass","name":"P1","at":"x","value":2}])json",
       R"({})",
       0.4,
       {{"phi_M1", 1.2}, {"p_P1", -1.92}}},
      // Tank, pipe and pump
      {R"(["0", "a"])",
       R"json([{"type":"tank","name":"T1","at":"a","area":2},
          {"type":"pipe","name":"P1","from":"a","to":"0","value":1000000.0},
          {"type":"flow-source","name":"Q1","from":"0","to":"a","value":0.001}])json",
       R"({})",
       200,
       {{"V_T1", 1e-3 * 2e6 / 9810 * (1 - e(9810 * 200 / 2e6))}}},
      // Inertance
      {R"(["0", "a", "b"])",
       R"json([{"type":"pressure-source","name":"P1","from":"a","to":"0","value":200000.0},
          {"type":"inertance","name":"I1","from":"a","to":"b","value":10000000.0},
          {"type":"pipe","name":"R1","from":"b","to":"0","value":100000000.0}])json",
       R"({})",
       0.1,
       {{"Q_I1", 2e-3 * (1 - e(1))}}},
      // Heat source
      {R"(["0", "a"])",
       R"json([{"type":"heat-capacity","name":"C1","at":"a","value":50,"temperature":290},
          {"type":"heat-source","name":"P1","at":"a","value":200}])json",
       R"({})",
       10,
       {{"T_C1", 330.0}}},
      // Thermal conductor
      {R"(["0", "a", "b"])",
       R"json([{"type":"temperature-source","name":"T1","from":"a","to":"0","value":350},
          {"type":"thermal-conductor","name":"G1","from":"a","to":"b","value":5},
          {"type":"heat-capacity","name":"C1","at":"b","value":50,"temperature":290}])json",
       R"({})",
       10,
       {{"T_C1", 350 - 60 * e(1)}}},
  };
  return all;
}

}  // namespace

// The midpoint rule is good to 1e-5 with 200 steps of these; by both methods.
BOOST_AUTO_TEST_CASE(closed_forms) {
  for (const Case& of : cases())
    for (const char* method : {"discretize-first", "constrain-first"})
      BOOST_TEST_CONTEXT(of.elements << " by " << method) {
        Json experiment = {{"system",
                            {{"type", "network"},
                             {"nodes", Json::parse(of.nodes)},
                             {"elements", Json::parse(of.elements)}}},
                           {"initial", Json::parse(of.initial)},
                           {"method", method},
                           {"time", {{"step", of.end / 200.0}, {"end", of.end}}},
                           {"observe", Json::object()},
                           {"expect", {{{"max_stage_imbalance", 1e-12}}}}};
        for (const auto& [name, value] : of.expected) experiment["observe"]["is_" + name] = name;
        const TemporaryFolder folder;
        const RunOutcome outcome = run_in(folder, experiment);
        BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), outcome.message);
        BOOST_TEST(outcome.as_expected());
        BOOST_TEST(outcome.summary.warnings.empty());
        const TrajectoryTable trajectory = read_run(folder / "run").trajectory;
        for (const auto& [name, value] : of.expected)
          BOOST_TEST(
              std::abs(trajectory.column("is_" + name).back() - value) < 1.5e-5 * std::abs(value),
              name << " is " << trajectory.column("is_" + name).back() << ", not " << value);
      }
}

BOOST_AUTO_TEST_CASE(no_element_is_missing) {
  std::set<std::string> known = {"port"};  // of interconnections, see there
  for (const Case& of : cases())
    for (const Json& element : Json::parse(of.elements))
      known.insert(element.at("type").get<std::string>());
  for (const auto& kind : element_kinds().descriptions())
    BOOST_TEST(known.contains(kind.type), kind.type);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::test
