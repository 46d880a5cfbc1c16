#include "courant/reading/json_reader.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/reading/registry.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(json_reader)

namespace {

// The problems as lines `pointer: what`.
std::string lines(const Findings& findings) {
  if (findings.clean()) return "";
  return ExperimentError(findings.problems()).what();
}

}  // namespace

BOOST_AUTO_TEST_CASE(reads_typed_values) {
  const Json json =
      Json::parse(R"({"x": 1, "y": 2.5, "n": 1e6, "s": "text", "a": [1, 2], "o": {"k": 3}})");
  Findings findings;
  {
    ObjectReader object(JsonReader(json, "", findings));
    BOOST_TEST(object.required("x")->number().value() == 1.0);
    BOOST_TEST(object.required("y")->positive_number().value() == 2.5);
    BOOST_TEST(object.required("n")->integer(1).value() == 1000000);
    BOOST_TEST(object.required("s")->text().value() == "text");
    const auto elements = object.required("a")->elements().value();
    BOOST_TEST(elements.at(1).pointer() == "/a/1");
    const auto entries = object.required("o")->entries().value();
    BOOST_TEST(entries.at(0).first == "k");
    BOOST_TEST(entries.at(0).second.pointer() == "/o/k");
    BOOST_TEST(!object.optional("absent"));
  }
  BOOST_TEST(lines(findings) == "");
}

BOOST_AUTO_TEST_CASE(collects_every_problem_with_its_pointer) {
  const Json json = Json::parse(
      R"({"x": "1", "y": -2, "n": 1.5, "s": 3, "a": {}, "word": "ret", "extra": 1, "metod": 1})");
  Findings findings;
  {
    ObjectReader object(JsonReader(json, "/at", findings));
    object.required("x")->number();
    object.required("y")->positive_number();
    object.required("n")->integer(0);
    object.required("s")->text();
    object.required("a")->elements();
    object.required("word")->word({"red", "green", "blue"});
    object.required("missing");
    object.optional("method");
  }
  BOOST_TEST(lines(findings) ==
             "/at/x: is \"1\"; expected a number\n"
             "/at/y: is -2; expected a number greater than 0\n"
             "/at/n: is 1.5; expected an integer, at least 0\n"
             "/at/s: is 3; expected a string\n"
             "/at/a: is an object; expected an array\n"
             "/at/word: unknown \"ret\" (did you mean \"red\"?)\n"
             "/at/missing: is missing\n"
             "/at/extra: unknown key; expected \"x\", \"y\", \"n\", \"s\", \"a\", \"word\", "
             "\"missing\" or "
             "\"method\"\n"
             "/at/metod: unknown key (did you mean \"method\"?)");
}

BOOST_AUTO_TEST_CASE(integers_beyond_those_that_a_number_holds_are_said_to_be_large) {
  for (const double large : {1e16, 1e30}) {
    Findings findings;
    const Json json = large;
    BOOST_TEST(!JsonReader(json, "/n", findings).integer(1).has_value());
    BOOST_TEST(lines(findings).ends_with("; expected an integer, at most 9007199254740992"),
               lines(findings));
  }
  Findings findings;
  const Json largest = 9007199254740992.0;
  BOOST_TEST((JsonReader(largest, "/n", findings).integer(1) == Index{9007199254740992}));
}

BOOST_AUTO_TEST_CASE(long_values_are_cut_in_messages_between_characters) {
  const Json json = std::string(39, 'a') + "ää" + std::string(100, 'a');
  Findings findings;
  JsonReader(json, "", findings).number();
  const std::string what = findings.problems().at(0).what;
  BOOST_TEST(what.size() < 80u);
  BOOST_TEST(Json(what).dump().size() > 0u);  // throws for broken UTF-8
}

BOOST_AUTO_TEST_CASE(fills_defaults_in) {
  const Json json = Json::parse(R"({"time": {"step": 1}})");
  Findings findings;
  {
    ObjectReader object(JsonReader(json, "", findings));
    ObjectReader time(*object.required("time"));
    time.required("step");
    BOOST_TEST(time.number("start", 0.5) == 0.5);
    BOOST_TEST(object.word("format", "csv", {"csv", "npy"}) == "csv");
  }
  BOOST_TEST(findings.completed(json).dump() ==
             R"({"time":{"step":1,"start":0.5},"format":"csv"})");
}

BOOST_AUTO_TEST_CASE(a_registry_reads_objects_and_their_types_alone) {
  const Registry<double> shapes({
      {{"point", ""}, [](ObjectReader&) { return std::optional(0.0); }},
      {{"square", "", {default_key("side", takes::number(), 2.0, "")}},
       [](ObjectReader& object) {
         const double side = object.number("side");
         return std::optional(side * side);
       }},
  });
  const auto read = [&](const char* text, Findings& findings) {
    const Json json = Json::parse(text);
    return shapes.read(JsonReader(json, "/shape", findings));
  };
  Findings fine;
  BOOST_TEST(read(R"("point")", fine).value() == 0.0);
  BOOST_TEST(read(R"({"type": "square", "side": 3})", fine).value() == 9.0);
  BOOST_TEST(lines(fine) == "");
  Findings defaults;
  read(R"("square")", defaults);
  BOOST_TEST(defaults.completed(Json{{"shape", "square"}}).dump() ==
             R"({"shape":{"type":"square","side":2.0}})");
  Findings wrong;
  BOOST_TEST(!read(R"("sqare")", wrong));
  BOOST_TEST(!read(R"({"side": 1})", wrong));
  BOOST_TEST(!read(R"({"type": "circle", "radius": 1})", wrong));
  read(R"({"type": "square", "sid": 1})", wrong);
  BOOST_TEST(lines(wrong) ==
             "/shape: unknown \"sqare\" (did you mean \"square\"?)\n"
             "/shape/type: is missing\n"
             "/shape/type: is \"circle\"; expected \"point\" or \"square\"\n"
             "/shape/sid: unknown key (did you mean \"side\"?)");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
