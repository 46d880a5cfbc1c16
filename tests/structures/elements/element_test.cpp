#include "courant/structures/elements/element.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "element_numbers.hpp"

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * a law has the variables of the first element of the network (structures/elements/element.cpp, bound)
//  * the states of an element are counted from 0
BOOST_AUTO_TEST_SUITE(elements_element_test)

// Two branches and two states, whose laws and energy tell all of them apart.
BOOST_AUTO_TEST_CASE(laws_are_in_the_variables_of_the_element) {
  const auto state = NetworkBranch::Kind::charge;
  const Element element{
      .branches =
          {{.law = [](const Variables& own) { return own.current(1) + 10.0 * own.voltage(0); }},
           {.kind = state, .role = NetworkBranch::Role::storage, .letters = "a_"},
           {.from = 2,
            .to = Element::ground,
            .kind = state,
            .role = NetworkBranch::Role::storage,
            .law = [](const Variables& own) { return own.state(1) - own.t(); },
            .letters = "b_"}},
      .energy = [](const ExprVector& own, const ExprVector&, const Expr&) {
        return own[0] + 10.0 * own[1];
      }};
  BOOST_TEST(element.terminal_count() == 3);
  BOOST_TEST(element.state_count() == 2);
  BOOST_TEST(energy_of(element, VectorXd{{2.0, 3.0}}) == 32.0);
  check_laws(element, VectorXd{{2.0, 3.0, 4.0}}, VectorXd{{5.0, 6.0, 7.0}}, {53.0, 9.0 - 0.25});

  const std::vector<NetworkBranch> branches = placed(element, "E", {4, 5, 6}, 3, {7, 8});
  BOOST_TEST(branches[0].voltage_name == "v_E");
  BOOST_TEST(branches[1].state_name == "a_E");
  BOOST_TEST(branches[2].from == 6);
  BOOST_TEST(branches[2].to == 0);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::elements
