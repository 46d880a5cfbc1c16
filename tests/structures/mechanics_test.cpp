#include "courant/structures/mechanics.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/lagrangian_system.hpp"
#include "courant/structures/laws.hpp"

// Mistakes that these cases have to notice:
//  * reactions pull the other way (structures/dirac_system.cpp)
//  * the parts of the gradient of a constraint are exchanged (structures/dirac_system.cpp)
//  * forces are velocities
//  * affine constraints are called a distribution
//  * the vakonomic Lagrangian is L - κ g
//  * the canonical form without torsion (structures/canonical_symplectic.cpp)
//  * the canonical bivector with the torsion of the other side
//    (structures/canonical_symplectic.cpp)
BOOST_AUTO_TEST_SUITE(mechanics)

using namespace courant;

namespace {

std::shared_ptr<const CotangentBundle> bundle_on(std::shared_ptr<const Manifold> Q) {
  return std::make_shared<CotangentBundle>(std::move(Q));
}

VectorXd random(Index size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(generator); });
}

// Metric diag(1, 1 + x², 2) on R³, V = x y + z²/2, μ = dz - y dx + t dy/3, b = 0.1 x, φ = x y - t,
// F = (p_y, x' z, t).
MatrixField metric() {
  return [](const ExprVector& q) {
    ExprMatrix g = ExprMatrix::Zero(3, 3);
    g(0, 0) = 1.0;
    g(1, 1) = 1.0 + q[0] * q[0];
    g(2, 2) = 2.0;
    return g;
  };
}
Expr potential(const ExprVector& q, const Expr&) { return q[0] * q[1] + 0.5 * q[2] * q[2]; }
Mechanics everything() {
  Mechanics result;
  result.holonomic = {{"phi"}, [](const ExprVector& x, const ExprVector&, const Expr& t) {
                        return ExprVector::Constant(1, x[0] * x[1] - t).eval();
                      }};
  result.nonholonomic = {
      {"g"}, [](const ExprVector& x, const ExprVector& w, const Expr& t) {
        return ExprVector::Constant(1, w[2] - x[1] * w[0] + t / 3.0 * w[1] + 0.1 * x[0]).eval();
      }};
  result.force = [](const ExprVector& x, const ExprVector& w, const Expr& t) {
    return ExprVector{{x[4], w[0] * x[2], t}};
  };
  return result;
}

// What the equations of motion say by hand, for w, λ, κ: (w, ṗ, p, φ, g).
struct Motion {
  VectorXd velocity = VectorXd(3), rate = VectorXd(3), momentum = VectorXd(3);
  double phi = 0.0, g = 0.0;
};
Motion by_hand(const VectorXd& x, const VectorXd& w, double lambda, double kappa, double t) {
  Motion m;
  const double X = x[0], Y = x[1], Z = x[2];
  m.velocity = w;
  m.momentum << w[0], (1.0 + X * X) * w[1], 2.0 * w[2];
  m.rate << X * w[1] * w[1] - Y, -X, -Z;           // ∂L/∂q
  m.rate -= lambda * VectorXd{{Y, X, 0.0}};        // E = … + λ φ
  m.rate += kappa * VectorXd{{-Y, t / 3.0, 1.0}};  // κ μ
  m.rate += VectorXd{{x[4], w[0] * Z, t}};         // F
  m.phi = X * Y - t;
  m.g = w[2] - Y * w[0] + t / 3.0 * w[1] + 0.1 * X;
  return m;
}

}  // namespace

// q̇ = w, ṗ = ∂L/∂q - λ ∂φ + κ μ + F, p = ∂L/∂w, φ = 0, g = 0, with every sign, t included.
BOOST_AUTO_TEST_CASE(lagrangian_with_everything) {
  const auto T = bundle_on(std::make_shared<Euclidean>(3));
  const auto system = lagrangian_system(T, mechanical_lagrangian(metric(), potential),
                                        {"x", "y", "z", "p_x", "p_y", "p_z"}, everything());
  std::mt19937 generator(1);
  for (int trial = 0; trial < 3; ++trial) {
    VectorXd x = random(6, generator);
    const VectorXd w = random(3, generator), multipliers = random(2, generator);
    const double t = 0.7;
    const Motion m = by_hand(x, w, multipliers[0], multipliers[1], t);
    x.tail(3) = m.momentum;
    const Motion at_p = by_hand(x, w, multipliers[0], multipliers[1], t);
    VectorXd v(6), z(5);
    v << at_p.velocity, at_p.rate;
    z << w, multipliers;
    const VectorXd residual = system->residual(x, v, z, t);
    BOOST_TEST(residual.head(9).norm() < 1e-14);
    BOOST_TEST(std::abs(residual[9] - at_p.phi) < 1e-14);
    BOOST_TEST(std::abs(residual[10] - at_p.g) < 1e-14);
    VectorXd other = z;
    other[4] += 0.1;  // another reaction
    BOOST_TEST(system->residual(x, v, other, t).head(9).norm() > 0.05);
    other = z;
    other[3] += 0.1;
    BOOST_TEST(system->residual(x, v, other, t).head(9).norm() > 0.01);
  }
  BOOST_TEST(system->names().auxiliary ==
                 (std::vector<std::string>{"x'", "y'", "z'", "lambda[0]", "lambda[1]"}),
             boost::test_tools::per_element());
  BOOST_TEST(system->names().equations[9] == "phi");
  BOOST_TEST(system->names().equations[10] == "g");
}

// The Hamiltonian of the same system has the same motions.
BOOST_AUTO_TEST_CASE(hamiltonian_with_everything) {
  const auto T = bundle_on(std::make_shared<Euclidean>(3));
  const auto family =
      std::make_shared<Hamiltonian>(T, [](const ExprVector& x, const Expr& t) -> Expr {
        return 0.5 * (square(x[3]) + square(x[4]) / (1.0 + square(x[0])) + 0.5 * square(x[5])) +
               potential(x, t);
      });
  const auto system =
      hamiltonian_system(std::make_shared<CanonicalSymplectic>(T), family, {}, everything());
  std::mt19937 generator(2);
  VectorXd x = random(6, generator);
  const VectorXd w = random(3, generator);
  x.tail(3) = by_hand(x, w, 0.0, 0.0, 0.0).momentum;
  const Motion m = by_hand(x, w, 0.3, -0.8, 0.7);
  VectorXd v(6);
  v << m.velocity, m.rate;
  const VectorXd residual = system->residual(x, v, VectorXd{{0.3, -0.8}}, 0.7);
  BOOST_TEST(residual.head(6).norm() < 1e-14);
  BOOST_TEST(std::abs(residual[6] - m.phi) < 1e-14);
  BOOST_TEST(std::abs(residual[7] - m.g) < 1e-14);
}

// Vakonomic: p = ∂L/∂w + κ μ and ṗ = ∂(L + κ g)/∂q, no reaction.
BOOST_AUTO_TEST_CASE(vakonomic) {
  const auto T = bundle_on(std::make_shared<Euclidean>(3));
  Mechanics data = everything();
  data.holonomic = {};
  data.force = {};
  data.vakonomic = true;
  const auto system = lagrangian_system(T, mechanical_lagrangian(metric(), potential),
                                        {"x", "y", "z", "a", "b", "c"}, data);
  std::mt19937 generator(3);
  VectorXd x = random(6, generator);
  const VectorXd w = random(3, generator);
  const double kappa = 0.6, t = 0.7;
  x.tail(3) << w[0] - kappa * x[1], (1.0 + x[0] * x[0]) * w[1] + kappa * t / 3.0,
      2.0 * w[2] + kappa;
  VectorXd v(6), z(4);
  v << w, x[0] * w[1] * w[1] - x[1] + 0.1 * kappa, -x[0] - kappa * w[0], -x[2];
  z << w, kappa;
  BOOST_TEST(system->residual(x, v, z, t).head(9).norm() < 1e-14);
  BOOST_TEST(system->residual(x, v, z, t).size() == 10);
  BOOST_CHECK_THROW(
      constrained_family(
          std::make_shared<Hamiltonian>(T, [](const ExprVector& at, const Expr&) { return at[0]; }),
          data),
      std::invalid_argument);
}

// The structure of linear constraints is the restriction of the canonical form, a Dirac structure on
// curved spaces too: (v, dH) is in it exactly where the system's equations hold.
BOOST_AUTO_TEST_CASE(structure_of_a_rolling_ball) {
  const auto Q = std::make_shared<Product>(std::vector<std::shared_ptr<const Manifold>>{
      std::make_shared<SpecialOrthogonal3>(), std::make_shared<Euclidean>(2)});
  const auto T = bundle_on(Q);
  Mechanics rolling;
  const double r = 0.3;
  rolling.nonholonomic = {{"x", "y"}, [r](const ExprVector& x, const ExprVector& w, const Expr&) {
                            const Expr across = x[3] * w[0] + x[4] * w[1] + x[5] * w[2];  // (R Ω)_y
                            const Expr along = x[0] * w[0] + x[1] * w[1] + x[2] * w[2];
                            return ExprVector{{w[3] - r * across, w[4] + r * along}};
                          }};
  const auto D = nonholonomic_structure(T, rolling);
  BOOST_REQUIRE(D != nullptr);
  for (const LawResult& law : check_structure(*D)) BOOST_TEST(law.passed(), law.law);

  const auto family =
      std::make_shared<Hamiltonian>(T, [](const ExprVector& x, const Expr&) -> Expr {
        return 0.5 * x.tail(5).squaredNorm() + x[2] * x[9] + x[10];
      });
  const auto with_reactions =
      hamiltonian_system(std::make_shared<CanonicalSymplectic>(T), family, {}, rolling);
  const DiracSystem restricted(D, family);
  std::mt19937 generator(4);
  const VectorXd x = T->random_point(generator);
  const VectorXd lambda = random(2, generator);
  // v and p' that go with any reaction: the first equations of both systems hold at once.
  VectorXd motion = VectorXd::Zero(10);
  motion.head(5) = values(family->differential(constants(x), ExprVector(0), Expr(0.0))).tail(5);
  motion.tail(5) = -with_reactions->residual(x, motion, lambda, 0.0).segment(5, 5);
  const VectorXd residual = with_reactions->residual(x, motion, lambda, 0.0);
  const VectorXd in_D = restricted.residual(x, motion, lambda, 0.0);
  BOOST_TEST(residual.head(10).norm() < 1e-13);
  BOOST_TEST(in_D.head(10).norm() < 1e-13);
  BOOST_TEST((in_D.tail(2) - residual.tail(2)).norm() < 1e-13);
  BOOST_TEST(restricted.residual(x, motion, -lambda, 0.0).head(10).norm() > 0.1);
}

// Constraints that are affine or depend on time have no linear structure.
BOOST_AUTO_TEST_CASE(no_structure_of_affine_constraints) {
  const auto T = bundle_on(std::make_shared<Euclidean>(3));
  BOOST_TEST(nonholonomic_structure(T, everything()) == nullptr);
  Mechanics data;
  BOOST_TEST(nonholonomic_structure(T, data) == nullptr);
  data.nonholonomic = {{"g"}, [](const ExprVector&, const ExprVector& w, const Expr&) {
                         return ExprVector::Constant(1, w[0] + 1.0).eval();
                       }};
  BOOST_TEST(nonholonomic_structure(T, data) == nullptr);
  data.nonholonomic.formula = [](const ExprVector& x, const ExprVector& w, const Expr&) {
    return ExprVector::Constant(1, w[0] + x[1] * w[1]).eval();
  };
  BOOST_TEST(nonholonomic_structure(T, data) != nullptr);
  data.vakonomic = true;
  BOOST_TEST(nonholonomic_structure(T, data) == nullptr);
}

// α = ωᵀ v and v = Λ α are the canonical structure, with the torsion of groups.
BOOST_AUTO_TEST_CASE(canonical_form_and_bivector) {
  std::mt19937 generator(5);
  for (const std::shared_ptr<const Manifold>& Q :
       {std::shared_ptr<const Manifold>(std::make_shared<Euclidean>(2)),
        std::shared_ptr<const Manifold>(std::make_shared<SpecialOrthogonal3>())}) {
    const auto T = bundle_on(Q);
    const CanonicalSymplectic D(T);
    const Index n = T->tangent_dimension();
    const VectorXd x = T->random_point(generator), v = random(n, generator);
    const MatrixXd omega = values(D.form(constants(x))), lambda = values(D.bivector(constants(x)));
    const auto defect = [&](const VectorXd& w, const VectorXd& alpha) {
      return values(D.membership(constants(x), constants(w), constants(alpha), ExprVector(0)))
          .norm();
    };
    BOOST_TEST((omega + omega.transpose()).norm() < 1e-14);
    BOOST_TEST(defect(v, omega.transpose() * v) < 1e-14);
    BOOST_TEST(defect(lambda * v, v) < 1e-14);
    BOOST_TEST(defect(v, omega * v) > 0.1);
    // ω on vectors of T*Q itself.
    if (n == 6) BOOST_TEST(omega.topLeftCorner(3, 3).norm() > 0.1);
  }
}

// A wrong number of constraints is an error.
BOOST_AUTO_TEST_CASE(wrong_exteriors) {
  const auto T = bundle_on(std::make_shared<Euclidean>(1));
  const auto D = std::make_shared<CanonicalSymplectic>(T);
  const auto family = std::make_shared<Hamiltonian>(
      T, [](const ExprVector& x, const Expr&) -> Expr { return x[1] * x[1]; });
  const DiracSystem::Law two = [](const ExprVector&, const ExprVector& v, const ExprVector&,
                                  const Expr&) { return ExprVector(v); };
  const VectorXd x = VectorXd::Ones(2);
  BOOST_CHECK_THROW(DiracSystem(D, family, {.constraint = two}), std::invalid_argument);
  BOOST_CHECK_THROW(DiracSystem(D, family, {.constraint_count = 1}), std::invalid_argument);
  BOOST_CHECK_THROW(DiracSystem(D, family, {.constraint = two, .constraint_count = 1})
                        .residual(x, x, VectorXd::Ones(1), 0.0),
                    std::invalid_argument);
  BOOST_CHECK_THROW(DiracSystem(D, family, {.source = two}).residual(x, x, VectorXd(0), 0.0),
                    std::invalid_argument);
  BOOST_TEST(DiracSystem(D, family, {.constraint = two, .constraint_count = 2})
                 .residual(x, x, VectorXd::Ones(2), 0.0)
                 .size() == 4);
}

BOOST_AUTO_TEST_SUITE_END()
