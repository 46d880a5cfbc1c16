#include "courant/reading/setting.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
// Mistakes that these cases have to notice:
//  * the last value of a range has the round-off of what is in between
BOOST_AUTO_TEST_SUITE(setting)

namespace {

Json values(const std::string& text) { return read_range("/a=" + text).values; }

std::string refusal(const std::string& text) {
  try {
    read_range(text);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(values_are_json_or_texts) {
  BOOST_TEST(read_setting("/a/b=0.5").pointer == "/a/b");
  BOOST_TEST(read_setting("/a=0.5").value == Json(0.5));
  BOOST_TEST(read_setting("/a=[1, 2]").value == Json({1, 2}));
  BOOST_TEST(read_setting("/a=2*pi").value == Json("2*pi"));
  BOOST_TEST(read_setting("/a=x=1").value == Json("x=1"));
  BOOST_CHECK_THROW(read_setting("a=1"), ExperimentError);
  BOOST_CHECK_THROW(read_setting("/a"), ExperimentError);
}

BOOST_AUTO_TEST_CASE(values_go_where_there_is_a_place) {
  Json document = {{"time", {{"step", 0.1}}}, {"list", {1, 2}}};
  apply_setting({"/time/step", 0.2}, document);
  apply_setting({"/time/end", 3}, document);
  apply_setting({"/list/1", 5}, document);
  BOOST_TEST(document == Json({{"time", {{"step", 0.2}, {"end", 3}}}, {"list", {1, 5}}}));
  for (const char* nowhere : {"/tim/step", "/list/2", "/time/step/x", "/~2"})
    BOOST_CHECK_THROW(apply_setting({nowhere, 1}, document), ExperimentError);
}

BOOST_AUTO_TEST_CASE(a_word_stands_for_its_type) {
  Json document = {{"method", "discretize-first"}};
  apply_setting({"/method/discretization", "midpoint"}, document);
  BOOST_TEST(document ==
             Json({{"method", {{"type", "discretize-first"}, {"discretization", "midpoint"}}}}));
  document = {{"initial", "rest"}};
  apply_setting({"/initial/A", 0.3}, document);
  BOOST_TEST(document == Json({{"initial", {{"rest", true}, {"A", 0.3}}}}));
}

BOOST_AUTO_TEST_CASE(a_table_of_cases_has_its_rows_as_cases) {
  const auto ranges =
      read_cases("/a,/b/c\r\n1,\"x, \"\"y\"\"\"\n2.5,\"{\"\"d\"\": 3}\"\n", "cases.csv");
  BOOST_TEST_REQUIRE(ranges.size() == 2u);
  BOOST_TEST(ranges[1].pointer == "/b/c");
  BOOST_TEST(ranges[1].is_tied);
  const auto all = combinations(ranges);
  BOOST_TEST_REQUIRE(all.size() == 2u);
  BOOST_TEST(all[0][1].value == Json("x, \"y\""));
  BOOST_TEST(all[1][0].value == Json(2.5));
  BOOST_TEST(all[1][1].value == Json({{"d", 3}}));
  std::vector<ValueRange> both = ranges;
  both.push_back({"/e", {1, 2, 3}});
  BOOST_TEST(combinations(both).size() == 6u);
  const auto says = [](const char* text) {
    try {
      read_cases(text, "cases.csv");
    } catch (const ExperimentError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(says("/a,/b\n1\n").find("--sweep cases.csv: line 2 has 1 cells; expected 2") == 0u);
  BOOST_TEST(says("a,b\n1,2\n").find("line 1 has \"a\"; expected a JSON pointer") !=
             std::string::npos);
  BOOST_TEST(says("/a\n").find("has no cases") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(ranges_have_both_ends_and_equal_distances) {
  BOOST_TEST(values("0:1:11") == Json({0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1}));
  BOOST_TEST(values("3:1:3") == Json({3, 2, 1}));
  BOOST_TEST(values("0.1:9:1") == Json::array({0.1}));
  // The last is b itself, whatever the round-off of what is in between.
  BOOST_TEST(values("0.7:0.1:7").back() == Json(0.1));
}

BOOST_AUTO_TEST_CASE(lists_are_parted_outside_brackets) {
  BOOST_TEST(values("1,2.5,pi") == Json({1, 2.5, "pi"}));
  BOOST_TEST(values("rk4") == Json::array({"rk4"}));
  BOOST_TEST(values(R"([1, 2],{"type": "theta", "theta": 0.5},"a,b")") ==
             Json({Json({1, 2}), {{"type", "theta"}, {"theta", 0.5}}, "a,b"}));
  BOOST_TEST(values("min(1, 2),3") == Json({"min(1, 2)", 3}));
}

BOOST_AUTO_TEST_CASE(what_is_no_range_is_refused) {
  BOOST_TEST(refusal("/a=0:1:x").find("--sweep /a: is 0:1:x; expected a:b:n") == 0u);
  BOOST_TEST(refusal("/a=0:1:0").find("--sweep /a: has 0 values; expected 1 to") == 0u);
  BOOST_TEST(refusal("/a=0:1:1000000").find("has 1000000 values") != std::string::npos);
  BOOST_TEST(refusal("/a=0:1e999:3").find("expected a:b:n") != std::string::npos);
  BOOST_TEST(refusal("/a=1,,2").find("has a value that is empty") != std::string::npos);
  BOOST_TEST(refusal("/a=").find("has a value that is empty") != std::string::npos);
  BOOST_TEST(refusal("a=1").find("is not a change") != std::string::npos);
}

// Two numbers with a colon, and three that are not, are no texts: no place has such a value.
BOOST_AUTO_TEST_CASE(half_a_range_is_refused) {
  BOOST_TEST(
      refusal("/a=0.1:0.2") ==
      "--sweep /a: is 0.1:0.2; expected a:b:n, n numbers from a to b, such as 0.1:1:10, or a "
      "list v,w,…");
  BOOST_TEST(values("x:y") == Json::array({"x:y"}));
}

BOOST_AUTO_TEST_CASE(places_are_called_by_as_much_as_tells_them_apart) {
  const Json document = {
      {"system", {{"elements", {{{"name", "R1"}, {"value", 1}}, {{"name", "C1"}, {"value", 2}}}}}},
      {"initial", {{"x", {1, 2}}}},
      {"time", {{"step", 1}}},
      {"output", {{"step", 1}}}};
  const auto names = [&](const std::vector<std::string>& pointers) {
    return short_names(pointers, document);
  };
  using Names = std::vector<std::string>;
  BOOST_TEST(names({"/system/elements/0/value", "/time/step"}) == Names({"value", "step"}));
  BOOST_TEST(names({"/system/elements/0/value", "/system/elements/1/value", "/initial/x/1"}) ==
             Names({"R1/value", "C1/value", "1"}));
  BOOST_TEST(names({"/time/step", "/output/step"}) == Names({"time/step", "output/step"}));
  // A place that is not there yet, and one that stands there twice.
  BOOST_TEST(names({"/method/step", "/time/step"}) == Names({"method/step", "time/step"}));
  BOOST_TEST(names({"/time/step", "/time/step"}) == Names({"time/step", "time/step"}));
}

BOOST_AUTO_TEST_CASE(all_combinations_the_last_range_fastest) {
  const std::vector<ValueRange> ranges = {{"/a", {1, 2}}, {"/b", {"x", "y", "z"}}};
  const auto all = combinations(ranges);
  BOOST_TEST_REQUIRE(all.size() == 6u);
  BOOST_TEST(all[0][0].value == Json(1));
  BOOST_TEST(all[1][1].value == Json("y"));
  BOOST_TEST(all[5][0].value == Json(2));
  BOOST_TEST(all[5][1].value == Json("z"));
  const std::vector<Json> thousand(1000, 1);
  BOOST_CHECK_THROW(combinations(std::vector<ValueRange>{{"/a", thousand}, {"/b", thousand}}),
                    ExperimentError);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
