#include "courant/structures/elements/transistors.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "element_numbers.hpp"

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * a p-n-p has the branches of an n-p-n
BOOST_AUTO_TEST_SUITE(elements_transistors_test)

// Between joined terminals there is no branch; a p-n-p has its branches the other way.
BOOST_AUTO_TEST_CASE(transistors_have_the_branches_of_their_terminals) {
  const auto branches = [](const Element& element, const std::vector<Index>& nodes) {
    NetworkAssembly assembly;
    assembly.add("Q", element, nodes);
    std::vector<std::string> all;
    for (const NetworkBranch& branch : assembly.branches())
      all.push_back(branch.name + " " + std::to_string(branch.from) + std::to_string(branch.to));
    return all;
  };
  const JunctionCharge none, charge{.capacitance = 1e-12};
  BOOST_TEST(branches(bipolar_transistor({}, charge, none, false), {1, 2, 3}) ==
                 (std::vector<std::string>{"Q_be 23", "Q_bc 21", "Q_be_charge 23"}),
             boost::test_tools::per_element());
  BOOST_TEST(branches(bipolar_transistor({}, none, charge, true), {1, 2, 3}) ==
                 (std::vector<std::string>{"Q_be 32", "Q_bc 12", "Q_bc_charge 12"}),
             boost::test_tools::per_element());
  BOOST_TEST(branches(bipolar_transistor({}, charge, charge, false, {0, 1, 1}), {1, 2, 2}) ==
                 (std::vector<std::string>{"Q_bc 21", "Q_bc_charge 21"}),
             boost::test_tools::per_element());
  BOOST_TEST(branches(mos_transistor({}, false, {0, 1, 2, 2}), {1, 2, 3, 3}) ==
                 (std::vector<std::string>{"Q_ds 13", "Q_gs 23"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::elements
