#include "courant/integrators/step/kinetic_metric.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"

// Mistakes that these cases have to notice:
//  * numbers that are round-off are a metric
BOOST_AUTO_TEST_SUITE(kinetic_metric_test)

using namespace courant;
using Eigen::Vector4d;

BOOST_AUTO_TEST_CASE(kinetic_metric_is_that_of_the_energy) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto H = std::make_shared<Hamiltonian>(M, [](const ExprVector& x, const Expr&) {
    return 0.5 * (square(x[2]) * (1.0 + square(x[0])) + x[2] * x[3] + 2.0 * square(x[3])) + x[1];
  });
  const auto system = std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M), H);
  const Vector4d x(0.5, 0.1, 0.3, -0.2);
  const auto metric = kinetic_metric(system, MomentumProjector::momenta_of(*M), x);
  BOOST_REQUIRE(metric.has_value());
  Eigen::Matrix2d expected;
  expected << 1.25, 0.5, 0.5, 2.0;
  BOOST_TEST((values(metric->raise(constants(x))) - expected).norm() < 1e-14);
  BOOST_TEST((values(metric->lower(constants(x))) - expected.inverse()).norm() < 1e-14);
  // None where the energy does not say: L = ⟨α, w⟩ - H has no p in its energy.
  const auto singular = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Lagrangian>(
          M, [](const ExprVector& q, const ExprVector& w, const Expr&) { return q[0] * w[1]; }));
  BOOST_TEST(!kinetic_metric(singular, {2, 3}, x));
}

// ∂²L/∂w², with constraints on positions besides; none where it depends on w, or is indefinite.
BOOST_AUTO_TEST_CASE(kinetic_metric_is_that_of_the_lagrangian) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const Vector4d x(0.5, 0.1, 0.3, -0.2);
  const auto metric = [&](const Lagrangian::Formula& L) {
    const auto family = std::make_shared<ConstrainedFamily>(
        std::make_shared<Lagrangian>(M, L),
        [](const ExprVector& y, const ExprVector&, const Expr&) {
          return ExprVector{{y[0] - 5.0 * y[1]}};
        },
        1);
    return kinetic_metric(
        std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M), family),
        MomentumProjector::momenta_of(*M), x);
  };
  const auto kinetic = metric([](const ExprVector& q, const ExprVector& w, const Expr&) -> Expr {
    return 0.5 * (square(w[0]) * (1.0 + square(q[0])) + w[0] * w[1] + 2.0 * square(w[1])) - q[1] +
           sin(q[0]) * w[1];
  });
  BOOST_REQUIRE(kinetic.has_value());
  Eigen::Matrix2d expected;
  expected << 1.25, 0.5, 0.5, 2.0;
  BOOST_TEST((values(kinetic->lower(constants(x))) - expected).norm() < 1e-14);
  BOOST_TEST((values(kinetic->raise(constants(x))) - expected.inverse()).norm() < 1e-14);
  BOOST_TEST(!metric([](const ExprVector&, const ExprVector& w, const Expr&) -> Expr {
    return square(w[0]) + square(w[1]) * square(w[1]);
  }));
  BOOST_TEST(!metric([](const ExprVector&, const ExprVector& w, const Expr&) -> Expr {
    return square(w[0]) - square(w[1]);
  }));

  // On a sphere it is 1 across.
  const auto T = std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2));
  const auto round = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(T),
      std::make_shared<Lagrangian>(T,
                                   [](const ExprVector&, const ExprVector& w, const Expr&) -> Expr {
                                     return 1.5 * w.squaredNorm();
                                   }));
  const VectorXd y = (VectorXd(6) << 0.0, 0.0, 1.0, 0.2, 0.3, 0.0).finished();
  const auto on_sphere = kinetic_metric(round, MomentumProjector::momenta_of(*T), y);
  BOOST_REQUIRE(on_sphere.has_value());
  const MatrixXd three = Eigen::Vector3d(3.0, 3.0, 1.0).asDiagonal();
  BOOST_TEST((values(on_sphere->lower(constants(y))) - three).norm() < 1e-14);
}

// What is quadratic in no momenta, or in some of them, has none; nor what is indefinite. On T*S² numbers that are zero but
// for round-off are no metric, wherever the point is.
BOOST_AUTO_TEST_CASE(there_is_none) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto has_metric = [&](const Hamiltonian::Formula& H) {
    const auto system = std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M),
                                                      std::make_shared<Hamiltonian>(M, H));
    return kinetic_metric(system, MomentumProjector::momenta_of(*M), Vector4d(0.5, 0.1, 0.3, -0.2))
        .has_value();
  };
  BOOST_TEST(has_metric([](const ExprVector& x, const Expr& t) -> Expr {
    return 0.5 * (square(x[2]) + square(x[3])) + sin(t) * x[2] + x[0] * x[3];
  }));
  BOOST_TEST(!has_metric([](const ExprVector& x, const Expr&) -> Expr {
    return sqrt(1.0 + square(x[2]) + square(x[3]));
  }));
  BOOST_TEST(!has_metric([](const ExprVector& x, const Expr& t) -> Expr {
    return (1.0 + square(t)) * (square(x[2]) + square(x[3]));
  }));
  BOOST_TEST(!has_metric([](const ExprVector& x, const Expr&) -> Expr { return square(x[2]); }));
  BOOST_TEST(!has_metric(
      [](const ExprVector& x, const Expr&) -> Expr { return square(x[2]) - square(x[3]); }));

  const auto T = std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2));
  const auto still = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(T),
      std::make_shared<Hamiltonian>(T, [](const ExprVector& x, const Expr&) { return x[2]; }));
  std::mt19937 generator(6);
  for (int i = 0; i < 300; ++i)
    BOOST_TEST(!kinetic_metric(still, MomentumProjector::momenta_of(*T), T->random_point(generator))
                    .has_value());
}

BOOST_AUTO_TEST_SUITE_END()
