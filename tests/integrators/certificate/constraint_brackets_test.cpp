#include "courant/integrators/certificate/constraint_brackets.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "courant/core/language/formula.hpp"
#include "courant/core/language/symbol_table.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/lagrangian_system.hpp"
#include "courant/structures/morse_family.hpp"

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
  BOOST_TEST((found->matrix[0][1].text == "1" || found->matrix[0][1].text == "-1"),
             found->matrix[0][1].text);
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
  const std::string& H = found->hamiltonian;
  BOOST_TEST(H.ends_with(" + y'*p_y"), H);
  const std::string before = H.substr(0, H.size() - 9);
  BOOST_TEST((before == "y*p_x + p_x^2/2" || before == "p_x^2/2 + y*p_x"), H);
}

// L = |x' + a × x|²/2 - |x|²/2 on R⁶: of x × p = 0 two components are independent, and their bracket is the third. It is 0 on M_f,
// though it is no sum of multiples of the two, so all five are first class and turn x and p.
BOOST_AUTO_TEST_CASE(brackets_that_vanish_by_constraints_are_zero) {
  const auto system =
      lagrangian_system(phase_space(6),
                        [](const ExprVector& q, const ExprVector& v, const Expr&) {
                          const ExprVector x = q.head(3), a = q.tail(3);
                          ExprVector u(3);
                          u << v[0] + a[1] * x[2] - a[2] * x[1], v[1] + a[2] * x[0] - a[0] * x[2],
                              v[2] + a[0] * x[1] - a[1] * x[0];
                          return (u.squaredNorm() - x.squaredNorm()) / 2.0;
                        },
                        {"x", "y", "z", "a", "b", "c", "p_x", "p_y", "p_z", "p_a", "p_b", "p_c"});
  VectorXd point = VectorXd::Zero(12);
  point.head(6) << 1.0, 0.0, 0.0, 0.1, 0.2, 0.3;
  point[6] = 0.5;
  const auto found = brackets(*system, {.x = point});
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST_REQUIRE(found->matrix.size() == 5u);
  for (const auto& row : found->matrix)
    for (const ConstraintBrackets::Entry& entry : row) BOOST_TEST(entry.is_zero(), entry.text);
  BOOST_TEST(found->generators.size() == 5u);
  BOOST_TEST(found->second_class.empty());
  BOOST_TEST(found->dirac_brackets.empty());
}

// L = (x' - y)²/2 with x² + z² = 2: p_x does not commute with the circle, p_x - p_z x/z does.
BOOST_AUTO_TEST_CASE(combinations_of_constraints_are_first_class) {
  Mechanics mechanics;
  mechanics.holonomic = {
      {"circle"}, [](const ExprVector& q, const ExprVector&, const Expr&) {
        return ExprVector(ExprVector::Constant(1, square(q[0]) + square(q[2]) - 2.0));
      }};
  const auto system = lagrangian_system(
      phase_space(3),
      [](const ExprVector& q, const ExprVector& v, const Expr&) {
        return square(v[0] - q[1]) / 2.0;
      },
      {"x", "y", "z", "p_x", "p_y", "p_z"}, mechanics);
  const auto found = brackets(*system, {.x = VectorXd{{1.0, 0.5, 1.0, 0.0, 0.0, 0.0}}});
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(found->second_class.size() == 2u);
  BOOST_TEST_REQUIRE(found->generators.size() == 2u);
  BOOST_TEST(found->generators[0].constraint == "p_y");
  BOOST_TEST(found->generators[1].constraint == "p_x - x*p_z/z", found->generators[1].constraint);
  std::string moves;
  for (const auto& [name, rate] : found->generators[1].moves) moves += name + " by " + rate + "; ";
  BOOST_TEST(moves == "x by 1; z by -x/z; ", moves);
  // p_z and the circle: z follows x.
  const auto all = dirac(*found);
  BOOST_TEST(all.at("z,p_x") == "-x/z");
  BOOST_TEST(!all.contains("z,p_z"));
}

// A Lagrangian that is a length: E is not linear in the velocity, which says no more than the multiplier of the mass
// shell. With a potential E x T' the Hamiltonian is the same, of p_T - E x.
BOOST_AUTO_TEST_CASE(the_hamiltonian_of_a_length_is_a_multiple_of_its_constraint) {
  const auto system = lagrangian_system(phase_space(2),
                                        [](const ExprVector&, const ExprVector& v, const Expr&) {
                                          return -2.0 * sqrt(square(v[0]) - square(v[1]));
                                        },
                                        {"T", "x", "p_T", "p_x"});
  const double root = std::sqrt(3.0);
  const auto found = brackets(*system, {.x = VectorXd{{0.0, 0.0, -4.0 / root, 2.0 / root}},
                                        .v = VectorXd{{2.0, 1.0, 0.0, 0.0}},
                                        .z = VectorXd{{2.0, 1.0}}});
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(found->has_multipliers);
  BOOST_TEST(found->hamiltonian == "u_1*(" + found->constraints[0] + ")", found->hamiltonian);
}

// Two rods, four constraints: their Dirac brackets at a point are those of numbers, J - J Dφᵀ C⁻¹ Dφ J with
// C = Dφ J Dφᵀ.
BOOST_AUTO_TEST_CASE(dirac_brackets_of_a_double_pendulum) {
  Mechanics mechanics;
  mechanics.holonomic = {{"upper rod", "lower rod"},
                         [](const ExprVector& q, const ExprVector&, const Expr&) {
                           ExprVector rods(2);
                           rods << (q.head(2).squaredNorm() - 1.0) / 2.0,
                               ((q.segment(2, 2) - q.head(2)).squaredNorm() - 1.0) / 2.0;
                           return rods;
                         }};
  const std::vector<std::string> names = {"a", "b", "c", "d", "p_a", "p_b", "p_c", "p_d"};
  const auto system = lagrangian_system(
      phase_space(4),
      [](const ExprVector&, const ExprVector& v, const Expr&) { return v.squaredNorm() / 2.0; },
      names, mechanics);
  const VectorXd x{{0.6, -0.8, 1.4, -0.2, 0.4, 0.3, 1.0, -0.5}};  // on M_f
  const auto found = brackets(*system, {.x = x});
  BOOST_REQUIRE(found.has_value());
  BOOST_REQUIRE(found->constraints.size() == 4u);

  MatrixXd D = MatrixXd::Zero(4, 8);  // of φ and of their derivatives along p
  const Eigen::Vector2d q1 = x.segment(0, 2), r = x.segment(2, 2) - q1, p1 = x.segment(4, 2),
                        u = x.segment(6, 2) - p1;
  D.block(0, 0, 1, 2) = q1.transpose();
  D.block(1, 0, 1, 4) << -r.transpose(), r.transpose();
  D.block(2, 0, 1, 2) = p1.transpose();
  D.block(2, 4, 1, 2) = q1.transpose();
  D.block(3, 0, 1, 4) << -u.transpose(), u.transpose();
  D.block(3, 4, 1, 4) << -r.transpose(), r.transpose();
  MatrixXd J = MatrixXd::Zero(8, 8);
  J.topRightCorner(4, 4).setIdentity();
  J.bottomLeftCorner(4, 4) = -MatrixXd::Identity(4, 4);
  const MatrixXd C = D * J * D.transpose();
  const MatrixXd expected = J - J * D.transpose() * C.inverse() * D * J;

  SymbolTable symbols;
  for (Index i = 0; i < 8; ++i) symbols.add(names[static_cast<std::size_t>(i)], Expr(x[i]));
  auto all = dirac(*found);
  BOOST_REQUIRE(!all.empty());
  for (Index i = 0; i < 8; ++i)
    for (Index j = i + 1; j < 8; ++j) {
      const std::string pair =
          names[static_cast<std::size_t>(i)] + "," + names[static_cast<std::size_t>(j)];
      const double value = all.contains(pair) ? parse_formula(all[pair], symbols).value() : 0.0;
      BOOST_TEST(std::abs(value - expected(i, j)) < 1e-12,
                 pair << ": " << value << ", " << expected(i, j));
    }
}

// Brackets of many terms: that there are none is said, not left out in silence.
BOOST_AUTO_TEST_CASE(what_has_no_formula_says_why) {
  Mechanics mechanics;
  mechanics.holonomic = {{"surface"}, [](const ExprVector& q, const ExprVector&, const Expr&) {
                           Expr sum = -1.0;
                           for (Index i = 0; i < 4; ++i)
                             for (Index k = 0; k < 4; ++k)
                               sum += (1.0 + double(i + 3 * k)) * sin(q[i] + double(k) * q[k]);
                           return ExprVector(ExprVector::Constant(1, sum));
                         }};
  const auto system = lagrangian_system(
      phase_space(4),
      [](const ExprVector& q, const ExprVector& v, const Expr&) {
        Expr energy = 0.0;
        for (Index i = 0; i < 4; ++i) energy += (3.0 + sin(q[i] * q[(i + 1) % 4])) * square(v[i]);
        return energy;
      },
      {"a", "b", "c", "d", "p_a", "p_b", "p_c", "p_d"}, mechanics);
  const auto found = brackets(*system, {.x = VectorXd::Constant(8, 0.1)});
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(found->constraints.empty());
  BOOST_TEST(!found->missing.empty());
}

// {y + Σ sin kx, p_y + Σ sin kp_x} = 1 + Σ k cos kx Σ k cos kp_x, which is longer than five lines: 1 + 325² at 0.
BOOST_AUTO_TEST_CASE(a_bracket_that_is_too_long_is_a_number) {
  const auto M = phase_space(2);
  const auto waves = [](const Expr& a) {
    Expr sum = 0.0;
    for (int k = 1; k <= 25; ++k) sum += sin(static_cast<double>(k) * a);
    return sum;
  };
  const DiracSystem system(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<MorseFamily>(
          M, 2,
          [waves](const ExprVector& x, const ExprVector& lambda, const Expr&) {
            return Expr(lambda[0] * (x[1] + waves(x[0])) + lambda[1] * (x[3] + waves(x[2])));
          }),
      {.coordinates = {"x", "y", "p_x", "p_y"}});
  const auto found = brackets(system, {.x = VectorXd::Zero(4)});
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(found->missing == "");
  BOOST_TEST(found->matrix[0][1].is_at_point);
  BOOST_TEST(found->matrix[0][0].is_zero());
  BOOST_TEST_REQUIRE(found->matrix.size() == 2u);
  BOOST_TEST(std::abs(std::stod(found->matrix[0][1].text)) == 105626.0);
  BOOST_TEST(!found->is_first_class[0]);
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
