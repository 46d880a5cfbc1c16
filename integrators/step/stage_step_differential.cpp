#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/step/stage_step.hpp"

namespace courant {

// With R_d⁻¹ in closed form F is a function of (x₀, x₁, z):
//
//   ∂F/∂x₁ δx₁ + ∂F/∂z δz = -∂F/∂x₀ δx₀
//
// Otherwise of (x̄, w, z), w = h v, and so are x₀ and x₁:
//
//   T R_d⁻ (δx̄, δw) = δx₀,   ∂F/∂x̄ δx̄ + ∂F/∂w δw + ∂F/∂z δz = 0,   δx₁ = T R_d⁺ (δx̄, δw)
class StageStep::Differential final : public StepDifferential {
 public:
  explicit Differential(const StageStep& method) : method_(method) {
    const ImplicitSystem& S = *method.system_;
    const DiscretizationMap& map = *method.map_;
    const Manifold& M = *S.manifold();
    Graph graph;
    const ExprVector z = graph.variables("z", S.auxiliary_size());
    const ExprVector h = graph.variables("h", 1), t = graph.variables("t", 1);
    const auto residual = [&](const ExprVector& x, const ExprVector& displacement,
                              const ExprVector& end) {
      return method
          .method_({.x = x,
                    .v = ExprVector((1.0 / h[0]) * displacement),
                    .z = z,
                    .t = t[0] + Expr(map.stage_time()) * h[0],
                    .h = h[0],
                    .end = end,
                    .end_time = t[0] + h[0]})
          .residual;
    };
    if (map.has_inverse()) {
      const ExprVector x0 = graph.variables("x0", M.ambient_dimension());
      const ExprVector x1 = graph.variables("x1", M.ambient_dimension());
      const auto [x, displacement] = map.inverse(x0, x1);
      equations_ = Function("differential", {{"x0", x0}, {"x1", x1}, {"z", z}, {"h", h}, {"t", t}},
                            residual(x, displacement, x1), {.differentiate = {"x0", "x1", "z"}});
    } else {
      const ExprVector x = graph.variables("x", M.ambient_dimension());
      const ExprVector w = graph.variables("w", M.tangent_dimension());
      const ExprVector displacement = M.tangent_projector(x) * w;
      const auto ends = map.forward(x, displacement);
      equations_ = Function("differential", {{"x", x}, {"w", w}, {"z", z}, {"h", h}, {"t", t}},
                            joined(ends.first, ends.second, residual(x, displacement, ends.second)),
                            {.differentiate = {"x", "w", "z"}});
    }
  }

 private:
  MatrixXd do_images(const Step& step, const MatrixXd& V) const override {
    if (!method_.map_->has_inverse()) {
      const Linear at = by_stage(step);
      MatrixXd B = MatrixXd::Zero(at.A.rows(), V.cols());
      B.topRows(at.start.rows()) = at.start * V;
      return at.end * solved(at, B);
    }
    const Linear at = by_ends(step);
    return at.end * solved(at, at.start * V);
  }

  MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const override {
    const Linear at = method_.map_->has_inverse() ? by_ends(step) : by_stage(step);
    const MatrixXd W =
        implicit_adjoint(method_.name_.c_str(), at.A, at.end.transpose() * Lambda, at.determined);
    return at.start.transpose() * W.topRows(at.start.rows());
  }

  // A X + (start δx₀, 0) = 0,   δx₁ = end X, where the first `determined` numbers of X have to be.
  struct Linear {
    MatrixXd A, start, end;
    Index determined;
  };
  MatrixXd solved(const Linear& at, const MatrixXd& B) const {
    return implicit_derivative(method_.name_.c_str(), at.A, B, at.determined);
  }

  Linear by_ends(const Step& step) const {
    const Index N = step.before.x.size(), n = manifold().dimension(), m = step.after.z.size();
    const MatrixXd J =
        equations_.jacobian({step.before.x, step.after.x, step.after.z,
                             VectorXd::Constant(1, step.h), VectorXd::Constant(1, step.before.t)});
    const MatrixXd tangent = velocities(step.after.x);
    Linear at{MatrixXd(J.rows(), n + m), J.leftCols(N), MatrixXd::Zero(N, n + m), n};
    at.A << J.middleCols(N, N) * tangent, J.rightCols(m);
    at.end.leftCols(n) = tangent;
    return at;
  }

  Linear by_stage(const Step& step) const {
    const Index N = step.before.x.size(), n = manifold().dimension(), m = step.after.z.size();
    const MatrixXd J =
        equations_.jacobian({step.stage.x, VectorXd(step.h * step.after.v), step.after.z,
                             VectorXd::Constant(1, step.h), VectorXd::Constant(1, step.before.t)});
    const MatrixXd basis = manifold().tangent_basis(step.stage.x);
    MatrixXd along(J.rows(), 2 * n + m);
    along << J.leftCols(N) * velocities(step.stage.x), J.middleCols(N, basis.rows()) * basis,
        J.rightCols(m);
    const Index equations = J.rows() - 2 * N;
    const MatrixXd to_start = manifold().tangent_basis(step.before.x).matrix().transpose() *
                              manifold().coframe(step.before.x).matrix();
    Linear at{MatrixXd(n + equations, 2 * n + m), -to_start, along.middleRows(N, N), 2 * n};
    at.A << to_start * along.topRows(N), along.bottomRows(equations);
    return at;
  }

  const Manifold& manifold() const { return *method_.system_->manifold(); }
  // A basis of T_xM as ambient velocities.
  MatrixXd velocities(const VectorXd& x) const {
    return (manifold().frame(x) * manifold().tangent_basis(x)).matrix();
  }

  const StageStep method_;  // its functions are shared, not copied
  Function equations_;
};

std::shared_ptr<const StepDifferential> StageStep::differential() const {
  return std::make_shared<Differential>(*this);
}

}  // namespace courant
