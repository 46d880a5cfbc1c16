#include "courant/reading/new_experiment.hpp"

#include <boost/test/unit_test.hpp>
#include <sstream>

#include "courant/reading/experiment.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {

BOOST_AUTO_TEST_SUITE(new_experiment_test)

// Each kind has one, and it says of every key what the kind declares.
BOOST_AUTO_TEST_CASE(every_kind_of_system_has_a_commented_example) {
  for (const KindDescription& kind : system_kinds().descriptions()) {
    const std::string text = new_experiment(kind.type);
    const Json document = parse_json(text);
    BOOST_TEST(document["system"]["type"] == kind.type);
    for (const Key& key : kind.keys) {
      const std::string comment = document["system"].value("// " + key.name, "");
      BOOST_TEST(comment.find(key.summary) != std::string::npos, kind.type << ' ' << key.name);
      BOOST_TEST(comment.find(key.takes.text) != std::string::npos, kind.type << ' ' << key.name);
    }
    BOOST_TEST(document["method"].contains("// discretization"));
    for (const char* key : {"initial", "time", "observe", "expect", "output"})
      BOOST_TEST(document.contains("// " + std::string(key)));
    const Experiment experiment = read_experiment(text);
    BOOST_TEST(experiment.method.has_value());
    BOOST_TEST(!experiment.expect.checks.empty());
    BOOST_TEST(!experiment.observe.empty());
    // Constants have names: as parameters, or as keys.
    BOOST_TEST((document["system"].contains("parameters") || !kind.formulas.is_null() ||
                document["system"].contains("strengths")));
  }
}

// A system of the catalogue can be written as what it stands for, with the same values.
BOOST_AUTO_TEST_CASE(a_system_of_the_catalogue_in_formulas) {
  const Json document = parse_json(new_experiment("duffing", true));
  BOOST_TEST(document["system"]["type"] == "hamiltonian");
  BOOST_TEST(document["system"]["parameters"]["a"] == -1);
  BOOST_TEST(document["system"]["parameters"]["b"] == 1);
  BOOST_CHECK_EXCEPTION(
      new_experiment("lagrangian", true), ExperimentError, [](const ExperimentError& error) {
        return std::string(error.what()).find("no system of formulas alone") != std::string::npos;
      });
}

BOOST_AUTO_TEST_CASE(other_kinds_are_refused) {
  BOOST_CHECK_EXCEPTION(
      new_experiment("hamiltonain"), ExperimentError, [](const ExperimentError& error) {
        return std::string(error.what()).find("did you mean \"hamiltonian\"?") != std::string::npos;
      });
  BOOST_CHECK_THROW(new_experiment("sphere"), ExperimentError);
}

BOOST_AUTO_TEST_CASE(short_objects_stand_in_one_line) {
  const Json value = {{"a", {1, 2}},
                      {"b", {{"c", "d"}, {"e", Json::array()}}},
                      {"f", {{"// g", "why"}, {"g", 1}}},
                      {"h", Json::object()}};
  BOOST_TEST(
      readable_json(value) ==
      "{\n  \"a\": [1, 2],\n  \"b\": { \"c\": \"d\", \"e\": [] },\n  \"f\": {\n    \"// g\": "
      "\"why\",\n    \"g\": 1\n  },\n  \"h\": {}\n}\n");
  // What does not fit is broken, and nothing is lost.
  const Json wide = {
      {"matrix", std::vector<std::vector<double>>(10, std::vector<double>(10, 1.5))}};
  BOOST_TEST(Json::parse(readable_json(wide)) == wide);
  std::istringstream lines(readable_json(wide));
  for (std::string line; std::getline(lines, line);) BOOST_TEST(line.size() <= 100u);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
