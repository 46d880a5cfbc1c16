#include "courant/integrators/certificate/branches.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "../example_systems.hpp"
#include "courant/integrators/certificate/certificate.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/lagrangian_system.hpp"
#include "courant/structures/morse_family.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * products that are seen after a derivative alone are not looked for
//  * a set of factors that has another one in it is a branch too
//  * the equation that was a product stays, and the multiplier vanishes where branches meet
//  * a sum of squares, or a circle, is a product
//  * after a branch was chosen its own product is found again
//  * all choices of factors are made before there are seen to be too many
BOOST_AUTO_TEST_SUITE(branches_test)

namespace {

using namespace courant::examples;

using V = const ExprVector&;
using T = const Expr&;
using Equations = std::vector<std::vector<std::string>>;

Equations equations_of(const SystemPointer& system) {
  Equations all;
  for (const Branch& branch : branches(system)) all.push_back(branch.equations);
  return all;
}

SystemPointer flat(Index n, Index m, Index count, FormulaSystem::Formula formula,
                   ImplicitSystem::Names names) {
  return std::make_shared<FormulaSystem>(std::make_shared<Euclidean>(n), m, count,
                                         std::move(formula), std::move(names));
}

InitialGuess at(std::initializer_list<double> x) {
  InitialGuess guess;
  guess.x = VectorXd::Map(x.begin(), std::ssize(x));
  return guess;
}

ImplicitSystem::Names names(std::vector<std::string> coordinates,
                            std::vector<std::string> auxiliary = {}) {
  return {.coordinates = std::move(coordinates), .auxiliary = std::move(auxiliary)};
}

// x y = 0, x' + y' = 1.
SystemPointer cross() {
  return flat(
      2, 0, 2,
      [](V x, V v, V, T) {
        ExprVector F(2);
        F << x[0] * x[1], v[0] + v[1] - 1.0;
        return F;
      },
      names({"x", "y"}));
}

// q' = v, v² + q² = 1.
SystemPointer oscillator() {
  return flat(
      2, 0, 2,
      [](V x, V v, V, T) {
        ExprVector F(2);
        F << v[0] - x[1], square(x[1]) + square(x[0]) - 1.0;
        return F;
      },
      names({"q", "v"}));
}

// Pontryagin's equations for the distribution that these vectors span, without a cost.
SystemPointer abnormal(Index n, std::vector<std::string> coordinates,
                       std::function<ExprVector(V, V, T)> dynamics) {
  const auto bundle = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(n));
  const ControlProblem problem{.cost = [](const ExprVector&, const ExprVector& u,
                                          const Expr&) { return 0.5 * u.squaredNorm(); },
                               .dynamics = std::move(dynamics),
                               .controls = 2,
                               .cost_multiplier = 0.0};
  return hamiltonian_system(std::make_shared<CanonicalSymplectic>(bundle),
                            pontryagin_family(bundle, problem), std::move(coordinates), {},
                            {"u", "w"});
}

SystemPointer martinet() {
  return abnormal(3, {"x", "y", "z", "p_x", "p_y", "p_z"}, [](V q, V u, T) {
    ExprVector f(3);
    f << u[0], u[1], 0.5 * square(q[1]) * u[0];
    return f;
  });
}

SystemPointer engel() {
  return abnormal(4, {"x", "y", "z", "w1", "p_x", "p_y", "p_z", "p_w"}, [](V q, V u, T) {
    ExprVector f(4);
    f << u[0], u[1], q[1] * u[0], 0.5 * square(q[1]) * u[0];
    return f;
  });
}

Certificate on_branch(const SystemPointer& system, std::size_t number, const InitialGuess& guess) {
  return certificate(branches(system).at(number - 1).system, guess);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_product_among_the_equations_has_branches) {
  BOOST_TEST((equations_of(cross()) == Equations{{"x"}, {"y"}}));
  // The crossing, which is singular, is a point of each like others.
  BOOST_TEST(to_string(certificate(cross(), at({0.0, 0.0})).verdict) != "regular");
  for (const std::size_t number : {1u, 2u}) {
    const Certificate found = on_branch(cross(), number, at({0.0, 0.0}));
    BOOST_TEST(to_string(found.verdict) == "regular", found.reason);
    BOOST_TEST(found.degrees_of_freedom == 1);
    BOOST_TEST(!found.is_ambiguous());
    BOOST_TEST(std::fabs(found.point.v[number == 1 ? 1 : 0] - 1.0) < 1e-14);
  }
  // The start is the nearest point of the branch, though the other one is nearer.
  const Certificate far = on_branch(cross(), 1, at({2.0, 0.1}));
  BOOST_TEST(std::fabs(far.point.x[0]) < 1e-14);
  BOOST_TEST(std::fabs(far.moved - 2.0) < 1e-12);
}

// Differentiated, v² + q² = 1 is v (v' + q) = 0.
BOOST_AUTO_TEST_CASE(a_product_of_derivatives_has_branches) {
  const std::vector<Branch> found = branches(oscillator());
  BOOST_TEST_REQUIRE(found.size() == 2u);
  BOOST_TEST(found[0].level == 1);
  BOOST_TEST(found[0].equations.front() == "v");
  const Certificate motion = certificate(found[1].system, at({1.0, 0.0}));
  BOOST_TEST(to_string(motion.verdict) == "regular", motion.reason);
  BOOST_TEST(motion.degrees_of_freedom == 1);
  BOOST_TEST(std::fabs(motion.point.v[1] + 1.0) < 1e-14);  // v' = -q
  const Certificate rest = certificate(found[0].system, at({1.0, 0.0}));
  BOOST_TEST(to_string(rest.verdict) == "regular", rest.reason);
  BOOST_TEST(rest.degrees_of_freedom == 0);
}

// On the surface y = 0 of Martinet the velocity is free along the line alone; p = 0, and rest, are the other branches.
BOOST_AUTO_TEST_CASE(abnormal_curves_of_martinet_are_a_branch) {
  BOOST_TEST((equations_of(martinet()) == Equations{{"y"}, {"p_z"}, {"u", "w"}}));
  const InitialGuess start = at({0.0, 0.0, 0.5, 0.0, 0.0, 1.0});
  BOOST_TEST(to_string(certificate(martinet(), start).verdict) == "rank-change");
  const Certificate line = on_branch(martinet(), 1, start);
  BOOST_TEST(to_string(line.verdict) == "gauge", line.reason);
  BOOST_TEST(line.gauge_dimension == 1);
  BOOST_TEST(line.degrees_of_freedom == 3);
  BOOST_TEST_REQUIRE(line.gauge_directions.cols() == 1);
  const VectorXd along = line.gauge_directions.col(0) / line.gauge_directions(0, 0);
  VectorXd x_alone = VectorXd::Zero(6);
  x_alone[0] = 1.0;
  BOOST_TEST((along - x_alone).norm() < 1e-12);
}

// h₃ = p_z + y p_w, and on it p_w y' = 0: the branch h₃ = y' = 0 has the characteristic lines of Engel.
BOOST_AUTO_TEST_CASE(branches_branch_again) {
  const Equations found = equations_of(engel());
  BOOST_TEST_REQUIRE(found.size() == 3u);
  BOOST_TEST(found[2].size() == 2u);
  const double y = 0.6;
  const Certificate line = on_branch(engel(), 3, at({0.0, y, 0.0, 0.0, 0.36, 0.0, -1.2, 2.0}));
  BOOST_TEST(to_string(line.verdict) == "gauge", line.reason);
  BOOST_TEST(line.gauge_dimension == 1);
  BOOST_TEST_REQUIRE(line.gauge_directions.cols() == 1);
  VectorXd expected = VectorXd::Zero(8);
  expected << 1.0, 0.0, y, 0.5 * y * y, 0.0, 0.0, 0.0, 0.0;
  const VectorXd along = line.gauge_directions.col(0) / line.gauge_directions(0, 0);
  BOOST_TEST((along - expected).norm() < 1e-12);
}

// On y² = 0 is y = 0, so that y p = 0, from its derivative, is no product of its own. On the branch x = 0 of x p = 0 that
// equation, and x' p + x p' = 0, hold.
BOOST_AUTO_TEST_CASE(what_holds_already_is_no_product) {
  const SystemPointer squares = flat(
      2, 0, 2,
      [](V x, V v, V, T) {
        ExprVector F(2);
        F << square(x[0]), v[0] - x[1];
        return F;
      },
      names({"y", "p"}));
  BOOST_TEST(branches(squares).empty());
  const SystemPointer products = flat(
      2, 1, 2,
      [](V x, V v, V z, T) {
        ExprVector F(2);
        F << x[0] * x[1], v[0] - x[1] * z[0];
        return F;
      },
      names({"x", "p"}, {"u"}));
  BOOST_TEST((equations_of(products) == Equations{{"x"}, {"p"}}));
}

// A bead on the line x = y or the unit circle, H = p²/2 + y, at (1, 1)/√2 where both meet: on the line λ d(x - y) is
// the force, p' = -(1, 1)/2; on the circle p' is -x (|p|² - y).
BOOST_AUTO_TEST_CASE(multipliers_are_those_of_the_factor) {
  const auto bundle = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto energy = std::make_shared<Hamiltonian>(
      bundle, [](V x, T) { return 0.5 * (square(x[2]) + square(x[3])) + x[1]; });
  const auto family = std::make_shared<ConstrainedFamily>(
      energy,
      [](V x, V, T) {
        return ExprVector::Constant(1, (x[0] - x[1]) * (square(x[0]) + square(x[1]) - 1.0));
      },
      1);
  const SystemPointer bead = hamiltonian_system(std::make_shared<CanonicalSymplectic>(bundle),
                                                family, {"x", "y", "p_x", "p_y"}, {}, {"lambda"});
  const double s = 1.0 / std::numbers::sqrt2;
  const Certificate line = on_branch(bead, 1, at({s, s, 0.3, 0.3}));
  BOOST_TEST(to_string(line.verdict) == "regular", line.reason);
  BOOST_TEST(line.degrees_of_freedom == 2);
  BOOST_TEST(std::fabs(line.point.v[2] + 0.5) < 1e-12);
  BOOST_TEST(std::fabs(line.point.v[3] + 0.5) < 1e-12);
  const Certificate circle = on_branch(bead, 2, at({s, s, 0.3, -0.3}));
  BOOST_TEST(to_string(circle.verdict) == "regular", circle.reason);
  BOOST_TEST(circle.degrees_of_freedom == 2);
  const double lambda = 2.0 * 0.09 - s;
  BOOST_TEST(std::fabs(circle.point.v[2] + s * lambda) < 1e-12);
  BOOST_TEST(std::fabs(circle.point.v[3] + s * lambda + 1.0) < 1e-12);
}

// A pendulum by five equations, and squares.
BOOST_AUTO_TEST_CASE(others_have_none) {
  const SystemPointer pendulum = flat(
      4, 1, 5,
      [](V x, V v, V z, T) {
        ExprVector F(5);
        F << v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 1.0,
            square(x[0]) + square(x[1]) - 1.0;
        return F;
      },
      names({"x", "y", "v", "w"}, {"T"}));
  BOOST_TEST(branches(pendulum).empty());
  const SystemPointer squares = flat(
      2, 0, 2,
      [](V x, V v, V, T) {
        ExprVector F(2);
        F << square(x[0]) + square(x[1]), v[0] + v[1] - 1.0;
        return F;
      },
      names({"x", "y"}));
  BOOST_TEST(branches(squares).empty());
  // x' = 1, x = 2: 1 = 0.
  const SystemPointer contradiction = flat(
      1, 0, 2,
      [](V x, V v, V, T) {
        ExprVector F(2);
        F << v[0] - 1.0, x[0] - 2.0;
        return F;
      },
      names({"x"}));
  BOOST_TEST(branches(contradiction).empty());
}

// 6⁸ choices of factors, which nobody looks through.
BOOST_AUTO_TEST_CASE(too_many_are_none) {
  std::vector<std::string> coordinates;
  for (int i = 0; i < 8; ++i) coordinates.push_back("x" + std::to_string(i));
  const SystemPointer products = flat(
      8, 0, 8,
      [](V x, V, V, T) {
        ExprVector F = ExprVector::Constant(8, Expr(1.0));
        for (Index i = 0; i < 8; ++i)
          for (int k = 0; k < 6; ++k) F[i] = F[i] * (x[i] - static_cast<double>(k));
        return F;
      },
      names(coordinates));
  BOOST_TEST(branches(products).empty());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
