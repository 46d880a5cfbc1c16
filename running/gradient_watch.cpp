#include "courant/running/gradient_watch.hpp"

#include <stdexcept>
#include <vector>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/step/solve_error.hpp"

namespace courant {
namespace {

constexpr Index kMostWatched = 200, kMostConstraints = 50;
constexpr int kClosely = 9;
constexpr double kIndependentGradients = 1e-9;  // rows next to others

bool is_one_piece(const MatrixXd& before, const MatrixXd& after) {
  return LuDecomposition(before * after.transpose()).orientation() > 0;
}

// Equations of x and t alone.
ExprVector equations_of_points(const ImplicitSystem& system, const Graph& graph,
                               const ExprVector& x, const Expr& t) {
  const ExprVector v = graph.variables("v", system.manifold()->tangent_dimension()),
                   z = graph.variables("z", system.auxiliary_size());
  const ExprVector F = system.residual(x, v, z, t);
  const std::vector<bool> has_v = each_depends(F, v), has_z = each_depends(F, z),
                          has_x = each_depends(F, x);
  std::vector<Index> rows;
  for (Index i = 0; i < F.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (has_x[k] && !has_v[k] && !has_z[k]) rows.push_back(i);
  }
  return F(rows);
}

}  // namespace

GradientWatch::GradientWatch(std::shared_ptr<const Integrator> integrator, const State& initial)
    : integrator_(std::move(integrator)) {
  const ImplicitSystem& system = *integrator_->system();
  const Index N = system.manifold()->ambient_dimension();
  if (N > kMostWatched) return;
  Graph graph;
  const ExprVector x = graph.variables("x", N), t = graph.variables("t", 1);
  const ExprVector all = equations_of_points(system, graph, x, t[0]);
  if (all.size() == 0 || all.size() > kMostConstraints) return;
  constraints_ = Function("constraints", {{"x", x}, {"t", t}}, all, {.differentiate = {"x"}});
  const MatrixXd J = gradients(initial);
  // Of dependent ones the gradient of one may vanish where those of others do not, here too.
  const VectorXd lengths = J.rowwise().norm();
  if (!J.allFinite() || lengths.minCoeff() == 0.0 ||
      CompleteOrthogonalDecomposition(J.rowwise().normalized().transpose(), kIndependentGradients)
              .rank() < J.rows())
    constraints_ = Function();
}

MatrixXd GradientWatch::gradients(const State& state) const {
  const Manifold& M = *integrator_->system()->manifold();
  const MatrixXd J = constraints_.jacobian({state.x, VectorXd::Constant(1, state.t)});
  const LinearMap<double> frame = M.frame(state.x);
  return frame.is_identity() ? J : MatrixXd(J * (frame * M.coframe(state.x)).matrix());
}

std::optional<RunEnd> GradientWatch::watch(const RunMoment& moment) {
  if (moment.k == 0 || constraints_.input_count() == 0) return std::nullopt;
  const Step& step = moment.step;
  if (last_x_.size() != step.before.x.size() || last_x_ != step.before.x)
    last_gradients_ = gradients(step.before);
  MatrixXd after = gradients(step.after);
  const bool is_turned = !is_one_piece(last_gradients_, after);
  last_gradients_ = std::move(after);
  last_x_ = step.after.x;
  if (!is_turned || !is_crossed(step)) return std::nullopt;
  return RunEnd{RunStatus::failed,
                "The step to t = " + number_text(moment.t) +
                    " crosses a point at which the gradients of the constraints vanish or turn "
                    "round at once, as at the tip of a cone. How a solution goes on there the "
                    "equations do not say."};
}

bool GradientWatch::is_crossed(const Step& step) const {
  try {
    const auto stepper = integrator_->stepper();
    State state = step.before;
    MatrixXd before = gradients(state);
    for (int part = 0; part < kClosely; ++part) {
      stepper->step(state, step.h / kClosely);
      MatrixXd after = gradients(state);
      if (!is_one_piece(before, after)) return true;
      before = std::move(after);
    }
    return false;
  } catch (const SolveError&) {
    return true;
  } catch (const std::domain_error&) {
    return false;
  }
}

}  // namespace courant
