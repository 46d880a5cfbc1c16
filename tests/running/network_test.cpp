#include <boost/test/unit_test.hpp>

#include "../core/files/temporary_folder.hpp"
#include "courant/running/run_files.hpp"
#include "problems.hpp"
#include "run_in.hpp"

namespace courant::test {
BOOST_AUTO_TEST_SUITE(network_runs)

namespace {

// A source of current, a resistor, a capacitor and an inductor side by side, with time, voltage and
// current in these units:
//
//   q' = I sin t - q/(R C) - phi/L,   phi' = q/C
Json system_of(const std::string& type, double time, double volt, double ampere) {
  const Json parameters = {{"R", 2.0 * volt / ampere},
                           {"C", 0.3 * ampere * time / volt},
                           {"L", 0.7 * volt * time / ampere},
                           {"I", ampere},
                           {"w", 1.0 / time}};
  if (type == "network")
    return {{"type", type},
            {"parameters", parameters},
            {"nodes", {"0", "a"}},
            {"elements", Json::parse(R"json([
              {"type":"current-source","name":"I1","from":"0","to":"a","value":"I*sin(w*t)"},
              {"type":"resistor","name":"R1","from":"a","to":"0","value":"R"},
              {"type":"capacitor","name":"C1","from":"a","to":"0","value":"C"},
              {"type":"inductor","name":"L1","from":"a","to":"0","value":"L"}])json")}};
  if (type == "port-hamiltonian")
    return {{"type", type},
            {"parameters", parameters},
            {"coordinates", {"q_C1", "phi_L1"}},
            {"hamiltonian", "q_C1^2/(2*C) + phi_L1^2/(2*L)"},
            {"J", {{0, -1}, {1, 0}}},
            {"R", Json::parse(R"([["1/R", 0], [0, 0]])")},
            {"B", {1, 0}},
            {"ports", "open"},
            {"inputs", {"I*sin(w*t)"}}};
  return {{"type", "implicit"},
          {"parameters", parameters},
          {"coordinates", {"q_C1", "phi_L1"}},
          {"equations", {"q_C1' + q_C1/(R*C) + phi_L1/L - I*sin(w*t)", "phi_L1' - q_C1/C"}},
          {"energy", "q_C1^2/(2*C) + phi_L1^2/(2*L)"}};
}

// A line of resistors, inductors and capacitors, with a capacitor beside its source if that is to be in a
// loop of them.
Json line(double time, bool has_loop) {
  Json nodes = {"0", "n0"}, initial = Json::object();
  Json elements = Json::parse(
      R"json([{"type":"voltage-source","name":"V1","from":"n0","to":"0","value":"cos(0.5*w*t)"}])json");
  const auto add = [&](const char* type, const std::string& name, const std::string& from,
                       const std::string& to, const char* value) {
    elements.push_back(
        {{"type", type}, {"name", name}, {"from", from}, {"to", to}, {"value", value}});
  };
  if (has_loop) add("capacitor", "C0", "n0", "0", "C");
  for (int k = 1; k <= 5; ++k) {
    const std::string i = std::to_string(k), before = "n" + std::to_string(k - 1);
    nodes.push_back("m" + i);
    nodes.push_back("n" + i);
    add("resistor", "R" + i, before, "m" + i, "R");
    add("inductor", "L" + i, "m" + i, "n" + i, "L");
    add("capacitor", "C" + i, "n" + i, "0", "C");
    initial["phi_L" + i] = initial["q_C" + i] = 0;
  }
  add("resistor", "load", "n5", "0", "1");
  return {{"system",
           {{"type", "network"},
            {"parameters", {{"R", 0.01}, {"L", time}, {"C", time}, {"w", 1.0 / time}}},
            {"nodes", nodes},
            {"elements", elements}}},
          {"initial", initial}};
}

// After 50 steps, in the units.
VectorXd end_of(const std::string& type, const Json& method, double time, double volt,
                double ampere) {
  const Problem circuit =
      problem({{"system", system_of(type, time, volt, ampere)},
               {"initial", {{"q_C1", 0.1 * ampere * time}, {"phi_L1", -0.2 * volt * time}}}});
  const VectorXd end = circuit.end(method, 5.0 * time, 50);
  return VectorXd{{end[0] / (ampere * time), end[1] / (volt * time)}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(three_ways_to_one_circuit) {
  for (const Json& method : {method_1("midpoint"), method_2("midpoint")}) {
    const VectorXd network = end_of("network", method, 1.0, 1.0, 1.0);
    for (const char* type : {"port-hamiltonian", "implicit"})
      BOOST_TEST((end_of(type, method, 1.0, 1.0, 1.0) - network).norm() < 1e-13,
                 type << " and network differ");
  }
}

// Nanoseconds and millivolts or hours and kilovolts: the same numbers of them.
BOOST_AUTO_TEST_CASE(units_do_not_matter) {
  for (const Json& method : {method_1("midpoint"), method_2("midpoint")}) {
    const VectorXd unit = end_of("network", method, 1.0, 1.0, 1.0);
    BOOST_TEST((end_of("network", method, 1e-9, 1e-3, 1e-3) - unit).norm() < 1e-12);
    BOOST_TEST((end_of("network", method, 3600.0, 1e3, 1e-9) - unit).norm() < 1e-12);
  }
}

// Charges and fluxes in the unit of time, voltages and currents in units of 1.
BOOST_AUTO_TEST_CASE(units_of_time_do_not_matter_to_many_unknowns) {
  for (const bool has_loop : {false, true})
    for (const Json& method : {method_1("midpoint"), method_2("midpoint")}) {
      const auto end = [&](double time) {
        return VectorXd(problem(line(time, has_loop)).end(method, 5.0 * time, 100) / time);
      };
      const VectorXd unit = end(1.0);
      BOOST_TEST(unit.norm() > 0.5);
      for (const double time : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 1e12})
        BOOST_TEST((end(time) - unit).norm() < 1e-12, method << " moves by "
                                                             << (end(time) - unit).norm()
                                                             << " where the unit is " << time);
    }
}

// A loop of capacitors with a source, by both methods: q_C1 + q_C2 = C V holds for the source
// sin t, and the charges of Method 2 obey it.
BOOST_AUTO_TEST_CASE(a_loop_of_capacitors_and_a_source) {
  const Problem circuit = problem(Json::parse(R"json({"system": {"type": "network",
    "nodes": ["0", "a", "b"], "elements": [
      {"type":"voltage-source","name":"V1","from":"a","to":"0","value":"1e-3*sin(1e9*t)"},
      {"type":"capacitor","name":"C1","from":"a","to":"b","value":1e-12},
      {"type":"capacitor","name":"C2","from":"b","to":"0","value":1e-12},
      {"type":"resistor","name":"R1","from":"b","to":"0","value":500}]},
    "initial": {"q_C1": 0}})json"));
  BOOST_TEST(circuit.ladder.index == 1);
  BOOST_TEST(circuit.ladder.degrees_of_freedom == 1);
  // v_b' 2 C + v_b/R = C V': the particular and the transient solution.
  const double w = 1e9, C = 1e-12, R = 500.0, V = 1e-3, t = 5e-9;
  const double a = 1.0 / (2.0 * R * C), k = 0.5 * V * w / (a * a + w * w);
  const double exact = k * (a * std::cos(w * t) + w * std::sin(w * t) - a * std::exp(-a * t));
  for (const Json& method : {method_1("midpoint"), method_2("midpoint")}) {
    const VectorXd end = circuit.end(method, t, 2000);
    BOOST_TEST(std::abs(end[1] / C - exact) < 1e-5 * V);
    BOOST_TEST(std::abs(end[0] / C + end[1] / C - V * std::sin(w * t)) < 1e-5 * V);
  }
}

// A diode before a coil that carries no current yet: on the way Newton's method meets voltages of 10²³ V,
// and comes back. What little energy there is at first makes no warning.
BOOST_AUTO_TEST_CASE(a_rectifier_begins_at_rest) {
  Json rectifier = Json::parse(R"json({"system": {"type": "network",
    "nodes": ["0", "s", "a", "b"], "elements": [
      {"type":"voltage-source","name":"V1","from":"s","to":"0","value":"10*sin(100*pi*t)"},
      {"type":"diode","name":"D1","from":"s","to":"a","saturation":1e-12,"thermal_voltage":0.025852,"leak":1e-6},
      {"type":"inductor","name":"L1","from":"a","to":"b","value":0.01},
      {"type":"resistor","name":"R1","from":"b","to":"0","value":10}]},
    "initial": {"phi_L1": 0}, "time": {"step": 1e-5, "end": 5e-3}})json");
  for (const char* method : {"discretize-first", "constrain-first"}) {
    rectifier["method"] = method;
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, rectifier);
    BOOST_TEST((outcome.status == RunStatus::completed), method << ": " << outcome.message);
    BOOST_TEST(outcome.summary.warnings.empty());
    const TrajectoryTable trajectory = read_run(folder / "run").trajectory;
    // That of the midpoint rule with steps of 1 and 2 µs for the current alone, extrapolated.
    BOOST_TEST(std::abs(trajectory.column("phi_L1").back() / 0.01 - 0.8422877677) < 1e-5);
  }
}

// From a voltage of 10 V in steps that are short, as the diode of a capacitor that is discharged through
// a coil; by Method 2 some steps were taken to a state with -10²³ V.
BOOST_AUTO_TEST_CASE(a_capacitor_is_discharged_through_a_diode_from_rest) {
  const Problem circuit = problem(Json::parse(R"json({"system": {"type": "network",
    "nodes": ["0", "a", "b"], "elements": [
      {"type":"capacitor","name":"C1","from":"a","to":"0","value":1e-6},
      {"type":"inductor","name":"L1","from":"a","to":"b","value":1e-3},
      {"type":"diode","name":"D1","from":"b","to":"0","saturation":1e-9,"thermal_voltage":0.025852,"leak":1e-4}]},
    "initial": {"q_C1": 1e-5, "phi_L1": 0}})json"));
  const VectorXd one = circuit.end(method_1("midpoint"), 1e-4, 1000);
  const VectorXd two = circuit.end(method_2("midpoint"), 1e-4, 1000);
  BOOST_TEST((one - two).lpNorm<Eigen::Infinity>() < 1e-8 * one.lpNorm<Eigen::Infinity>());
  BOOST_TEST(one[0] < -7e-6);
}

// A step over the corner of a held charge: its stage, before the corner, knows nothing of what comes.
BOOST_AUTO_TEST_CASE(corners_are_named_where_method_2_ends) {
  Json circuit = Json::parse(R"json({"system": {"type": "implicit", "coordinates": ["q", "p"],
      "unknowns": ["i"],
      "equations": ["q' - i", "p' + p - i", "q - if(t < 0.96, 0, 1000*(t - 0.96))"]},
    "initial": {"q": 0, "p": 0}, "method": "constrain-first", "time": {"step": 0.1, "end": 2}})json");
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, circuit);
  BOOST_TEST((outcome.status == RunStatus::failed));
  BOOST_TEST(outcome.message.find("has a corner (if, min, max, abs)") != std::string::npos,
             outcome.message);
  circuit["method"] = "discretize-first";
  const TemporaryFolder other;
  BOOST_TEST((run_in(other, circuit).status == RunStatus::completed));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
