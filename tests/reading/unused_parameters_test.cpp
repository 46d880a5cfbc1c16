#include "courant/reading/unused_parameters.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
BOOST_AUTO_TEST_SUITE(unused_parameters_test)

namespace {

Json circuit() {
  return Json::parse(R"json({
    "title": "about Rs",
    "system": { "type": "network", "parameters": { "R": 2, "Rs": 3, "C": "1/tau", "tau": 0.1 },
      "nodes": ["0", "a"], "elements": [
        { "type": "resistor", "name": "R1", "from": "a", "value": "2*R" },
        { "type": "capacitor", "name": "C1", "from": "a", "value": "C" } ] },
    "initial": { "q_C1": 1 } })json");
}

}  // namespace

// A title uses nothing; the formula of another parameter does.
BOOST_AUTO_TEST_CASE(a_parameter_that_no_formula_has_is_told) {
  const auto found = unused_parameters(circuit());
  BOOST_TEST_REQUIRE(found.size() == 1u);
  BOOST_TEST(found[0].where == "/system/parameters/Rs");
  BOOST_TEST(found[0].what == "nothing uses the parameter \"Rs\" (did you mean \"R\"?)");
  Json used = circuit();
  used["initial"]["q_C1"] = "Rs^2";
  BOOST_TEST(unused_parameters(used).empty());
  used = circuit();
  used["// note"] = "Rs";
  BOOST_TEST(unused_parameters(used).size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_change_of_such_a_parameter_is_refused) {
  Json document = circuit();
  const std::vector<Setting> slip = {{"/system/parameters/Rr", 1}},
                             right = {{"/system/parameters/R", 1}};
  apply_setting(slip[0], document);
  BOOST_CHECK_THROW(require_used(document, slip), ExperimentError);
  BOOST_CHECK_NO_THROW(require_used(document, right));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
