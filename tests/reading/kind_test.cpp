#include "courant/reading/kind.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/reading/catalogue.hpp"
#include "courant/reading/registry.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(kind)

namespace {

KindDescription spring() {
  return {"spring",
          "k x",
          {default_key("stiffness", takes::number(0, 10), 2.5, "k"),
           default_key("law", takes::word({"linear", "cubic"}), "linear", "of the force"),
           default_key("coils", takes::integer(1), 3, "how many"),
           optional_key("label", takes::text(), "for people"),
           required_key("ends", takes::names(), "two points")}};
}

struct Spring {
  double stiffness;
  std::string law;
  Index coils;
};

Registry<Spring> springs(const std::function<void(ObjectReader&)>& also = {}) {
  return Registry<Spring>({{spring(), [also](ObjectReader& object) {
                              object.required("ends");
                              object.optional("label");
                              if (also) also(object);
                              return std::optional<Spring>({object.number("stiffness"),
                                                            object.word("law"),
                                                            object.integer("coils")});
                            }}});
}

// What is wrong with a spring, `pointer: what`, one a line.
std::string problems(const Json& json) {
  Findings findings;
  springs().read(JsonReader(json, "/spring", findings));
  std::string text;
  try {
    findings.require_clean();
  } catch (const ExperimentError& error) {
    for (const Problem& problem : error.problems())
      text += problem.where + ": " + problem.what + "\n";
  }
  return text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(defaults_come_from_the_declaration) {
  Findings findings;
  const Json json = {{"type", "spring"}, {"ends", {"a", "b"}}};
  const auto read = springs().read(JsonReader(json, "", findings));
  findings.require_clean();
  BOOST_TEST(read->stiffness == 2.5);
  BOOST_TEST(read->law == "linear");
  BOOST_TEST(read->coils == 3);
}

BOOST_AUTO_TEST_CASE(errors_come_from_the_declaration) {
  BOOST_TEST(problems({{"type", "spring"}}) == "/spring/ends: is missing\n");
  BOOST_TEST(problems("spring") == "/spring/ends: is missing\n");
  BOOST_TEST(problems({{"ends", {"a"}}}) == "/spring/type: is missing\n");
  BOOST_TEST(problems(3) == "/spring: is 3; expected an object\n");
  const auto with = [](const char* key, const Json& value) {
    return problems({{"type", "spring"}, {"ends", {"a", "b"}}, {key, value}});
  };
  BOOST_TEST(with("stiffness", 11) == "/spring/stiffness: is 11; expected a number from 0 to 10\n");
  BOOST_TEST(with("stiffness", "x") == "/spring/stiffness: is \"x\"; expected a number\n");
  BOOST_TEST(with("coils", 0) == "/spring/coils: is 0; expected an integer, at least 1\n");
  BOOST_TEST(with("law", "cubc") == "/spring/law: unknown \"cubc\" (did you mean \"cubic\"?)\n");
  BOOST_TEST(with("stifness", 1) ==
             "/spring/stifness: unknown key (did you mean \"stiffness\"?)\n");
}

// A kind that reads what it does not declare, or does not read what it declares, is told so.
BOOST_AUTO_TEST_CASE(declaration_and_reader_are_held_to_each_other) {
  Findings findings;
  const Json json = {{"type", "spring"}, {"ends", {"a", "b"}}, {"label", "x"}};
  const JsonReader place(json, "", findings);
  BOOST_CHECK_THROW(springs([](ObjectReader& object) { object.optional("colour"); }).read(place),
                    std::logic_error);
  BOOST_CHECK_THROW(springs([](ObjectReader& object) { object.number("label"); }).read(place),
                    std::logic_error);
  const Registry<int> deaf({{spring(), [](ObjectReader&) { return std::optional<int>(1); }}});
  BOOST_CHECK_THROW(deaf.read(place), std::logic_error);
}

BOOST_AUTO_TEST_CASE(the_schema_is_that_of_the_declaration) {
  const Json schema = spring().schema();
  BOOST_TEST(schema["required"] == Json({"type", "ends"}));
  BOOST_TEST(schema["properties"]["type"] == Json({{"const", "spring"}}));
  BOOST_TEST(
      schema["properties"]["coils"] ==
      Json({{"description", "how many"}, {"type", "integer"}, {"minimum", 1}, {"default", 3}}));
  BOOST_TEST(schema["additionalProperties"] == false);
  // By its word alone only what has no required keys.
  BOOST_TEST(schema_of("", {spring()})["oneOf"].size() == 1u);
  BOOST_TEST(schema_of("", {spring(), {"rod", "stiff"}})["oneOf"][0] == Json({{"enum", {"rod"}}}));
}

BOOST_AUTO_TEST_CASE(kinds_are_open) {
  Registry<Spring> kinds = springs();
  kinds.add({{"rod", "stiff"}, [](ObjectReader&) { return std::optional<Spring>({1e9, "", 0}); }});
  Findings findings;
  const Json rod = "rod";
  BOOST_TEST(kinds.read(JsonReader(rod, "", findings))->stiffness == 1e9);
  BOOST_TEST(kinds.descriptions().back().type == "rod");
  BOOST_CHECK_THROW(kinds.add({{"rod", "again"}, {}}), std::invalid_argument);
}

// Every key of every kind says what it takes and what it is for.
BOOST_AUTO_TEST_CASE(the_catalogue_is_complete) {
  for (const Shelf& shelf : catalogue()) {
    BOOST_TEST(!shelf.kinds.empty());
    for (const KindDescription& kind : shelf.kinds) {
      BOOST_TEST(!kind.summary.empty());
      for (const Key& key : kind.keys) {
        BOOST_TEST(
            (!key.summary.empty() && !key.takes.text.empty() && key.takes.schema.is_object()),
            kind.type << ": " << key.name);
        BOOST_TEST((!key.required || key.otherwise.is_null()));
      }
      for (const auto& names : kind.one_of)
        for (const std::string& name : names) BOOST_REQUIRE(kind.find(name));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
