#include "courant/reading/network_quantities.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
// Mistakes that these cases have to notice:
//  * a formula that is repeated is wrong in each turn
BOOST_AUTO_TEST_SUITE(network_quantities_test)

namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

const NetworkNodes nodes = {
    .names = {"0", "a"}, .pointers = {"", ""}, .index = {{"0", 0}, {"a", 1}}};

NetworkElement with_formula(const std::string& text, const std::string& turn = "") {
  NetworkElement element{.type = "resistor", .name = "R", .pointer = "/R", .turn = turn};
  element.formulas = {{text, "/R/value"}};
  return element;
}

NetworkWords words() {
  NetworkWords result;
  result.vocabulary.coordinates.append({"q_C", {}});
  result.currents["i_C"] = 0;
  result.voltages["v_C"] = 0;
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(potentials_have_the_names_of_their_domains) {
  BOOST_TEST(potential_names(nodes, {nullptr, &elements::domains::electrical}) ==
                 std::vector<std::string>{"potential_a"},
             boost::test_tools::per_element());
  BOOST_TEST(potential_names(nodes, {nullptr, &elements::domains::thermal}) ==
                 std::vector<std::string>{"temperature_a"},
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(laws_know_currents_and_potentials_and_energies_do_not) {
  Findings findings;
  BOOST_TEST(check_formulas({with_formula("q_C + i_C*v_C + potential_a + t")}, words(),
                            {"potential_a"}, findings));
  NetworkElement energy = with_formula("q_C");
  energy.energy_formulas = {{"q_C*i_C", "/R/energy"}};
  BOOST_TEST(!check_formulas({energy}, words(), {}, findings));
  BOOST_TEST_REQUIRE(findings.problems().size() == 1u);
  BOOST_TEST(findings.problems()[0].where == "/R/energy");
}

// One that stands for several elements is wrong once, in its first turn.
BOOST_AUTO_TEST_CASE(a_formula_that_is_repeated_is_wrong_once) {
  Findings findings;
  BOOST_TEST(
      !check_formulas({with_formula("unheard", " (i = 0)"), with_formula("unheard", " (i = 1)")},
                      words(), {}, findings));
  BOOST_TEST_REQUIRE(findings.problems().size() == 1u);
  BOOST_TEST(findings.problems()[0].what.ends_with(" (i = 0)"));
}

// v = q/2 across a capacitor between a and the ground, whose current is q' = 3.
BOOST_AUTO_TEST_CASE(what_is_no_unknown_is_computed) {
  const std::vector<NetworkBranch> branches = {{.name = "C",
                                                .from = 1,
                                                .to = 0,
                                                .kind = Kind::charge,
                                                .role = Role::storage,
                                                .current_name = "i_C",
                                                .voltage_name = "v_C",
                                                .state_name = "q_C"}};
  const auto network = std::make_shared<Network>(
      2, branches, [](const ExprVector& x, const Expr&) { return square(x[0]) / 4.0; });
  Vocabulary vocabulary = words().vocabulary;
  const Vocabulary::Derived derived =
      network_quantities(network, vocabulary, 1, nodes, {nullptr, &elements::domains::electrical});
  BOOST_TEST(
      derived.names.element_names() == (std::vector<std::string>{"i_C", "v_C", "potential_a"}),
      boost::test_tools::per_element());
  const ExprVector x = ExprVector::Constant(1, Expr(5.0)), v = ExprVector::Constant(1, Expr(3.0));
  const ExprVector z(0);
  const Expr t(0.0);
  const auto values = derived.values({.x = x, .velocity = v, .z = z, .t = t});
  BOOST_TEST_REQUIRE(values.has_value());
  BOOST_TEST((*values)[0].value() == 3.0);
  BOOST_TEST((*values)[1].value() == 2.5);
  BOOST_TEST((*values)[2].value() == 2.5);
  BOOST_TEST(!derived.values({.x = x}).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
