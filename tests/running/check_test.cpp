#include "courant/running/check.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

namespace courant {
BOOST_AUTO_TEST_SUITE(check_of_running_test)

// Mistakes that these cases have to notice:
//  * a method is compared with itself alone

namespace {

// Whether the method keeps a law; an empty list of one where the law was not measured.
std::vector<bool> keeps(const Json& experiment, const std::string& law) {
  std::vector<bool> passed;
  const Json report = check_experiment(read_experiment(experiment.dump()));
  for (const Json& check : report.at("checks"))
    if (check.at("subject") == "method" && check.at("law") == law)
      passed.push_back(check.at("passed").get<bool>());
  return passed;
}

}  // namespace

// (e^2t, e^-t, e^2t, e^-t) solves an index-3 problem in an unknown that multiplies states. Method 1 is off by 2.667 at
// t = 1 for all steps, and by P1 it has order 2.
BOOST_AUTO_TEST_CASE(what_converges_to_something_else_does_not_pass) {
  Json experiment = {{"system",
                      {{"type", "implicit"},
                       {"coordinates", {"a", "b", "c", "d"}},
                       {"unknowns", {"u"}},
                       {"equations",
                        {"a' - 2*a*b*c*d", "b' + a*b*d^2", "c' - (a*b + c*d)*u", "d' + a*b^2*d^2*u",
                         "a*b^2 - 1"}}}},
                     {"initial", {{"a", 1}, {"b", 1}, {"c", 1}, {"d", 1}}},
                     {"method", "discretize-first"},
                     {"time", {{"step", 0.01}, {"end", 1}}}};
  BOOST_TEST(keeps(experiment, "P1") == std::vector<bool>{true}, boost::test_tools::per_element());
  BOOST_TEST(keeps(experiment, "P12") == std::vector<bool>{false},
             boost::test_tools::per_element());
  experiment["method"] = "constrain-first";
  BOOST_TEST(keeps(experiment, "P12") == std::vector<bool>{true}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
