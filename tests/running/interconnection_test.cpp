// An interconnection of systems is the system that is written at once.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../reading/experiment_problems.hpp"
#include "run_in.hpp"

// Mistakes that these cases have to notice:
//  * matrices of joints are read by columns (reading/read_interconnection.cpp)
BOOST_AUTO_TEST_SUITE(interconnection)

using namespace courant;

namespace {

// The same system as that of experiments/interconnection.json.
const Json motor_at_once = Json::parse(R"json({
  "type": "port-hamiltonian",
  "coordinates": ["flux", "L", "twist", "load"],
  "hamiltonian": "flux^2/(2*0.1) + L^2/(2*0.2) + twist^2/2 + twist^4/4 + load^2/2",
  "J": [[0, -0.5, 0, 0], [0.5, 0, -1, 0], [0, 1, 0, -1], [0, 0, 1, 0]],
  "R": [[0.4, 0, 0, 0], [0, 0.05, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
  "B": [1, 0, 0, 0], "ports": "open", "inputs": ["sin(t)"]
})json");

Json capacitor(double capacity) {
  return {{"type", "port-hamiltonian"}, {"coordinates", {"q"}}, {"parameters", {{"C", capacity}}},
          {"hamiltonian", "q^2/(2*C)"}, {"J", {{0}}},           {"B", {1}}};
}

// Two capacitors and a coil side by side.
Json tank() {
  Json coil = capacitor(0.5);
  return {{"type", "interconnection"},
          {"systems", {{"a", capacitor(2.0)}, {"b", capacitor(1.0)}, {"coil", coil}}},
          {"joints",
           {{{"ports", {"a", "b", "coil"}},
             {"F", {{1, 1, 0}, {0, 0, 1}, {0, 0, 0}}},
             {"E", {{0, 0, 1}, {-1, 0, 0}, {1, -1, 0}}}}}}};
}
const Json tank_at_once = Json::parse(R"json({
  "type": "port-hamiltonian", "coordinates": ["a", "b", "flux"],
  "hamiltonian": "a^2/4 + b^2/2 + flux^2", "J": [[0, 0, -1], [0, 0, 0], [1, 0, 0]], "B": [1, -1, 0]
})json");

Json network(const char* nodes, const char* elements) {
  return {{"type", "network"}, {"nodes", Json::parse(nodes)}, {"elements", Json::parse(elements)}};
}

// A source behind a resistor, and a filter; the node "a" in between has a capacitor on either side.
const char* const source_elements = R"json(
  {"type": "voltage-source", "name": "V", "from": "in", "to": "0", "value": "sin(3*t)"},
  {"type": "resistor", "name": "R", "from": "in", "to": "a", "value": 0.5},
  {"type": "capacitor", "name": "C", "from": "a", "to": "0", "value": 0.7})json";
const char* const filter_elements = R"json(
  {"type": "inductor", "name": "L", "from": "a", "to": "b", "value": 0.3},
  {"type": "capacitor", "name": "D", "from": "b", "to": "0", "value": 0.4},
  {"type": "resistor", "name": "S", "from": "b", "to": "0", "value": 2.0})json";
const char* const more_capacity =
    R"json({"type": "capacitor", "name": "E", "from": "a", "to": "0", "value": 0.2})json";

std::string port(const char* name, const char* node, const char* input) {
  return std::string(R"({"type": "port", "to": "0", "name": ")") + name + R"(", "from": ")" + node +
         R"(", "input": ")" + input + "\"}";
}
std::string listed(const std::vector<std::string>& elements) {
  std::string list = "[";
  for (const std::string& element : elements) list += (list == "[" ? "" : ", ") + element;
  return list + "]";
}

Json experiment(const Json& system, const Json& initial, const Json& method) {
  return {{"system", system},
          {"initial", initial},
          {"method", method},
          {"time", {{"step", 0.05}, {"end", 5}}}};
}

// That of Gonzalez has natural units in it, and these see the inputs of the parts.
const std::vector<Json> methods = {
    "discretize-first",
    "constrain-first",
    {{"type", "discrete-gradient"}, {"gradient", "averaged-vector-field"}},
    {{"type", "discrete-gradient"}, {"gradient", "itoh-abe"}}};

void check_same(const Json& joined, const Json& at_once,
                const std::vector<std::pair<std::string, std::string>>& names) {
  const TemporaryFolder folder, other;
  const RunOutcome one = run_in(folder, joined), two = run_in(other, at_once);
  BOOST_REQUIRE(one.status == RunStatus::completed);
  BOOST_REQUIRE(two.status == RunStatus::completed);
  const Json of_one = to_json(one.summary)["ladder"], of_two = to_json(two.summary)["ladder"];
  for (const char* key : {"verdict", "index", "degrees_of_freedom", "gauge_dimension"})
    BOOST_TEST(of_one[key] == of_two[key], key);
  for (const auto& [name, its] : names)
    BOOST_TEST(std::abs(final_value(one, name) - final_value(two, its)) < 1e-12,
               name << " by " << joined["method"]);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_motor_with_a_load) {
  const Json joined = Json::parse(read_text("experiments/interconnection.json"));
  for (const Json& method : methods)
    check_same(
        experiment(joined["system"], joined["initial"], method),
        experiment(motor_at_once, {{"flux", 0}, {"L", 0}, {"twist", 0}, {"load", 0}}, method),
        {{"circuit_flux", "flux"}, {"rotor_L", "L"}, {"load_twist", "twist"}, {"load_L", "load"}});
}

// The capacitors have one voltage: a constraint, whose multiplier is the current between them.
BOOST_AUTO_TEST_CASE(capacitors_side_by_side) {
  for (const Json& method : methods)
    check_same(experiment(tank(), {{"a_q", 2}, {"b_q", 1}, {"coil_q", 0}}, method),
               experiment(tank_at_once, {{"a", 2}, {"b", 1}, {"flux", 0}}, method),
               {{"a_q", "a"}, {"b_q", "b"}, {"coil_q", "flux"}});
}

// Two networks whose terminals are connected: one sends a current, the other says at which voltage.
BOOST_AUTO_TEST_CASE(two_networks) {
  const Json joined = {
      {"type", "interconnection"},
      {"systems",
       {{"source", network(R"(["0", "in", "a"])",
                           listed({source_elements, port("P", "a", "current")}).c_str())},
        {"filter", network(R"(["0", "a", "b"])",
                           listed({filter_elements, port("P", "a", "voltage")}).c_str())}}},
      {"joints", {{{"ports", {"source_P", "filter_P"}}, {"matrix", {{0, -1}, {1, 0}}}}}}};
  const Json at_once =
      network(R"(["0", "in", "a", "b"])", listed({source_elements, filter_elements}).c_str());
  for (const Json& method : methods) {
    Json one =
        experiment(joined, {{"source_q_C", 0.1}, {"filter_phi_L", 0}, {"filter_q_D", 0.2}}, method);
    one["observe"] = {{"v", "filter_v_S"}, {"i", "y_filter_P"}, {"lost", "dissipated_source_R"}};
    Json two = experiment(at_once, {{"q_C", 0.1}, {"phi_L", 0}, {"q_D", 0.2}}, method);
    two["observe"] = {{"v", "v_S"}, {"i", "i_L"}, {"lost", "dissipated_R"}};
    check_same(one, two, {{"source_q_C", "q_C"}, {"filter_phi_L", "phi_L"}, {"filter_q_D", "q_D"}});
    const TemporaryFolder folder, other;
    const Json of_one = to_json(run_in(folder, one).summary)["observables"],
               of_two = to_json(run_in(other, two).summary)["observables"];
    for (const char* name : {"v", "i", "lost"})
      BOOST_TEST(std::abs(of_one[name]["final"].get<double>() -
                          of_two[name]["final"].get<double>()) < 1e-11,
                 name << " by " << method);
  }
}

// Both have a capacitor at the terminals: the joint closes a loop of them.
BOOST_AUTO_TEST_CASE(a_capacitor_loop_of_two_networks) {
  const Json joined = {
      {"type", "interconnection"},
      {"systems",
       {{"source", network(R"(["0", "in", "a"])",
                           listed({source_elements, port("P", "a", "voltage")}).c_str())},
        {"filter",
         network(R"(["0", "a", "b"])",
                 listed({filter_elements, more_capacity, port("P", "a", "voltage")}).c_str())}}},
      {"joints", {{{"ports", {"source_P", "filter_P"}}, {"shared", "input"}}}}};
  const Json at_once = network(R"(["0", "in", "a", "b"])",
                               listed({source_elements, filter_elements, more_capacity}).c_str());
  for (const Json& method : methods)
    check_same(
        experiment(
            joined,
            {{"source_q_C", 0.7}, {"filter_q_E", 0.2}, {"filter_phi_L", 0}, {"filter_q_D", 0}},
            method),
        experiment(at_once, {{"q_C", 0.7}, {"q_E", 0.2}, {"phi_L", 0}, {"q_D", 0}}, method),
        {{"source_q_C", "q_C"}, {"filter_q_E", "q_E"}, {"filter_phi_L", "phi_L"}});
}

// The circuit and the rotor of a motor: the port stands for the voltage that the rotor induces. The shaft is
// a port of the whole, and drives a load in another interconnection.
BOOST_AUTO_TEST_CASE(a_network_and_a_rotor_whose_shaft_stays_open) {
  const Json reference = Json::parse(read_text("experiments/interconnection.json"));
  Json circuit =
      network(R"(["0", "in", "a", "b"])",
              listed({R"json({"type": "voltage-source", "name": "V", "from": "in", "to": "0",
                                         "value": "sin(t)"})json",
                      R"json({"type": "resistor", "name": "R", "from": "in", "to": "a",
                                         "value": 0.4})json",
                      R"json({"type": "inductor", "name": "L", "from": "a", "to": "b",
                                         "value": 0.1})json",
                      port("motor", "b", "voltage")})
                  .c_str());
  const Json motor = {
      {"type", "interconnection"},
      {"systems", {{"circuit", circuit}, {"rotor", reference["system"]["systems"]["rotor"]}}},
      {"joints",
       {{{"ports", {"circuit_motor", "rotor_motor"}}, {"matrix", {{0, 0.5}, {-0.5, 0}}}}}}};
  const Json load = reference["system"]["systems"]["load"];
  const Json whole = {
      {"type", "interconnection"},
      {"systems", {{"motor", motor}, {"load", load}}},
      {"joints",
       {{{"ports", {"motor_rotor_shaft", "load_shaft"}}, {"matrix", {{0, -1}, {1, 0}}}}}}};
  for (const Json& method : methods)
    check_same(
        experiment(
            whole,
            {{"motor_circuit_phi_L", 0}, {"motor_rotor_L", 0}, {"load_twist", 0}, {"load_L", 0}},
            method),
        experiment(motor_at_once, {{"flux", 0}, {"L", 0}, {"twist", 0}, {"load", 0}}, method),
        {{"motor_circuit_phi_L", "flux"},
         {"motor_rotor_L", "L"},
         {"load_twist", "twist"},
         {"load_L", "load"}});
  // Without a load, or with a torque that is given, the rest of the ports are as they were.
  const Json open = experiment(motor, {{"circuit_phi_L", 0}, {"rotor_L", 0}}, "discretize-first");
  BOOST_TEST(problems(open) == "");
  Json driven = motor;
  driven["joints"].push_back({{"ports", {"rotor_shaft"}}, {"input", "-0.1*y_rotor_shaft"}});
  const Json brake = Json::parse(R"json({
    "type": "port-hamiltonian", "coordinates": ["flux", "L"], "hamiltonian": "flux^2/(2*0.1) + L^2/(2*0.2)",
    "J": [[0, -0.5], [0.5, 0]], "R": [[0.4, 0], [0, 0.15]], "B": [1, 0], "ports": "open", "inputs": ["sin(t)"]
  })json");
  check_same(experiment(driven, {{"circuit_phi_L", 0}, {"rotor_L", 0}}, "discretize-first"),
             experiment(brake, {{"flux", 0}, {"L", 0}}, "discretize-first"),
             {{"circuit_phi_L", "flux"}, {"rotor_L", "L"}});
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told_in_its_place) {
  const auto told = [](const char* pointer, const Json& value, const std::string& expected) {
    Json wrong = experiment(tank(), {{"a_q", 2}, {"b_q", 1}, {"coil_q", 0}}, "discretize-first");
    wrong[Json::json_pointer(pointer)] = value;
    const std::string found = problems(wrong);
    BOOST_TEST(found.find(expected) == 0u, found);
  };
  told("/system/joints/0/ports/0", "c", "/system/joints/0/ports/0: names no port");
  told("/system/joints/0/ports/0", "b", "/system/joints/0: a port is there twice");
  told("/system/joints/0/E/0/2", 2, "/system/joints/0: F Eᵀ + E Fᵀ is not zero");
  told("/system/joints/0/shared", "input", "/system/joints/0: says in 2 ways");
  told("/system/joints/1", {{"ports", {"a"}}, {"input", "t"}},
       "/system/joints/1: the port \"a\" is in another joint");
  told("/system/joints/0", {{"ports", {"a"}}, {"input", "q"}},
       "/system/joints/0/input: column 1: unknown name \"q\"");
  told("/system/systems/a/J", "x", "/system/systems/a/J");
  told("/system/systems/a", {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", "q"}},
       "/system/systems/a: has no ports");
}

BOOST_AUTO_TEST_SUITE_END()
