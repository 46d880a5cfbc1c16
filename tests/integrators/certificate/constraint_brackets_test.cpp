#include "courant/integrators/certificate/constraint_brackets.hpp"

#include <boost/test/unit_test.hpp>
#include <map>
#include <memory>
#include <string>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/lagrangian_system.hpp"

BOOST_AUTO_TEST_SUITE(constraint_brackets_test)

using namespace courant;

namespace {

std::shared_ptr<const CotangentBundle> phase_space(Index n) {
  return std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(n));
}

std::optional<ConstraintBrackets> brackets(const ImplicitSystem& system,
                                           const InitialGuess& guess) {
  const ConstraintLadder ladder = ConstraintAlgorithm().run(
      std::shared_ptr<const ImplicitSystem>(std::shared_ptr<void>(), &system), guess);
  return constraint_brackets(system, ladder, constraint_formulas(system, ladder));
}

std::map<std::string, std::string> dirac(const ConstraintBrackets& found) {
  std::map<std::string, std::string> all;
  for (const auto& [first, second, value] : found.dirac_brackets) all[first + "," + second] = value;
  return all;
}

}  // namespace

// L = (x v_y - y v_x)/2 - (x² + y²)/2: p_x + y/2 and p_y - x/2 have bracket ±1, and {x, y}_D is ∓1.
BOOST_AUTO_TEST_CASE(second_class_constraints_of_a_first_order_lagrangian) {
  const auto system =
      lagrangian_system(phase_space(2),
                        [](const ExprVector& q, const ExprVector& v, const Expr&) {
                          return (q[0] * v[1] - q[1] * v[0]) / 2.0 - q.squaredNorm() / 2.0;
                        },
                        {"x", "y", "p_x", "p_y"});
  const auto found = brackets(*system, {.x = VectorXd{{1.0, 0.5, -0.25, 0.5}}});
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(found->constraints.size() == 2u);
  // {p_x + y/2, p_y - x/2} = {p_x, -x/2} + {y/2, p_y} = 1/2 + 1/2, up to the signs of both.
  BOOST_TEST((found->matrix[0][1] == "1" || found->matrix[0][1] == "-1"), found->matrix[0][1]);
  for (const std::string& constraint : found->constraints)
    BOOST_TEST(constraint.find("2*p") == std::string::npos, constraint);
  BOOST_TEST(!found->is_first_class[0]);
  BOOST_TEST(found->generators.empty());
  const auto all = dirac(*found);
  BOOST_REQUIRE(all.contains("x,y"));
  // L says x' = -y with H = (x² + y²)/2, and x' = {x, H}_D = {x, y}_D y.
  BOOST_TEST(all.at("x,y") == "-1");
}

// A particle on a sphere: {x_i, p_j}_D = δ_ij - x_i x_j, {p_i, p_j}_D = x_j p_i - x_i p_j, {x_i, x_j}_D = 0.
BOOST_AUTO_TEST_CASE(dirac_brackets_on_a_sphere) {
  Mechanics mechanics;
  mechanics.holonomic = {
      {"sphere"}, [](const ExprVector& x, const ExprVector&, const Expr&) {
        return ExprVector(ExprVector::Constant(1, x.head(3).squaredNorm() - 1.0));
      }};
  const auto system = lagrangian_system(
      phase_space(3),
      [](const ExprVector&, const ExprVector& v, const Expr&) { return v.squaredNorm() / 2.0; },
      {"x", "y", "z", "p_x", "p_y", "p_z"}, mechanics);
  const auto found = brackets(*system, {.x = VectorXd{{0.6, 0.0, 0.8, 0.0, 1.0, 0.0}}});
  BOOST_REQUIRE(found.has_value());
  const auto all = dirac(*found);
  BOOST_TEST(!all.contains("x,y"));
  BOOST_REQUIRE(all.contains("x,p_x"));
  BOOST_TEST((all.at("x,p_y") == "-x*y" || all.at("x,p_y") == "-(x*y)"), all.at("x,p_y"));
  BOOST_TEST((all.at("p_x,p_y") == "p_x*y - p_y*x" || all.at("p_x,p_y") == "y*p_x - x*p_y"),
             all.at("p_x,p_y"));
}

// L = (v_x - y)²/2: p_y = 0 is primary, p_x = 0 secondary; both are first class, p_y moves y alone.
BOOST_AUTO_TEST_CASE(first_class_constraints_generate) {
  const auto system = lagrangian_system(phase_space(2),
                                        [](const ExprVector& q, const ExprVector& v, const Expr&) {
                                          return square(v[0] - q[1]) / 2.0;
                                        },
                                        {"x", "y", "p_x", "p_y"});
  const auto found = brackets(*system, {.x = VectorXd{{1.0, 0.5, 0.0, 0.0}}});
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(found->is_first_class == std::vector<bool>({true, true}),
             boost::test_tools::per_element());
  BOOST_REQUIRE(found->generators.size() == 2u);
  std::map<std::string, std::string> moved;
  for (const auto& [constraint, moves] : found->generators) {
    BOOST_REQUIRE(moves.size() == 1u);
    moved[constraint] = moves[0].first + " by " + moves[0].second;
  }
  BOOST_TEST(moved["p_x"] == "x by 1");
  BOOST_TEST(moved["p_y"] == "y by 1");
  // H = p_x²/2 + y p_x + u p_y, with u the velocity of y that nothing determines.
  BOOST_TEST(found->hamiltonian.find("y'") != std::string::npos, found->hamiltonian);
  BOOST_TEST(found->hamiltonian.find("p_y") != std::string::npos, found->hamiltonian);
}

BOOST_AUTO_TEST_CASE(nothing_is_said_of_systems_without_constraints) {
  const auto system = lagrangian_system(phase_space(1),
                                        [](const ExprVector& q, const ExprVector& v, const Expr&) {
                                          return square(v[0]) / 2.0 - q[0];
                                        },
                                        {"x", "p_x"});
  BOOST_TEST(!brackets(*system, {.x = VectorXd{{1.0, 0.5}}}).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
