#include "courant/reading/json_document.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

namespace courant {
BOOST_AUTO_TEST_SUITE(json_document)

namespace {

// The problem of a text that is not a document, as `where: what`.
std::string problem(const std::string& text) {
  try {
    parse_json(text);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(keeps_values_and_the_order_of_keys) {
  const Json document = parse_json(
      R"({"b": [1, -2.5e3, true, null, "ä"], "a": {"c": {}}, "n": 18446744073709551615})");
  BOOST_TEST(document.dump() ==
             R"({"b":[1,-2500.0,true,null,"ä"],"a":{"c":{}},"n":18446744073709551615})");
  BOOST_TEST(parse_json("3").dump() == "3");
}

BOOST_AUTO_TEST_CASE(a_truncated_text_ends_too_soon) {
  const std::string text = R"({"system": {"type": "lagrangian", "coordinates": ["x"]}})";
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string found = problem(text.substr(0, size));
    BOOST_TEST(found.find("line 1, column ") == 0u, found);
    BOOST_TEST(found.find('\n') == std::string::npos);
  }
  BOOST_TEST(problem("{\n  \"a\": [1,\n") ==
             "line 3, column 1: the text ends too soon: it is not complete JSON");
}

BOOST_AUTO_TEST_CASE(says_where_it_is_not_json) {
  BOOST_TEST(
      problem("{\n  \"a\": 1,\n  \"ä\": tru\n}").find("line 3, column 11: is not JSON") == 0u,
      problem("{\n  \"a\": 1,\n  \"ä\": tru\n}"));
  BOOST_TEST(problem("{} x").find("line 1, column 4: ") == 0u, problem("{} x"));
  BOOST_TEST(problem("[1e999]").find("line 1, column ") == 0u, problem("[1e999]"));
  BOOST_TEST(problem("[\"\xff\"]").find("line 1, column ") == 0u);
}

BOOST_AUTO_TEST_CASE(refuses_keys_that_repeat_in_one_object) {
  BOOST_TEST(problem(R"({"a": 1, "b": {"c": [0, {"d": 1, "d": 1}]}, "a": 2})") ==
             "/b/c/1/d: is there twice\n/a: is there twice");
  BOOST_TEST(problem(R"({"x/y": 1, "x/y": 1})") == "/x~1y: is there twice");
  BOOST_TEST(problem(R"({"a": {"x": 1}, "b": {"x": 1}, "c": [{"x": 1}, {"x": 1}]})") == "");
}

BOOST_AUTO_TEST_CASE(refuses_bottomless_nesting) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  BOOST_TEST(problem(deep).find("is nested deeper than 100 levels") != std::string::npos);
  const std::string hundred = std::string(100, '[') + std::string(100, ']');
  BOOST_TEST(problem(hundred) == "");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
