#include "courant/integrators/step/open_jets.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/solve/unknown_selection.hpp"
#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/step/step_formulas.hpp"
#include "courant/tests/integrators/held_on_sphere.hpp"

using namespace courant;
using Roles = std::vector<JetRole>;
using Places = std::vector<Index>;

namespace {

constexpr JetRole asked = JetRole::asked_for, carried = JetRole::carried,
                  holdable = JetRole::may_be_held;

// What is open of F(y; p) at y = at and p = parameter.
template <class Formulas>
OpenJets open_of(const Roles& roles, const VectorXd& at, const Formulas& formulas,
                 double parameter = 0.7) {
  Graph graph;
  const ExprVector y = graph.variables("y", std::ssize(roles)), p = graph.variables("p", 1);
  const Function F("F", {{"y", y}, {"p", p}}, formulas(y, p[0]), {.differentiate = {"y"}});
  return open_jets(F, {at, VectorXd::Constant(1, parameter)}, roles);
}

ExprVector rows(std::initializer_list<Expr> list) {
  ExprVector result(std::ssize(list));
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

}  // namespace

// Mistakes that these cases have to notice:
//  * equations whose Jacobian by what is open vanishes are left out
//  * equations of what is asked for are left out
//  * what moves with what is asked for is held
//  * what hardly moves is held
BOOST_AUTO_TEST_SUITE(open_jets_test)

// y₁ and y₂ take whatever values meet the second equation.
BOOST_AUTO_TEST_CASE(equations_of_open_unknowns_are_left_out) {
  const OpenJets open =
      open_of({asked, carried, holdable}, Eigen::Vector3d(0.7, 1.0, 1.0), [](auto& y, auto& p) {
        return rows({sin(y[0]) - sin(p), y[0] * y[1] + 2.0 * y[2]});
      });
  BOOST_TEST(open.equations == Places({1}));
  BOOST_TEST(open.unknowns.empty());
}

// Two equations for two unknowns of their own and a third one, which the first equation determines.
BOOST_AUTO_TEST_CASE(groups_of_equations_are_left_out) {
  const OpenJets open = open_of(
      {asked, carried, carried, holdable}, VectorXd::Constant(4, 0.7), [](auto& y, auto& p) {
        return rows({y[1] + y[2] * y[0] + y[3], y[0] - p, y[1] - y[2] + 3.0 * y[3] - cos(y[0])});
      });
  BOOST_TEST(open.equations == Places({0, 2}));
}

BOOST_AUTO_TEST_CASE(what_is_determined_stays) {
  const OpenJets open =
      open_of({asked, carried, carried}, VectorXd::Constant(3, 0.7), [](auto& y, auto& p) {
        return rows({y[0] + y[1] - p, y[1] * y[2] - p, y[2] - y[0]});
      });
  BOOST_TEST(open.equations.empty());
  BOOST_TEST(open.unknowns.empty());
}

// y₀ is asked for, and moves with what is open.
BOOST_AUTO_TEST_CASE(what_is_asked_for_stays) {
  const OpenJets open =
      open_of({asked, carried, holdable}, VectorXd::Constant(3, 0.7), [](auto& y, auto& p) {
        return rows({y[0] + y[1] - p, y[1] + y[2]});
      });
  BOOST_TEST(open.equations.empty());
  BOOST_TEST(open.unknowns.empty());
}

// (y₀ - p, y₁ + y₂) in other combinations: each equation contains y₀, and no group is by itself.
BOOST_AUTO_TEST_CASE(open_unknowns_are_held) {
  const auto mixed = [](const ExprVector& y, const Expr& p) {
    const Expr a = y[0] - p, b = y[1] + y[2] * y[2];
    return rows({0.6 * a + 0.8 * b, 0.8 * a - 0.6 * b});
  };
  const VectorXd at = Eigen::Vector3d(0.7, -0.25, 0.5);
  BOOST_TEST(open_of({asked, carried, holdable}, at, mixed).unknowns == Places({2}));
  BOOST_TEST(open_of({asked, holdable, carried}, at, mixed).unknowns == Places({1}));
  // None that could be, and one that the open direction does not move.
  BOOST_TEST(open_of({asked, carried, carried}, at, mixed).unknowns.empty());
  BOOST_TEST(open_of({holdable, carried, carried}, at, mixed).unknowns.empty());
}

// Where the coefficients vanish the equation says something of y₀.
BOOST_AUTO_TEST_CASE(equations_without_full_rank_stay) {
  const auto vanishing = [](const ExprVector& y, const Expr& p) {
    return rows({y[0] - p, (p - 0.7) * (y[1] + y[2]) + y[0] - 0.7});
  };
  const Roles roles = {asked, carried, holdable};
  BOOST_TEST(open_of(roles, VectorXd::Constant(3, 0.7), vanishing).equations.empty());
  BOOST_TEST(open_of(roles, VectorXd::Constant(3, 0.7), vanishing, 0.9).equations == Places({1}));
}

// The derivative of the multiplier is where p'' is, and only there. Coordinates of T*S³ mix the equations.
BOOST_AUTO_TEST_CASE(steps_on_spheres_have_as_many_equations_as_unknowns) {
  const examples::HeldOnSphere held;
  const ConstrainFirst method(
      held.system, held.ladder,
      std::make_shared<CotangentLift>(held.M, std::make_shared<Chordal>(held.sphere)),
      std::make_shared<OrthogonalProjector>());
  for (const StepFormulas& formulas : method.formulas()) {
    BOOST_TEST_REQUIRE(formulas.held.size() == 1U);
    BOOST_TEST(formulas.held.front().ends_with("'"), formulas.held.front());
    BOOST_TEST(formulas.left_out.empty());
    const Function whole = formulas.whole();
    const ContainedUnknowns contained(whole);
    BOOST_TEST(std::ssize(contained.places) == whole.output_size());
    BOOST_TEST(explanation(formulas).find("' = 0, since nothing depends on it") !=
               std::string::npos);
  }
}

BOOST_AUTO_TEST_SUITE_END()
