#include "courant/systems/point_vortices.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/lu_decomposition.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the sign of the energy of vortices
//  * strengths of the one-form count twice
BOOST_AUTO_TEST_SUITE(point_vortices)

namespace {

VectorXd random(Index size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(generator); });
}

// Equation (6) of the paper.
VectorXd velocities(const VectorXd& strengths, const VectorXd& q) {
  const Index n = strengths.size();
  VectorXd v = VectorXd::Zero(2 * n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      if (i == j) continue;
      const double dx = q[i] - q[j], dy = q[n + i] - q[n + j];
      v[i] -= strengths[j] * dy / (dx * dx + dy * dy) / (2.0 * std::numbers::pi);
      v[n + i] += strengths[j] * dx / (dx * dx + dy * dy) / (2.0 * std::numbers::pi);
    }
  return v;
}

// dα = Σ_i Γ_i dx_i ∧ dy_i as a matrix.
MatrixXd d_alpha(const VectorXd& strengths) {
  const Index n = strengths.size();
  MatrixXd form = MatrixXd::Zero(2 * n, 2 * n);
  form.topRightCorner(n, n) = strengths.asDiagonal();
  form.bottomLeftCorner(n, n) = -form.topRightCorner(n, n);
  return form;
}

}  // namespace

// The value in the errata: each pair of vortices once.
BOOST_AUTO_TEST_CASE(energy_of_the_four_vortices_of_the_paper) {
  const PointVortices vortices((VectorXd(4) << 1, 1, -1, -1).finished());
  const VectorXd q = (VectorXd(8) << -1, 1, -1, 1, 2, 2, -2, -2).finished();
  BOOST_TEST(vortices.hamiltonian(constants(q)).value() == -0.697421199668691,
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(both_forms_move_by_equation_6) {
  std::mt19937 generator(3);
  const VectorXd strengths = (VectorXd(3) << 1.5, -0.5, 2.0).finished();
  const PointVortices vortices(strengths);
  const auto hamiltonian = vortices.hamiltonian_form();
  const auto lagrangian = vortices.lagrangian_form();
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = random(6, generator);
    const VectorXd v = velocities(strengths, q);
    BOOST_TEST(hamiltonian->residual(q, v, VectorXd(0), 0.0).norm() < 1e-13 * (1.0 + v.norm()));
    BOOST_TEST(hamiltonian->residual(q, v + random(6, generator), VectorXd(0), 0.0).norm() > 1e-3);
    // On T*Q: p = α(q), and ṗ = α(q̇) since α is linear.
    VectorXd x(12), w(12);
    x << q, values(vortices.alpha(constants(q)));
    w << v, values(vortices.alpha(constants(v)));
    BOOST_TEST(lagrangian->residual(x, w, v, 0.0).norm() < 1e-13 * (1.0 + v.norm()));
    x[7] += 1e-3;
    BOOST_TEST(lagrangian->residual(x, w, v, 0.0).norm() > 1e-4);
  }
}

// L by hand is ⟨α(q), q̇⟩ - H(q), and ∂²L/∂q̇² = 0.
BOOST_AUTO_TEST_CASE(equation_7) {
  const PointVortices vortices((VectorXd(2) << 3, -2).finished());
  const VectorXd q = (VectorXd(4) << 1, 2, 5, 7).finished();
  const VectorXd velocity = (VectorXd(4) << 0.3, -1.1, 0.7, 0.2).finished();
  Graph graph;
  const ExprVector w = graph.variables("w", 4);
  const Expr L = vortices.alpha(constants(q)).dot(w) - vortices.hamiltonian(constants(q));
  const double by_hand = 0.5 * (3 * (1 * 0.7 - 5 * 0.3) - 2 * (2 * 0.2 + 7 * 1.1)) +
                         6 * std::log(5.0) / (4 * std::numbers::pi);
  const ExprVector value =
      substitute(ExprVector(ExprVector::Constant(1, L)), w, constants(velocity));
  BOOST_TEST(values(value)[0] == by_hand, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(values(jacobian(gradient(L, w), w).dense()).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(equation_8) {
  const VectorXd strengths = (VectorXd(2) << 3, -2).finished();
  const PointVortices vortices(strengths);
  const VectorXd q = (VectorXd(4) << 1, 2, 5, 7).finished();
  const VectorXd expected = (VectorXd(4) << -7.5, 7, 1.5, -2).finished();
  BOOST_TEST((values(vortices.alpha(constants(q))) - expected).norm() == 0.0);
  Graph graph;
  const ExprVector at = graph.variables("q", 4);
  const MatrixXd D = values(jacobian(vortices.alpha(at), at).dense());
  BOOST_TEST((D.transpose() - D - d_alpha(strengths)).norm() == 0.0);
}

// With each pair once, Γ ẏ = ∂H/∂x and Γ ẋ = -∂H/∂y are (6); with both orders of a pair, as
// printed, they are twice (6).
BOOST_AUTO_TEST_CASE(equation_9) {
  const VectorXd strengths = (VectorXd(3) << 1.5, -0.5, 2.0).finished();
  const PointVortices vortices(strengths);
  Graph graph;
  const ExprVector at = graph.variables("q", 6);
  const VectorXd q = (VectorXd(6) << 0.3, 1, -2, 0.4, 1, 3).finished();
  Expr printed = 0.0;
  for (Index j = 0; j < 3; ++j)
    for (Index k = 0; k < 3; ++k)
      if (j != k)
        printed += strengths[j] * strengths[k] *
                   log(square(at[j] - at[k]) + square(at[3 + j] - at[3 + k]));
  printed = printed / (4.0 * std::numbers::pi);
  const auto motion = [&](const Expr& H) {
    const VectorXd dH = values(substitute(gradient(H, at), at, constants(q)));
    VectorXd v(6);
    v << -dH.tail(3).cwiseQuotient(strengths), dH.head(3).cwiseQuotient(strengths);
    return v;
  };
  const VectorXd expected = velocities(strengths, q);
  BOOST_TEST((motion(vortices.hamiltonian(at)) - expected).norm() < 1e-15);
  BOOST_TEST((motion(printed) - 2.0 * expected).norm() < 1e-15);
}

// ∂_jα_i q̇_j = ∂_iα_j q̇_j - ∂_iH determines q̇, and it is that of (6).
BOOST_AUTO_TEST_CASE(equation_10) {
  std::mt19937 generator(5);
  const VectorXd strengths = (VectorXd(3) << 1.5, -0.5, 2.0).finished();
  const PointVortices vortices(strengths);
  Graph graph;
  const ExprVector at = graph.variables("q", 6);
  const MatrixXd D = values(jacobian(vortices.alpha(at), at).dense());
  const ExprVector slope = gradient(vortices.hamiltonian(at), at);
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = random(6, generator);
    const VectorXd dH = values(substitute(slope, at, constants(q)));
    const VectorXd v = LuDecomposition(D - D.transpose()).solve(-dH);
    const VectorXd expected = velocities(strengths, q);
    BOOST_TEST((v - expected).norm() < 1e-13 * (1.0 + expected.norm()));
  }
}

// S_0 by hand: p = α(q) and ṗ = ∂α_j/∂q q̇_j - ∂H/∂q with any q̇; ∂H/∂q is known from (6).
BOOST_AUTO_TEST_CASE(equation_11) {
  std::mt19937 generator(6);
  const VectorXd strengths = (VectorXd(3) << 1.5, -0.5, 2.0).finished();
  const auto system = PointVortices(strengths).lagrangian_form();
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = random(6, generator), w = random(6, generator);
    const VectorXd motion = velocities(strengths, q);
    VectorXd x(12), v(12);
    x << q, -0.5 * strengths.cwiseProduct(q.tail(3)), 0.5 * strengths.cwiseProduct(q.head(3));
    v << w, strengths.cwiseProduct(0.5 * w.tail(3) - motion.tail(3)),
        -strengths.cwiseProduct(0.5 * w.head(3) - motion.head(3));
    BOOST_TEST(system->residual(x, v, w, 0.0).norm() < 1e-13 * (1.0 + v.norm()));
    for (Index i = 0; i < 12; ++i) {  // each of the equations counts
      const VectorXd off = 1e-3 * VectorXd::Unit(12, i);
      BOOST_TEST(system->residual(x, v + off, w, 0.0).norm() > 1e-4);
      if (i >= 6) BOOST_TEST(system->residual(x + off, v, w, 0.0).norm() > 1e-4);
    }
  }
}

// S_0 = ♯_ω(𝓛): the images of the covectors of 𝓛 under ♯_ω = (ω♭)⁻¹ solve the equations of S_0.
// With the sign of ♯ changed, or for a covector off 𝓛, they do not. ♯_ω⁻¹, as printed before (11),
// leads from vectors to covectors.
BOOST_AUTO_TEST_CASE(s_0_is_the_image_of_the_lagrangian_submanifold_under_sharp) {
  std::mt19937 generator(8);
  const VectorXd strengths = (VectorXd(3) << 1.5, -0.5, 2.0).finished();
  const auto system =
      std::dynamic_pointer_cast<const DiracSystem>(PointVortices(strengths).lagrangian_form());
  BOOST_REQUIRE(system);
  const MatrixXd zero = MatrixXd::Zero(6, 6), one = MatrixXd::Identity(6, 6);
  MatrixXd omega(12, 12);  // ω(a, b) = aᵀ omega b for dq ∧ dp, ω♭(a) = omegaᵀ a
  omega << zero, one, -one, zero;
  const MatrixXd sharp = LuDecomposition(omega.transpose()).inverse();
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = random(6, generator), w = random(6, generator);
    VectorXd x(12);
    x << q, -0.5 * strengths.cwiseProduct(q.tail(3)), 0.5 * strengths.cwiseProduct(q.head(3));
    const auto& family = *std::dynamic_pointer_cast<const DiracSystem>(system)->family();
    BOOST_TEST(values(family.stationarity(constants(x), constants(w), 0.0)).norm() < 1e-14);
    const VectorXd alpha = values(family.differential(constants(x), constants(w), 0.0));
    BOOST_TEST(system->residual(x, sharp * alpha, w, 0.0).norm() < 1e-13 * (1.0 + alpha.norm()));
    BOOST_TEST(system->residual(x, -sharp * alpha, w, 0.0).norm() > 1e-2);
    BOOST_TEST(system->residual(x, sharp * random(12, generator), w, 0.0).norm() > 1e-2);
  }
}

BOOST_AUTO_TEST_CASE(finds_coinciding_vortices) {
  const PointVortices vortices((VectorXd(3) << 1, 1, 1).finished());
  BOOST_TEST(!vortices.coinciding((VectorXd(6) << 0, 1, 0, 0, 0, 1).finished()));
  const auto pair = vortices.coinciding((VectorXd(6) << 0, 1, 1, 0, 2, 2).finished());
  BOOST_REQUIRE(pair.has_value());
  BOOST_TEST(pair->first == 1);
  BOOST_TEST(pair->second == 2);
}

BOOST_AUTO_TEST_CASE(refuses_strengths_that_are_zero) {
  BOOST_CHECK_THROW(PointVortices((VectorXd(2) << 1, 0).finished()), std::invalid_argument);
  BOOST_CHECK_THROW(PointVortices((VectorXd(1) << NAN).finished()), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
