// An interconnection of systems is the system that is written at once.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../reading/experiment_problems.hpp"
#include "run_in.hpp"

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

BOOST_AUTO_TEST_SUITE(interconnection)

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
