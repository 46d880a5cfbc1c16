#include "courant/integrators/constrain_first.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "courant/core/derivative.hpp"
#include "courant/integrators/discretize_first.hpp"
#include "courant/integrators/local_formulation.hpp"
#include "courant/integrators/moving_basis.hpp"
#include "courant/integrators/predictor.hpp"
#include "courant/integrators/round_off_projection.hpp"
#include "courant/integrators/step_solver.hpp"

namespace courant {
namespace {

// P is found by solving with W of the last iterate until W no longer changes: contraction is about
// curvature × ‖μ‖ = O(h²).
constexpr int kMaxProjections = 30;

// One vector of all parts.
ExprVector join(const std::vector<ExprVector>& parts) {
  Index size = 0;
  for (const ExprVector& part : parts) size += part.size();
  ExprVector result(size);
  Index offset = 0;
  for (const ExprVector& part : parts) {
    result.segment(offset, part.size()) = part;
    offset += part.size();
  }
  return result;
}

}  // namespace

class ConstrainFirst::Trajectory final : public Stepper {
 public:
  Trajectory(const ConstrainFirst& method, const State& initial, double h)
      : Stepper(initial),
        method_(method),
        manifold_(*method.system_->manifold()),
        n_(manifold_.dimension()),
        d_(method.codimension_),
        rest_((method.blocks_ - 2) * n_ + method.auxiliaries_),
        constant_directions_(n_ == manifold_.tangent_dimension() &&
                             method.projector_->has_constant_directions(d_)),
        solver_(method.equations_, {n_, n_, rest_, d_}, method.name()),
        projector_(method.projection_, {n_, n_, rest_, d_}, method.name() + " (projection)"),
        round_off_projection_(method.constraint_),
        predictor_(manifold_, method.blocks_, solver_.unknown().size()),
        basis_(manifold_, method.basis_, initial.x),
        directions_(n_, d_),
        origin_(initial.t),
        h_(h),
        start_(VectorXd::Zero(solver_.unknown().size())),
        near_(manifold_.ambient_dimension()),
        found_(method.projected_.output_size()),
        rows_(method.constraints_.output_size() + method.constraints_.nonzeros()) {
    const Index m = method.system_->auxiliary_size();
    if (state_.v.size() != manifold_.tangent_dimension())
      state_.v = VectorXd::Zero(manifold_.tangent_dimension());
    if (state_.z.size() != m) state_.z = VectorXd::Zero(m);
    VectorXd& y = projector_.unknown();
    y.setZero();
    y.segment(n_, n_) = basis_.matrix().transpose() * state_.v;
    y.segment(method_.blocks_ * n_, m) = state_.z;
    near_ = state_.x;
    project(state_.x, state_.t);
    accept(state_.t);
  }

 private:
  void do_step() override {
    VectorXd& y = solver_.unknown();
    const VectorXd& here = projector_.unknown();  // ξ', … and z, … at x_k
    start_ = here;
    start_.head(n_).setZero();
    start_.tail(d_).setZero();
    if (predictor_.is_empty()) {
      y = start_;
      y.head(n_) = 0.5 * h_ * here.segment(n_, n_);
    } else {
      predictor_.predict(basis_.matrix(), y);
    }
    const double* in[] = {y.data(), state_.x.data(), basis_.data(), directions_.data(),
                          &h_,      &state_.t};
    solve(solver_, in);
    method_.advance_.value(in, near_.data());
    if (!near_.allFinite())
      throw SolveError(SolveError::Reason::left_domain, state_.t, statistics_.steps + 1, {},
                       method_.name() + ": step " + std::to_string(statistics_.steps + 1) +
                           " leads to a state that is not finite.");
    round_off_projection_.apply(near_);
    predictor_.record(basis_.matrix(), y);

    VectorXd& end = projector_.unknown();
    end = y;
    end.head(n_).setZero();
    end.tail(d_).setZero();
    const double t = origin_ + static_cast<double>(statistics_.steps + 1) * h_;
    project(near_, t);
    accept(t);
  }

  void solve(StepSolver& solver, const double* const* in) {
    const double size = largest(state_.x);
    const double scales[] = {size, size / std::fabs(h_), auxiliary_scale(largest(state_.z), size),
                             size};
    solver.solve(in, scales, start_, state_, statistics_);
  }

  // The point of M_f that P takes near_ to, searched from `guess`; leaves its unknowns in
  // projector_, its basis and W behind.
  void project(VectorXd guess, double t) {
    VectorXd& y = projector_.unknown();
    double previous = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kMaxProjections; ++iteration) {
      if (n_ < manifold_.tangent_dimension()) {  // the same vectors in the new basis
        vectors_.noalias() =
            basis_.matrix() * y.head(method_.blocks_ * n_).reshaped(n_, method_.blocks_);
        basis_.move_to(guess);
        y.head(method_.blocks_ * n_).reshaped(n_, method_.blocks_).noalias() =
            basis_.matrix().transpose() * vectors_;
      }
      y.head(n_).setZero();
      aim(guess, y, t);
      start_ = y;
      const double* in[] = {y.data(),           guess.data(), basis_.data(),
                            directions_.data(), near_.data(), &t};
      solve(projector_, in);
      method_.projected_.value(in, found_.data());
      const double moved = largest(y.head(n_));
      guess = found_.head(guess.size());
      // P does not depend on W once x no longer moves with it; below 4 eps of the state, round-off
      // moves it.
      if (d_ == 0 || constant_directions_ || moved <= 1e-15 * largest(guess) ||
          (moved >= 0.5 * previous && moved < 1e-12 * (1.0 + largest(guess))))
        return;
      previous = moved;
    }
    throw SolveError(SolveError::Reason::diverged, state_.t, statistics_.steps + 1, {},
                     method_.name() + ": the projection onto M_f does not converge in step " +
                         std::to_string(statistics_.steps + 1) + "; the step is too large.");
  }

  // W at a point: the conormals of M_f are the combinations of the equations of S_f that contain
  // nothing but x.
  void aim(const VectorXd& x, const VectorXd& y, double t) {
    if (d_ == 0 || (constant_directions_ && is_aimed_)) return;
    is_aimed_ = true;
    const double* in[] = {y.data(), x.data(), basis_.data(), &t};
    const Function& f = method_.constraints_;
    f.value_and_jacobian(in, rows_.data());
    MatrixXd J = MatrixXd::Zero(f.output_size(), f.jacobian_cols());
    for (std::size_t k = 0; k < f.pattern_row().size(); ++k)
      J(f.pattern_row()[k], f.pattern_col()[k]) = rows_[f.output_size() + static_cast<Index>(k)];
    Eigen::ColPivHouseholderQR<MatrixXd> others;
    others.setThreshold(
        1e-9);  // the ladder decided this rank with a gap; here it only has to be found again
    others.compute(J.rightCols(J.cols() - n_));
    const MatrixXd Q = others.householderQ();
    const MatrixXd gradients =
        (Q.rightCols(J.rows() - others.rank()).transpose() * J.leftCols(n_)).transpose();
    const Eigen::ColPivHouseholderQR<MatrixXd> span(gradients);
    const MatrixXd conormals = span.householderQ() * MatrixXd::Identity(n_, d_);
    const MatrixXd W = method_.projector_->directions(x, basis_.matrix(), conormals);
    // The same span as W, but near the last one, so that μ and the kept factorisations go on.
    if (statistics_.steps > 0) {
      const MatrixXd turned = W * (W.transpose() * directions_);
      directions_ = 1.5 * turned - 0.5 * turned * (turned.transpose() * turned);
      if ((directions_.transpose() * directions_ - MatrixXd::Identity(d_, d_))
              .lpNorm<Eigen::Infinity>() < 0.1)
        return;
    }
    directions_ = W;
  }

  void accept(double t) {
    const Index tangent = manifold_.tangent_dimension();
    state_.x = found_.head(state_.x.size());
    state_.v = found_.segment(state_.x.size(), tangent);
    state_.z = found_.tail(state_.z.size());
    state_.t = t;
  }

  const ConstrainFirst method_;  // its functions are shared, not copied
  const Manifold& manifold_;
  Index n_, d_, rest_;
  bool constant_directions_, is_aimed_ = false;
  StepSolver solver_, projector_;
  RoundOffProjection round_off_projection_;
  Predictor predictor_;
  MovingBasis basis_;    // B at x_k
  MatrixXd directions_;  // W at x_k
  MatrixXd vectors_;
  double origin_, h_;
  VectorXd start_, near_, found_, rows_;
};

ConstrainFirst::ConstrainFirst(std::shared_ptr<const ImplicitSystem> system,
                               const ConstraintLadder& ladder,
                               std::shared_ptr<const DiscretizationMap> map,
                               std::shared_ptr<const Projector> projector, const Options& options)
    : system_(std::move(system)), map_(std::move(map)), projector_(std::move(projector)) {
  if (!system_ || !map_ || !projector_ || map_->manifold() != system_->manifold())
    throw std::invalid_argument(
        "ConstrainFirst::ConstrainFirst: map is not on the manifold of the system; expected the "
        "same object.");
  if (ladder.verdict != Verdict::regular && ladder.verdict != Verdict::gauge)
    throw std::invalid_argument("ConstrainFirst::ConstrainFirst: the ladder's verdict is " +
                                to_string(ladder.verdict) + "; expected regular or gauge. " +
                                ladder.reason);
  const Manifold& M = *system_->manifold();
  const Index n = M.dimension();
  codimension_ = n - ladder.degrees_of_freedom;
  gauge_dimension_ = ladder.gauge_dimension;

  Graph graph;
  const ExprVector x0 = graph.variables("x0", M.ambient_dimension());
  const ExprMatrix basis = basis_variables(graph, M);
  const ExprVector t = graph.variables("t", 1);
  const ExprVector h = graph.variables("h", 1);
  const ExprVector directions = graph.variables("W", n * codimension_);
  const ExprVector mu = graph.variables("mu", codimension_);
  const ExprVector shift =
      Eigen::Map<const ExprMatrix>(directions.data(), n, codimension_) * mu;  // W μ
  const LocalFormulation local(graph, *system_, x0, basis, t[0], ladder.differentiations);
  blocks_ = static_cast<Index>(local.xi.size());
  std::vector<ExprVector> parts = local.xi;
  parts.insert(parts.end(), local.z.begin(), local.z.end());
  const ExprVector jets = join(parts);
  auxiliaries_ = jets.size() - blocks_ * n;
  const ExprVector y = join({jets, mu});
  const ExprVector basis_entries = basis_parameters(M, basis);
  const ExprVector equations = local.nonzero_equations();

  constraints_ =
      Function("constraints", {{"y", jets}, {"x0", x0}, {"basis", basis_entries}, {"t", t}},
               equations, {.differentiate = {"y"}, .backend = options.backend});

  // The step.
  const auto ends = map_->forward(local.x, ExprVector(h[0] * local.v));
  const ExprVector moved = M.chart(x0, basis, shift);
  const ExprVector at_start = M.coframe(x0) * ExprVector(ends.first - moved);
  const ExprVector staged =
      substitute(equations, t, ExprVector::Constant(1, t[0] + Expr(map_->stage_time()) * h[0]));
  const std::vector<Function::Input> step = {
      {"y", y}, {"x0", x0}, {"basis", basis_entries}, {"W", directions}, {"h", h}, {"t", t}};
  equations_ =
      Function("constrain-first", step, join({ExprVector(basis.transpose() * at_start), staged}),
               {.differentiate = {"y"}, .backend = options.backend});
  advance_ = Function("advance", step, ends.second, {.backend = options.backend});

  // The projection.
  const ExprVector near = graph.variables("near", M.ambient_dimension());
  const ExprVector along = M.tangent_projector(local.x) * ExprVector(basis * shift);
  const ExprVector distance = M.coframe(x0) * ExprVector(M.retract(local.x, along) - near);
  const std::vector<Function::Input> at_end = {
      {"y", y}, {"x0", x0}, {"basis", basis_entries}, {"W", directions}, {"near", near}, {"t", t}};
  projection_ =
      Function("projection", at_end, join({ExprVector(basis.transpose() * distance), equations}),
               {.differentiate = {"y"}, .backend = options.backend});
  basis_ = MovingBasis::projection(M, options.backend);
  constraint_ = RoundOffProjection::constraint(M, options.backend);
  projected_ = Function("projected", at_end, join({local.x, local.v, local.z[0]}),
                        {.backend = options.backend});
}

std::unique_ptr<Stepper> ConstrainFirst::start(const State& initial, double h) const {
  check_start("ConstrainFirst", *system_, initial, h);
  return std::make_unique<Trajectory>(*this, initial, h);
}

}  // namespace courant
