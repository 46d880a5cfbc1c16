#include "courant/reading/repetition.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/reading/experiment.hpp"
#include "courant/reading/system_kinds.hpp"
#include "experiment_problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * an index ends before its last value
//  * names get a minus sign
//  * what is wrong in all turns is told of each
//  * an index takes the name of a parameter
//  * ten thousand problems at one place are ten thousand lines (reading/findings.cpp)
BOOST_AUTO_TEST_SUITE(repetition)

namespace {

// What "{…}" is in each turn; the problems, if there are any.
std::string fillings(const char* repeat, const std::string& text) {
  const Json indices = Json::parse(repeat);
  SymbolTable constants;
  constants.add("n", 3.0);
  Findings findings;
  std::string all;
  const auto turns = Repetition::read(JsonReader(indices, "/repeat", findings), constants);
  if (turns)
    turns->for_each(findings, [&](const Repetition::Turn& turn, Findings& own) {
      all += (all.empty() ? "" : " ") + turn.filled(text, "/name", own).value_or("-");
    });
  if (findings.clean()) return all;
  all.clear();
  for (const Problem& problem : findings.problems()) all += problem.where + ": " + problem.what;
  return all;
}

// A line of cells, written once.
const char* const line = R"json({"system": {"type": "network",
  "parameters": {"N": 3, "C": 2, "w": [5, 7, 11, 13]},
  "nodes": ["0", {"repeat": {"i": [0, "N"]}, "name": "n{i}"}],
  "elements": [
    {"repeat": {"i": [0, "N"]}, "type": "capacitor", "name": "C{i}", "from": "n{i}", "to": "0",
     "value": "if({i} == 0, C/2, C)"},
    {"repeat": {"i": [1, "N"]}, "type": "inductor", "name": "L{i}", "from": "n{i-1}",
     "to": "n{i}", "value": "w[{i}]"},
    {"type": "resistor", "name": "R", "from": "n{N}", "to": "0", "value": "1 + i_L{N-1}^2"}]},
  "initial": {"q_C{i}": {"repeat": {"i": [1, "N"]}, "value": "10*{i} + w[{i-1}]"}, "phi_L{N}": 4}})json";

// Each problem of the line with a text replaced, by lines.
std::string problems_with(const std::string& text, const std::string& other) {
  std::string changed = line;
  const std::size_t at = changed.find(text);
  BOOST_REQUIRE(at != std::string::npos);
  return problems(Json::parse(changed.replace(at, text.size(), other)));
}

}  // namespace

BOOST_AUTO_TEST_CASE(indices_run_from_first_to_last) {
  BOOST_TEST(fillings(R"({"i": [0, "n"]})", "a{i}") == "a0 a1 a2 a3");
  BOOST_TEST(fillings(R"({"i": [1, 2], "j": [1, "i"]})", "a{i}_{j}") == "a1_1 a2_1 a2_2");
  BOOST_TEST(fillings(R"({"i": [-1, 1]})", "{i+1}{i*i}{n}") == "013 103 213");
  BOOST_TEST(fillings(R"({"i": [4, "n"]})", "a{i}") == "");
  BOOST_TEST(fillings(R"({"i": [1, 1]})", "no braces") == "no braces");
}

BOOST_AUTO_TEST_CASE(wrong_indices_are_refused) {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {"{}", "/repeat: has no index"},
      {R"({"i": 3})", "/repeat/i: is 3; expected an array"},
      {R"({"i": [3]})", "/repeat/i: is an array; expected [first, last]"},
      {R"({"n": [1, 2]})", "/repeat/n: key, column 1: \"n\""},
      {R"({"i": [1, 2], "i[2]": [1, 2]})", "/repeat/i[2]: key, "},
      {R"({"i": [1, "n/2"]})", "/repeat/i/1: is 1.5; expected an integer"},
      {R"({"i": [1, "k"]})", "/repeat/i/1: column 1: unknown name \"k\""},
      {R"({"i": [5, "n"]})", "/repeat/i: goes from 5 to 3; expected a last value"},
      {R"({"i": [1, 1000], "j": [1, 1001]})", "/repeat/j: goes from 1 to 1001; expected at most"},
  };
  for (const auto& [repeat, words] : cases)
    BOOST_TEST(fillings(repeat, "a").find(words) == 0u, fillings(repeat, "a"));
}

BOOST_AUTO_TEST_CASE(wrong_braces_are_refused_with_their_turn) {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {"a{i-2}", "/name: \"a{i-2}\": {i-2} is -1; expected an integer from 0"},
      {"a{i/2}", "/name: \"a{i/2}\": {i/2} is 0.5; expected an integer from 0"},
      {"a{k}", "/name: \"a{k}\": in {k}, column 1: unknown name \"k\""},
      {"a{}", "/name: \"a{}\": in {}, column 1"},
      {"a{i", "/name: \"a{i\": a brace has no other one"},
      {"a}i{", "/name: \"a}i{\": a brace has no other one"},
      {"a{i{i}}", "/name: \"a{i{i}}\": a brace has no other one"},
  };
  for (const auto& [text, words] : cases) {
    const std::string found = fillings(R"({"i": [1, 3]})", text);
    BOOST_TEST(found.find(words) == 0u, found);
    BOOST_TEST(found.ends_with(" (i = 1)"), found);  // and only there
  }
}

BOOST_AUTO_TEST_CASE(a_network_with_repetitions_is_that_written_out) {
  const Json written_out = Json::parse(R"json({"system": {"type": "network",
    "nodes": ["0", "n0", "n1", "n2", "n3"], "elements": [
      {"type": "capacitor", "name": "C0", "from": "n0", "to": "0", "value": 1},
      {"type": "capacitor", "name": "C1", "from": "n1", "to": "0", "value": 2},
      {"type": "capacitor", "name": "C2", "from": "n2", "to": "0", "value": 2},
      {"type": "capacitor", "name": "C3", "from": "n3", "to": "0", "value": 2},
      {"type": "inductor", "name": "L1", "from": "n0", "to": "n1", "value": 7},
      {"type": "inductor", "name": "L2", "from": "n1", "to": "n2", "value": 11},
      {"type": "inductor", "name": "L3", "from": "n2", "to": "n3", "value": 13},
      {"type": "resistor", "name": "R", "from": "n3", "to": "0", "value": "1 + i_L2^2"}]},
    "initial": {"q_C1": 15, "q_C2": 27, "q_C3": 41, "phi_L3": 4}})json");
  const Experiment short_one = read_experiment(line), other = read_experiment(written_out.dump());
  const ImplicitSystem &a = *short_one.model.system, &b = *other.model.system;
  BOOST_TEST(a.names().coordinates == b.names().coordinates, boost::test_tools::per_element());
  BOOST_TEST(a.names().equations == b.names().equations, boost::test_tools::per_element());
  BOOST_TEST((short_one.initial.x.given == other.initial.x.given).all());
  BOOST_TEST((short_one.initial.x.values - other.initial.x.values).norm() == 0.0);
  const VectorXd x = VectorXd::LinSpaced(7, -1.0, 2.0), v = VectorXd::LinSpaced(7, 3.0, 1.0);
  const VectorXd z = VectorXd::Constant(1, 0.3);
  BOOST_TEST((a.residual(x, v, z, 0.0) - b.residual(x, v, z, 0.0)).norm() == 0.0);
  BOOST_TEST(a.residual(x, v, z, 0.0).norm() > 1.0);
}

BOOST_AUTO_TEST_CASE(problems_of_repeated_elements_say_which) {
  const auto one = [](const std::string& text, const std::string& other, const std::string& words) {
    const std::string found = problems_with(text, other);
    BOOST_TEST(found == words, found);
  };
  BOOST_TEST(problems(Json::parse(line)) == "");
  one("\"name\": \"L{i}\"", "\"name\": \"L\"",
      "/system/elements/1/name: two elements have the name \"L\", the other is /system/elements/1\n"
      "/system/elements/1/name: two elements have the name \"L\", the other is /system/elements/1");
  one("\"to\": \"n{i}\", \"value\"", "\"to\": \"m{i}\", \"value\"",
      "/system/elements/1/to: unknown node \"m1\" (did you mean \"n1\"?) (i = 1)\n"
      "/system/elements/1/to: unknown node \"m2\" (did you mean \"n2\"?) (i = 2)\n"
      "/system/elements/1/to: unknown node \"m3\" (did you mean \"n3\"?) (i = 3)");
  one("w[{i}]", "w[{i+1}]",
      "/system/elements/1/value: column 3: index 4 is out of range for w[4] (0 … 3) (i = 3)");
  one("\"value\": \"w[{i}]\"", "\"current\": \"phi_L{i}*phi_L{i+1}\"",
      "/system/elements/1/current: column 8: unknown name \"phi_L4\" (did you mean \"phi_L1\"?) "
      "(i = 3)");
  one("\"to\": \"0\",\n     \"value\"", "\"too\": \"0\",\n     \"value\"",
      "/system/elements/0/to: is missing (i = 0)\n"
      "/system/elements/0/too: unknown key (did you mean \"to\"?) (i = 0)");
  one("\"name\": \"n{i}\"", "\"name\": \"n{i}-\"",
      "/system/nodes/1: is \"n0-\"; expected letters, digits and _ (i = 0)");
  one("\"q_C{i}\"", "\"q_K{i}\"",
      "/initial/q_K{i}/value: key, column 1: unknown name \"q_K1\" (did you mean \"q_C1\"?) "
      "(i = 1)");
  one("\"phi_L{N}\"", "\"phi_L{i}\"",
      "/initial/phi_L{i}: \"phi_L{i}\": in {i}, column 1: unknown name \"i\" "
      "(did you mean \"pi\"?)");
}

BOOST_AUTO_TEST_CASE(many_problems_at_one_place_are_three) {
  std::string found = problems_with("{\"repeat\": {\"i\": [0, \"N\"]}, \"name\": \"n{i}\"}",
                                    "{\"repeat\": {\"i\": [0, 20]}, \"name\": \"n{i}\"}");
  BOOST_TEST(std::count(found.begin(), found.end(), '\n') == 3);
  BOOST_TEST(found.ends_with("/system/nodes/1: has 14 more problems"), found);
}

BOOST_AUTO_TEST_CASE(observables_may_have_braces) {
  Json experiment = Json::parse(line);
  experiment["method"] = "rk4";
  experiment["time"] = {{"step", 0.1}, {"end", 1}};
  experiment["observe"] = {{"end", "potential_n{N}"}, {"other", {{"formula", "v_C{N-1}"}}}};
  const Experiment read = read_experiment(experiment.dump());
  BOOST_TEST(read.observe[0].formula.text == "potential_n3");
  BOOST_TEST(read.observe[1].formula.text == "v_C2");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
