#include "courant/running/experiment_changes.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
BOOST_AUTO_TEST_SUITE(experiment_changes_test)

namespace {

const Json begun = {{"title", "one"},
                    {"system", {{"type", "x"}, {"parameters", {{"a", 1}, {"b/c", {1, 2, 3}}}}}},
                    {"time", {{"step", 0.1}, {"end", 10}}},
                    {"$run", "0123"}};

std::string changes(const Json& now) {
  std::string text;
  for (const Problem& problem : experiment_changes(begun, now))
    text += problem.where + " " + problem.what + "\n";
  return text;
}

Json with(const char* pointer, const Json& value) {
  Json json = begun;
  json[Json::json_pointer(pointer)] = value;
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_end_and_the_id_may_change) {
  BOOST_TEST(changes(begun) == "");
  BOOST_TEST(changes(with("/time/end", "2*pi")) == "");
  BOOST_TEST(changes(with("/$run", "4567")) == "");
  Json without = begun;
  without.erase("$run");
  BOOST_TEST(changes(without) == "");
  BOOST_TEST(changes(with("/system/parameters/a", 1.0)) == "");  // the same number
}

BOOST_AUTO_TEST_CASE(each_change_has_its_place) {
  BOOST_TEST(changes(with("/title", "two")) ==
             "/title is \"two\"; the run was begun with \"one\"\n");
  BOOST_TEST(changes(with("/time/start", 0)) == "/time/start is 0; the run was begun without it\n");
  BOOST_TEST(changes(with("/system/parameters/b~1c/1", 5)) ==
             "/system/parameters/b~1c/1 is 5; the run was begun with 2\n");
  BOOST_TEST(changes(with("/system/parameters/b~1c", {1, 2})) ==
             "/system/parameters/b~1c is [1,2]; the run was begun with [1,2,3]\n");
  Json without = begun;
  without["system"].erase("type");
  without["time"]["step"] = 0.2;
  BOOST_TEST(changes(without) ==
             "/system/type is missing; the run was begun with \"x\"\n"
             "/time/step is 0.2; the run was begun with 0.1\n");
  BOOST_TEST(changes(with("/title", std::string(100, 'a'))) ==
             "/title is \"" + std::string(39, 'a') + "…; the run was begun with \"one\"\n");
}

BOOST_AUTO_TEST_CASE(the_order_of_keys_counts_below_the_first_level) {
  Json other = Json::object();
  for (const char* key : {"time", "title", "system"}) other[key] = begun[key];
  BOOST_TEST(changes(other) == "");
  other["system"] = {{"parameters", begun["system"]["parameters"]}, {"type", "x"}};
  BOOST_TEST(changes(other) ==
             "/system has its keys in another order than the run was begun with\n");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
