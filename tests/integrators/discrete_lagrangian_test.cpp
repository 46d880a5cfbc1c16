// Method 1 of a Lagrangian system is the variational integrator of a discrete Lagrangian (Section
// 6.1), step by step.
#include <boost/test/unit_test.hpp>

#include "courant/core/expressions/derivative.hpp"
#include "courant/tests/integrators/vortices.hpp"

// Mistakes that these cases have to notice:
//  * the momenta of a lift are exchanged (integrators/maps/cotangent_lift.cpp)
BOOST_AUTO_TEST_SUITE(discrete_lagrangian)

using namespace courant;

namespace {

using Formula = Lagrangian::Formula;

// L_d(q₀, q₁) = h L((1-θ) q₀ + θ q₁, (q₁ - q₀)/h, t₀ + θ h), differentiated as it is written.
struct DiscreteLagrangian {
  DiscreteLagrangian(const Formula& L, Index n, double theta, double h) {
    Graph graph;
    const ExprVector q0 = graph.variables("q0", n), q1 = graph.variables("q1", n);
    const ExprVector t = graph.variables("t", 1);
    const Expr value = Expr(h) * L(ExprVector(Expr(1.0 - theta) * q0 + Expr(theta) * q1),
                                   ExprVector((q1 - q0) / Expr(h)), t[0] + theta * h);
    ExprVector slopes(2 * n);
    slopes << gradient(value, q0), gradient(value, q1);
    slopes_ = Function("slopes", {{"q0", q0}, {"q1", q1}, {"t", t}}, slopes);
  }
  VectorXd D1(const VectorXd& q0, const VectorXd& q1, double t) const {
    return slopes_({q0, q1, VectorXd::Constant(1, t)}).head(q0.size());
  }
  VectorXd D2(const VectorXd& q0, const VectorXd& q1, double t) const {
    return slopes_({q0, q1, VectorXd::Constant(1, t)}).tail(q0.size());
  }
  Function slopes_;
};

// p_k = -D₁L_d(q_k, q_{k+1}), p_{k+1} = D₂L_d(q_k, q_{k+1}), and so D₂L_d(q_{k-1}, q_k) +
// D₁L_d(q_k, q_{k+1}) = 0, at five steps from any (q₀, p₀).
void check(const Formula& L, const VectorXd& x0, double theta, double h, double t0) {
  const Index n = x0.size() / 2;
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(n));
  const auto system = std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M),
                                                    std::make_shared<Lagrangian>(M, L));
  const DiscretizeFirst method(
      system, std::make_shared<CotangentLift>(M, std::make_shared<Theta>(M->base(), theta)));
  const DiscreteLagrangian discrete(L, n, theta, h);
  const auto stepper = method.stepper();
  State state{.t = t0, .x = x0};
  VectorXd before = x0, last_slope;
  for (int k = 0; k < 5; ++k) {
    stepper->step(state, h, t0 + (k + 1) * h);
    const VectorXd after = state.x;
    const double t = t0 + k * h;
    const VectorXd D1 = discrete.D1(before.head(n), after.head(n), t);
    const VectorXd D2 = discrete.D2(before.head(n), after.head(n), t);
    BOOST_TEST((before.tail(n) + D1).norm() < 1e-12 * (1.0 + D1.norm()));
    BOOST_TEST((after.tail(n) - D2).norm() < 1e-12 * (1.0 + D2.norm()));
    if (k > 0) BOOST_TEST((last_slope + D1).norm() < 1e-12 * (1.0 + D1.norm()));
    last_slope = D2;
    before = after;
  }
  BOOST_TEST((before - x0).head(n).norm() > 0.05);
}

}  // namespace

// The singular Lagrangian of four vortices, from momenta on M_0 and off.
BOOST_AUTO_TEST_CASE(of_four_vortices) {
  const Formula L = [](const ExprVector& q, const ExprVector& w, const Expr&) {
    return vortices::alpha(q).dot(w) - vortices::hamiltonian(q);
  };
  VectorXd x0 = vortices::lagrangian_form().over(vortices::positions());
  check(L, x0, 0.5, 0.7, 0.0);
  x0.tail(8) += 0.02 * VectorXd::LinSpaced(8, -1.0, 1.0);
  check(L, x0, 0.5, 0.7, 0.0);
}

// A regular one that depends on the time, with stages off the middle.
BOOST_AUTO_TEST_CASE(of_a_driven_system) {
  const Formula L = [](const ExprVector& q, const ExprVector& w, const Expr& t) {
    return (1.0 + 0.3 * sin(t)) * square(w[0]) / 2.0 + 0.65 * square(w[1]) +
           0.4 * square(q[0]) * w[1] - cos(q[0]) * q[1] + q[1] * sin(2.0 * t);
  };
  const VectorXd x0 = VectorXd{{0.7, -0.4, 1.1, 0.5}};
  for (const double theta : {0.5, 0.2, 1.0}) check(L, x0, theta, 0.15, 1.3);
}

BOOST_AUTO_TEST_SUITE_END()
