#include "courant/integrators/maps/one_step.hpp"

#include "courant/core/expressions/expr_vectors.hpp"

namespace courant {

OneStep::OneStep(const DiscretizationMap& map, const VectorXd& x0, std::mt19937& generator)
    : M_(*map.manifold()), x0_(x0) {
  std::normal_distribution<double> normal;
  const auto random = [&] { return normal(generator); };
  const Index N = M_.ambient_dimension();
  MatrixXd A = MatrixXd::NullaryExpr(M_.tangent_dimension(), N, random);
  A /= A.norm();
  const VectorXd b = VectorXd::NullaryExpr(N, random), c = VectorXd::NullaryExpr(N, random);
  const auto field = [&](const ExprVector& x, const Expr& t) -> ExprVector {
    const ExprVector angles = x + constants(b) + t * constants(c);
    const ExprVector wave = angles.unaryExpr([](const Expr& angle) { return sin(angle); });
    return M_.tangent_projector(x) * (constants(A) * wave);
  };
  Graph graph;
  const ExprVector x = graph.variables("x", N), t = graph.variables("t", 1);
  flow_ = Function("flow", {{"x", x}, {"t", t}}, M_.frame(x) * field(x, t[0]));

  const MatrixXd basis = M_.tangent_basis(x0);
  const ExprVector xi = graph.variables("xi", M_.dimension());
  const ExprVector h = graph.variables("h", 1);
  const ExprVector base_point = M_.chart(constants(x0), constants(basis), xi);
  const Expr stage = Expr(map.stage_time()) * h[0];
  const auto [first, second] = map.forward(base_point, ExprVector(h[0] * field(base_point, stage)));
  const MatrixXd into_chart = basis.transpose() * M_.coframe(x0);
  step_ = Function("step", {{"xi", xi}, {"h", h}},
                   joined(constants(into_chart) * (first - constants(x0)), second));
}

double OneStep::error(double h) const { return M_.separation(step(h), flow(h)); }

// Solves R⁻(x̄, h f(x̄)) = x₀ for x̄ in the chart at x₀ by a fixed point that contracts like h.
VectorXd OneStep::step(double h) const {
  const Index n = M_.dimension();
  VectorXd xi = VectorXd::Zero(n);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const VectorXd value = step_({xi, VectorXd::Constant(1, h)});
    xi -= value.head(n);
    if (value.head(n).norm() <= 1e-16 * (1.0 + x0_.norm())) break;
  }
  return step_({xi, VectorXd::Constant(1, h)}).tail(x0_.size());
}

VectorXd OneStep::flow(double time) const {
  constexpr int kSteps = 25;
  const double h = time / kSteps;
  VectorXd x = x0_;
  for (int i = 0; i < kSteps; ++i) {
    const auto f = [&](const VectorXd& y, double part) {
      return flow_({y, VectorXd::Constant(1, (i + part) * h)});
    };
    const VectorXd k1 = f(x, 0.0);
    const VectorXd k2 = f(x + h / 2 * k1, 0.5);
    const VectorXd k3 = f(x + h / 2 * k2, 0.5);
    const VectorXd k4 = f(x + h * k3, 1.0);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return x;
}

}  // namespace courant
