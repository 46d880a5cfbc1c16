#include "courant/running/run_summary_check.hpp"

#include <boost/test/unit_test.hpp>

#include "vortex_runs.hpp"

BOOST_AUTO_TEST_SUITE(run_summary_check)

using courant::summary_defect;
using Json = nlohmann::ordered_json;

namespace {

const Json good = courant::test::summary(courant::test::rk2_path(3), "rk2");

// What is said about the summary with the value at the pointer replaced.
std::string said(const std::string& pointer, const Json& value) {
  Json changed = good;
  changed[Json::json_pointer(pointer)] = value;
  return summary_defect(changed).value_or("accepted");
}

}  // namespace

BOOST_AUTO_TEST_CASE(summary_of_the_contract_is_accepted) {
  BOOST_TEST(!summary_defect(good));
  const Json least = {{"status", "failed"}, {"system", "s"}, {"method", "m"}, {"steps", 0}};
  BOOST_TEST(!summary_defect(least));
  BOOST_TEST(said("/later", "a key of a later version") == "accepted");
  BOOST_TEST(said("/observables/H/max_drift", nullptr) == "accepted");
  BOOST_TEST(said("/expectations/0/value", "regular") == "accepted");
}

BOOST_AUTO_TEST_CASE(first_defect_is_said_with_its_pointer) {
  BOOST_TEST(said("/status", 3) == "/status: is number, expected a string.");
  BOOST_TEST(said("/steps", "many") == "/steps: is string, expected a number.");
  BOOST_TEST(said("/time", Json::array()) == "/time: is array, expected an object.");
  BOOST_TEST(said("/time/step", true) == "/time/step: is boolean, expected a number.");
  BOOST_TEST(said("/observables/spread", 1) ==
             "/observables/spread: is number, expected an object.");
  BOOST_TEST(said("/observables/H/min", "low") ==
             "/observables/H/min: is string, expected a number.");
  BOOST_TEST(said("/ladder/levels", Json::object()) ==
             "/ladder/levels: is object, expected an array.");
  BOOST_TEST(said("/ladder/levels/1/dim_S", "8") ==
             "/ladder/levels/1/dim_S: is string, expected a number.");
  BOOST_TEST(said("/ladder", Json::object()) == "/ladder/verdict: is missing.");
  BOOST_TEST(said("/expectations/0/passed", 1) ==
             "/expectations/0/passed: is number, expected true or false.");
  BOOST_TEST(summary_defect(Json::array()).value_or("") == "is array, expected an object.");
  for (const char* key : {"status", "system", "method", "steps"}) {
    Json without = good;
    without.erase(key);
    BOOST_TEST(summary_defect(without).value_or("") == "/" + std::string(key) + ": is missing.");
  }
}

BOOST_AUTO_TEST_SUITE_END()
