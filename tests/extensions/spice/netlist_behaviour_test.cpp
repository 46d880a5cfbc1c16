#include "courant/extensions/spice/netlist_behaviour.hpp"

#include <boost/test/unit_test.hpp>

namespace courant::netlist {
BOOST_AUTO_TEST_SUITE(netlist_behaviour_test)

namespace {

std::string law(const std::string& expression) {
  const Scope scope = {{"gain", "x1_gain"}};
  return behaviour(expression, scope, 3,
                   {[](const std::string& node) { return "potential_" + node; },
                    [](const std::string& source) { return "i_" + source; }});
}

std::string refusal(const std::string& expression) {
  try {
    law(expression);
  } catch (const LineError& error) {
    return error.what;
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(potentials_currents_and_numbers) {
  BOOST_TEST(law("V(A, b)*2k + I(V1)**2") == "(potential_a - potential_b)*2000 + i_v1^2");
  BOOST_TEST(law("gain*time + 1e-3") == "x1_gain*t + 0.001");
  BOOST_TEST(law("pow(V(a), 2)") == "(potential_a)^(2)");
  BOOST_TEST(law("ln(10) + sgn(-1)") == "log(10) + sign(-1)");
}

BOOST_AUTO_TEST_CASE(choices_may_stand_in_choices) {
  BOOST_TEST(law("V(a)>1?V(a)>2?3:4:5") == "if(potential_a>1, if(potential_a>2, 3, 4), 5)");
  BOOST_TEST(law("2*(time < 1 ? 3 : 4)") == "2*(if(t < 1, 3, 4))");
}

BOOST_AUTO_TEST_CASE(tables_and_polynomials) {
  BOOST_TEST(law("table(V(a),0,1,2,5)") ==
             "(1 + (5 - (1))*(min(max(potential_a, 0), 2) - (0))/(2 - (0)))");
  BOOST_TEST(polynomial({"u"}, {"3"}, 1) == "3*u");
  BOOST_TEST(polynomial({"u", "w"}, {"1", "2", "0", "4", "5"}, 1) == "1 + 2*u + 4*u*u + 5*u*w");
  BOOST_CHECK_THROW(polynomial({"u"}, std::vector<std::string>(5, "1"), 1), LineError);
}

BOOST_AUTO_TEST_CASE(what_has_no_formula_is_refused) {
  BOOST_TEST(refusal("ddt(V(a))") == "the function ddt is not supported");
  BOOST_TEST(refusal("V(a) ? 1") == "has a ? without its :");
  BOOST_TEST(refusal("(1 + 2") == "has a ( without its )");
  BOOST_TEST(refusal("beta") == "unknown parameter \"beta\"");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::netlist
