#include "courant/cli/schema.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <set>

#include "../core/files/temporary_folder.hpp"
#include "courant/reading/catalogue.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reading/method_kinds.hpp"
#include "courant/reading/space.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(schema_and_reader)

namespace {

using Words = std::set<std::string>;

// The keys that the reader expects at a pointer, from what it says of one that it does not know.
Words known_keys(Json experiment, const std::string& pointer) {
  const std::string unknown = "zzzzzzzzzzzzzzzzzzzzzzzzzzzzzz";
  experiment[Json::json_pointer(pointer)][unknown] = 0;
  try {
    read_experiment(experiment.dump());
  } catch (const ExperimentError& error) {
    for (const Problem& problem : error.problems()) {
      if (problem.where != pointer + "/" + unknown) continue;
      Words words;
      std::string rest = problem.what;
      for (std::size_t begin; (begin = rest.find('"')) != std::string::npos;) {
        const std::size_t end = rest.find('"', begin + 1);
        words.insert(rest.substr(begin + 1, end - begin - 1));
        rest = rest.substr(end + 1);
      }
      return words;
    }
  }
  return {};
}

Words properties(const Json& schema) {
  Words words;
  for (const auto& [key, value] : schema.at("properties").items()) words.insert(key);
  return words;
}

const Json schema = Json::parse(cli::schema_text());

// The schema of the objects of one type among the alternatives of a definition.
Json alternative(const Json& definition, const std::string& type) {
  for (Json one : definition.at("oneOf")) {
    if (one.contains("$ref"))
      one = schema.at(Json::json_pointer(one["$ref"].get<std::string>().substr(1)));
    if (!one.contains("properties")) continue;
    const Json& kind = one.at("properties").at("type");
    if (kind.value("const", "") == type) return one;
    if (kind.contains("enum") && std::count(kind["enum"].begin(), kind["enum"].end(), type) > 0)
      return one;
  }
  return {{"properties", Json::object()}};
}

// The types of a definition that are written as objects.
Words types(const Json& definition) {
  Words words;
  for (Json one : definition.at("oneOf")) {
    if (one.contains("$ref"))
      one = schema.at(Json::json_pointer(one["$ref"].get<std::string>().substr(1)));
    if (!one.contains("properties")) continue;
    const Json& kind = one.at("properties").at("type");
    if (kind.contains("const"))
      words.insert(kind["const"].get<std::string>());
    else
      for (const Json& type : kind.at("enum")) words.insert(type.get<std::string>());
  }
  return words;
}

Words types(const std::vector<KindDescription>& kinds) {
  Words words;
  for (const KindDescription& kind : kinds) words.insert(kind.type);
  return words;
}

const Json experiment = Json::parse(R"({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": "rk2",
  "time": { "step": 0.1, "end": 1 },
  "output": {},
  "events": { "centre": { "zero": "q" } },
  "expect": [{ "observable": "H", "max": 1 }, { "event": "centre", "count": 3 }, { "state": { "q": 1 }, "tolerance": 1 }, { "max_violation": 1 }]
})");

// The experiment with `value` at a pointer.
Json with(const std::string& pointer, const Json& value) {
  Json changed = experiment;
  changed[Json::json_pointer(pointer)] = value;
  return changed;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_program_prints_the_file) {
  const Json frame = Json::parse(cli::schema_text());
  BOOST_TEST(experiment_schema(frame).dump(2) + "\n" == read_text("experiments/schema.json"),
             "expected what courant schema prints");
}

// Each table of the kinds as the kinds declare their keys.
BOOST_AUTO_TEST_CASE(the_documents_have_the_tables) {
  const std::string text = read_text("docs/experiment-format.md");
  for (const Shelf& shelf : catalogue())
    BOOST_TEST(text.find(marked_table(shelf)) != std::string::npos,
               shelf.name << ": expected the table that courant list --markdown prints");
}

BOOST_AUTO_TEST_CASE(know_the_same_types) {
  const Json& definitions = schema.at("$defs");
  BOOST_TEST(types(definitions.at("system")) == types(system_kinds().descriptions()));
  BOOST_TEST(types(definitions.at("manifold")) == types(manifold_kinds().descriptions()));
  BOOST_TEST(types(definitions.at("structure")) == types(structure_kinds().descriptions()));
  BOOST_TEST(types(definitions.at("method")) == types(method_kinds().descriptions()));
  BOOST_TEST(types(definitions.at("discretization")) ==
             types(discretization_kinds().descriptions()));
  BOOST_TEST(types(definitions.at("projector")) == types(projector_kinds().descriptions()));
}

BOOST_AUTO_TEST_CASE(know_the_same_keys) {
  const Json& definitions = schema.at("$defs");
  BOOST_TEST(known_keys(experiment, "") == properties(schema));
  BOOST_TEST(known_keys(experiment, "/time") == properties(definitions.at("time")));
  BOOST_TEST(known_keys(experiment, "/output") == properties(definitions.at("output")));
  BOOST_TEST(known_keys(experiment, "/events/centre") ==
             properties(schema["/properties/events/additionalProperties/oneOf/1"_json_pointer]));
  for (int i = 0; i < 4; ++i) {
    const Words found = known_keys(experiment, "/expect/" + std::to_string(i));
    Words expected =
        properties(definitions.at("expectation").at("oneOf").at(static_cast<std::size_t>(i)));
    // The last alternative is what is neither of the others.
    if (i > 0) expected.insert("observable");
    if (i > 1) expected.insert("event");
    if (i > 2) expected.insert({"state", "mean", "standard_deviation"});
    BOOST_TEST(found == expected);
  }
  Json many = experiment;
  many["ensemble"] = {{"members", 2}};
  many["expect"] = {{{"mean", {{"q", 1}}}, {"tolerance", 1}},
                    {{"standard_deviation", {{"q", 1}}}, {"tolerance", 1}}};
  BOOST_TEST(known_keys(many, "/ensemble") ==
             properties(schema["/properties/ensemble"_json_pointer]));
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& kinds = definitions.at("expectation").at("oneOf");
    Words expected = properties(kinds.at(kinds.size() - 2 + i));
    expected.insert({"observable", "event", "state"});
    if (i > 0) expected.insert("mean");
    BOOST_TEST(known_keys(many, "/expect/" + std::to_string(i)) == expected);
  }
}

BOOST_AUTO_TEST_CASE(know_the_same_keys_of_each_type) {
  const Json& definitions = schema.at("$defs");
  const auto compare = [&](const char* definition, const std::vector<KindDescription>& kinds,
                           const std::string& pointer, const Json& place) {
    for (const KindDescription& kind : kinds) {
      Json changed = place;
      changed[Json::json_pointer(pointer)] = Json{{"type", kind.type}};
      BOOST_TEST(known_keys(changed, pointer) ==
                     properties(alternative(definitions.at(definition), kind.type)),
                 kind.type << ": the keys of the reader are not those of the schema");
    }
  };
  compare("system", system_kinds().descriptions(), "/system", experiment);
  compare("manifold", manifold_kinds().descriptions(), "/system/manifold", experiment);
  compare("structure", structure_kinds().descriptions(), "/system/structure", experiment);
  compare("method", method_kinds().descriptions(), "/method", experiment);
  compare("discretization", discretization_kinds().descriptions(), "/method/discretization",
          with("/method", {{"type", "constrain-first"}}));
  compare("projector", projector_kinds().descriptions(), "/method/projector",
          with("/method", {{"type", "constrain-first"}}));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
