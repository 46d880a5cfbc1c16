#include "courant/systems/point_vortices.hpp"

#include <boost/test/unit_test.hpp>
#include <functional>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(point_vortices)

namespace {

// dα = Σ_i Γ_i dx_i ∧ dy_i as a matrix.
MatrixXd d_alpha(const VectorXd& strengths) {
  const Index n = strengths.size();
  MatrixXd form = MatrixXd::Zero(2 * n, 2 * n);
  form.topRightCorner(n, n) = strengths.asDiagonal();
  form.bottomLeftCorner(n, n) = -form.topRightCorner(n, n);
  return form;
}

// ‖Φ*dα - dα‖_∞ at q, with the derivative of Φ by central differences of order 6.
double preservation_defect(const std::function<VectorXd(const VectorXd&)>& map,
                           const VectorXd& strengths, const VectorXd& q) {
  MatrixXd D(q.size(), q.size());
  for (Index j = 0; j < q.size(); ++j) {
    const double delta = 1e-2;
    const auto at = [&](double s) { return map(q + s * delta * VectorXd::Unit(q.size(), j)); };
    D.col(j) =
        (45.0 * (at(1) - at(-1)) - 9.0 * (at(2) - at(-2)) + (at(3) - at(-3))) / (60.0 * delta);
  }
  const MatrixXd form = d_alpha(strengths);
  return (D.transpose() * form * D - form).lpNorm<Eigen::Infinity>();
}

}  // namespace

// The vector field whose graph S_f is, found by the constraint algorithm from the singular
// Lagrangian on T*R⁸, has a flow on M_0 = Im α that preserves ω_{M_0} = -dα.
BOOST_AUTO_TEST_CASE(flow_preserves_d_alpha) {
  const VectorXd strengths = (VectorXd(4) << 1, 1.5, -1, -0.8).finished();
  const VectorXd start = (VectorXd(8) << -1, 1, -1, 1, 2, 2, -2, -2).finished();
  const PointVortices vortices(strengths);
  const auto system = vortices.lagrangian_form();
  const auto on_M0 = [&](const VectorXd& q) {
    return VectorXd((VectorXd(16) << q, values(vortices.alpha(constants(q)))).finished());
  };
  const auto field = std::make_shared<VectorField>(
      system, ConstraintAlgorithm().run(system, {.x = on_M0(start)}), Backend::interpreter);
  const auto moved = [&](const VectorXd& q, ExplicitRungeKutta::Kind kind, int steps) {
    return ExplicitRungeKutta(field, kind).advance({.x = on_M0(q)}, 3.0 / steps, steps).x;
  };
  // The flow for time 3, with an error of about 10⁻¹².
  const auto flow = [&](const VectorXd& q) {
    return VectorXd(moved(q, ExplicitRungeKutta::Kind::classical, 300).head(8));
  };
  const VectorXd end = moved(start, ExplicitRungeKutta::Kind::classical, 300);
  BOOST_TEST((end - on_M0(end.head(8))).norm() < 1e-9);  // it stays on M_0
  BOOST_TEST((end.head(8) - start).norm() > 0.1);
  BOOST_TEST(preservation_defect(flow, strengths, start) < 1e-9);
  // The controls: one step of the explicit midpoint rule, and a form with another strength.
  const auto rk2 = [&](const VectorXd& q) {
    return VectorXd(moved(q, ExplicitRungeKutta::Kind::midpoint, 1).head(8));
  };
  BOOST_TEST(preservation_defect(rk2, strengths, start) > 1e-3);
  VectorXd other = strengths;
  other[1] = 1.0;
  BOOST_TEST(preservation_defect(flow, other, start) > 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
