#include "courant/structures/morse_family.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"

BOOST_AUTO_TEST_SUITE(morse_family)

using namespace courant;

namespace {

// E = λ x + λ³/3 - c λ on R, whose Hessian (1, 2λ) has rank 1; c x² λ²/2 with (2 c x λ, c x²).
MorseFamily fold() {
  return MorseFamily(std::make_shared<Euclidean>(1), 1,
                     [](const ExprVector& x, const ExprVector& l, const Expr& t) -> Expr {
                       return l[0] * x[0] + l[0] * l[0] * l[0] / 3.0 - t * l[0];
                     });
}
MorseFamily degenerate() {
  return MorseFamily(std::make_shared<Euclidean>(1), 1,
                     [](const ExprVector& x, const ExprVector& l, const Expr&) -> Expr {
                       return 0.5 * x[0] * x[0] * l[0] * l[0];
                     });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_fold) {
  const MorseFamily family = fold();
  const ExprVector x{{2.0}}, l{{3.0}};
  BOOST_TEST(values(family.differential(x, l, 0.5))[0] == 3.0);
  BOOST_TEST(values(family.stationarity(x, l, 0.5))[0] == 2.0 + 9.0 - 0.5);
  BOOST_TEST(family.energy(x, l, 0.5).value() == 6.0 + 9.0 - 1.5);
  BOOST_CHECK_THROW(MorseFamily(std::make_shared<Euclidean>(1), 1, {}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(rank_condition) {
  const VectorXd one = VectorXd::Ones(1), zero = VectorXd::Zero(1);
  BOOST_TEST(morse_rank(fold(), one, zero, 0.0).rank == 1);
  BOOST_TEST(morse_rank(degenerate(), one, one, 0.0).rank == 1);
  BOOST_TEST(morse_rank(degenerate(), zero, one, 0.0).rank == 0);
  // Conditions that repeat each other: φ and 2φ. Where vectors are not all of R^Ñ, a function of the
  // radius of the sphere has no differential.
  const auto H = std::make_shared<Hamiltonian>(
      std::make_shared<Euclidean>(2),
      [](const ExprVector& x, const Expr&) -> Expr { return x[0] * x[1]; });
  const ConstrainedFamily twice(
      H,
      [](const ExprVector& x, const ExprVector&, const Expr&) {
        const Expr phi = x[0] - x[1] * x[1];
        return ExprVector{{phi, 2.0 * phi}};
      },
      2);
  BOOST_TEST(morse_rank(twice, VectorXd::Ones(2), VectorXd::Zero(2), 0.0).rank == 1);
  const auto sphere = std::make_shared<Sphere>(2);
  const ConstrainedFamily radius(
      std::make_shared<Hamiltonian>(sphere, [](const ExprVector& x, const Expr&) { return x[0]; }),
      [](const ExprVector& x, const ExprVector&, const Expr&) {
        return ExprVector{{x.squaredNorm(), x[2]}};
      },
      2);
  BOOST_TEST(morse_rank(radius, VectorXd{{0.6, 0.0, 0.8}}, VectorXd::Zero(2), 0.0).rank == 1);
}

// E = ⟨p, f⟩ - c ℓ: ẋ = f, ṗ = -∂E/∂x, 0 = ∂E/∂u.
BOOST_AUTO_TEST_CASE(pontryagin) {
  const auto T = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  ControlProblem problem{
      .cost = [](const ExprVector& q, const ExprVector& u, const Expr& t) -> Expr {
        return 0.5 * u[0] * u[0] + t * q[0] * q[0];
      },
      .dynamics =
          [](const ExprVector& q, const ExprVector& u, const Expr&) {
            return ExprVector{{q[1], u[0] - sin(q[0])}};
          },
      .controls = 1};
  const VectorXd x{{0.3, -0.2, 0.7, 1.1}}, u{{1.4}};
  const double t = 0.9;
  for (const double c : {1.0, 0.0}) {
    problem.cost_multiplier = c;
    const DiracSystem system(std::make_shared<CanonicalSymplectic>(T),
                             pontryagin_family(T, problem));
    const VectorXd v{
        {x[1], u[0] - std::sin(x[0]), x[3] * std::cos(x[0]) + c * 2.0 * t * x[0], -x[2]}};
    const VectorXd residual = system.residual(x, v, u, t);
    BOOST_TEST(residual.head(4).norm() < 1e-15);
    BOOST_TEST(std::abs(residual[4] - (x[3] - c * u[0])) < 1e-15);
  }
  problem.dynamics = [](const ExprVector& q, const ExprVector&, const Expr&) {
    return ExprVector(q.head(1));
  };
  BOOST_CHECK_THROW(pontryagin_family(T, problem)->value(constants(x), constants(u), 0.0),
                    std::invalid_argument);
  problem.dynamics = {};
  BOOST_CHECK_THROW(pontryagin_family(T, problem), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
