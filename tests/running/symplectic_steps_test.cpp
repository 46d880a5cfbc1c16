// Steps of lifted maps on T*S² and T*SO(3) keep ω_Q, measured through the embedding
// (q, p) ↦ (q, C(q)ᵀ p) ∈ R^{2N}, which pulls dq ∧ dP back to ω_Q: no frame, no torsion.
#include <boost/test/unit_test.hpp>

#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(symplectic_steps)

namespace {

using test::method_1;

// max |ω(DΦ a, DΦ b) - ω(a, b)| over random unit a, b at x, for one step Φ of size h.
double symplecticity_defect(const Integrator& method, const CotangentBundle& M, const VectorXd& x,
                            double h) {
  const Index N = M.base()->ambient_dimension();
  const auto embedded = [&](const VectorXd& y) {
    const VectorXd q = M.position(y), p = M.momentum(y);
    VectorXd result(2 * N);
    result << q, M.base()->coframe(q).transpose() * p;
    return result;
  };
  const auto step = [&](const VectorXd& y) { return method.advance({.x = y}, h).x; };
  // Along s ↦ R_x(s a), by differences of order 8.
  const auto derivatives = [&](const VectorXd& a) {
    constexpr double kWeights[] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
    constexpr double kStep = 0.02;
    MatrixXd result = MatrixXd::Zero(2 * N, 2);
    for (int k = 1; k <= 4; ++k)
      for (const double sign : {1.0, -1.0}) {
        const VectorXd y = M.retract(x, VectorXd(sign * k * kStep * a));
        const double weight = sign * kWeights[k - 1] / kStep;
        result.col(0) += weight * embedded(y);
        result.col(1) += weight * embedded(step(y));
      }
    return result;
  };
  const auto omega = [&](const VectorXd& a, const VectorXd& b) {
    return a.head(N).dot(b.tail(N)) - b.head(N).dot(a.tail(N));
  };
  std::mt19937 generator(7);
  double worst = 0.0;
  for (int pair = 0; pair < 6; ++pair) {
    const MatrixXd a = derivatives(M.random_tangent(x, 1.0, generator));
    const MatrixXd b = derivatives(M.random_tangent(x, 1.0, generator));
    worst = std::max(worst, std::abs(omega(a.col(1), b.col(1)) - omega(a.col(0), b.col(0))));
  }
  return worst;
}

double defect_of(const char* file, const Json& method) {
  const auto system = test::problem(test::experiment_file(file));
  const auto& M = dynamic_cast<const CotangentBundle&>(*system.experiment.model.system->manifold());
  const double h = 0.2;
  return symplecticity_defect(*system.prepare(method, h).integrator, M, system.ladder.point.x, h);
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_sphere) {
  for (const char* map : {"exponential", "chordal", "spherical-midpoint"})
    BOOST_TEST(defect_of("spherical_pendulum", method_1(map)) < 1e-10, map);
  BOOST_TEST(defect_of("spherical_pendulum", "rk4") > 1e-8);
}

BOOST_AUTO_TEST_CASE(on_rotations) {
  for (const char* file : {"rigid_body_so3", "heavy_top_so3"})
    for (const char* map : {"exponential", "cayley"})
      BOOST_TEST(defect_of(file, method_1(map)) < 1e-10, map);
  BOOST_TEST(defect_of("rigid_body_so3", "rk4") > 1e-8);
}

// The midpoint rule of T*SO(3) itself is no lift.
BOOST_AUTO_TEST_CASE(the_midpoint_of_the_bundle_is_not_symplectic) {
  const auto top = test::problem(test::experiment_file("heavy_top_so3"));
  const auto& system = top.experiment.model.system;
  const auto& M = dynamic_cast<const CotangentBundle&>(*system->manifold());
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()),
                               {.backend = Backend::interpreter});
  BOOST_TEST(symplecticity_defect(method, M, top.ladder.point.x, 0.2) > 1e-5);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
