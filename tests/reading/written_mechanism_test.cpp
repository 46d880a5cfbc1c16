#include "courant/reading/written_mechanism.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/expressions/graph_parameters.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a rotation is read by columns
//  * a place without a position is the origin of its body
BOOST_AUTO_TEST_SUITE(written_mechanism_test)

namespace {

std::vector<WrittenFormula> formulas(const std::vector<std::string>& texts) {
  std::vector<WrittenFormula> all;
  for (const std::string& text : texts) all.push_back({text, ""});
  return all;
}

}  // namespace

// A body that hangs at the length l, in a frame that is turned by a right angle about z.
BOOST_AUTO_TEST_CASE(numbers_are_formulas_of_parameters) {
  WrittenMechanism written;
  written.gravity = formulas({"0", "0", "-9.81"});
  written.bodies = {{.name = "rod",
                     .pointer = "",
                     .mass = {"2*l", ""},
                     .center = formulas({"0", "0", "-l"}),
                     .inertia = formulas({"1", "2", "3", "4", "5", "6"})}};
  const WrittenMechanism::Pose turned{formulas({"l", "0", "0"}),
                                      formulas({"0", "-1", "0", "1", "0", "0", "0", "0", "1"})};
  WrittenMechanism::Joint hinge_of_rod;
  hinge_of_rod.type = JointType::revolute;
  hinge_of_rod.child = 0;
  hinge_of_rod.origin = hinge_of_rod.child_origin = turned;
  hinge_of_rod.axis = formulas({"0", "0", "3"});
  written.joints = {hinge_of_rod};
  SymbolTable constants;
  constants.add("l", 1.5);
  const Mechanism mechanism = written.at(constants);
  const Mechanism::Body& rod = mechanism.parts().bodies[0];
  BOOST_TEST(rod.mass.value() == 3.0);
  BOOST_TEST(rod.center[2].value() == -1.5);
  BOOST_TEST((values(rod.inertia) - MatrixXd{{1, 4, 5}, {4, 2, 6}, {5, 6, 3}}).norm() == 0.0);
  const Mechanism::Joint& hinge = mechanism.parts().joints[0];
  BOOST_TEST(hinge.origin.r[0].value() == 1.5);
  BOOST_TEST(hinge.origin.R(1, 0).value() == 1.0);
  BOOST_TEST(hinge.axes(2, 0).value() == 1.0);
  BOOST_TEST(written.point({0, {}}, constants).at[2].value() == -1.5);
  BOOST_TEST(written.point({0, formulas({"0", "0", "l"})}, constants).at[2].value() == 1.5);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
