#include "courant/integrators/constrain_first.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/derivative.hpp"
#include "courant/integrators/discretize_first.hpp"
#include "courant/integrators/ladder/local_formulation.hpp"
#include "courant/integrators/moving_basis.hpp"
#include "courant/integrators/moving_conormals.hpp"
#include "courant/integrators/nearest_orthonormal.hpp"
#include "courant/integrators/predictor.hpp"
#include "courant/integrators/round_off_projection.hpp"
#include "courant/integrators/step_solver.hpp"

namespace courant {
namespace {

// P is found by solving with W of the last iterate until W no longer changes: contraction is about
// curvature × ‖μ‖ = O(h²).
constexpr int kMaxProjections = 30;

// What is left of x, relative to its size, when W is taken to change no more: less than round-off.
// The contraction that it is computed with is that of the last step, at most so many times too
// small.
constexpr double kTolerance = 1e-16;
constexpr double kSafety = 10.0;

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

// How many of ξ, ξ', … (at least two) and of z, z', … (at least one) there are up to the last that
// the equations contain.
std::pair<Index, Index> contained_jets(const LocalFormulation& local, const ExprVector& equations) {
  const auto last = [&](const std::vector<ExprVector>& jets, std::size_t least) {
    std::size_t count = jets.size();
    while (count > least && jacobian(equations, jets[count - 1]).values.size() == 0) --count;
    return static_cast<Index>(count);
  };
  return {last(local.xi, 2), last(local.z, 1)};
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
        predictor_({method.blocks_ * n_, solver_.unknown().size() - method.blocks_ * n_}),
        end_({method.blocks_ * n_, solver_.unknown().size() - method.blocks_ * n_}),
        shift_({manifold_.tangent_dimension()}),
        basis_(manifold_, method.basis_, initial.x),
        conormals_(method.conormals_, n_, d_),
        directions_(n_, d_),
        make_orthonormal_(d_),
        origin_(initial.t),
        h_(h),
        start_(VectorXd::Zero(solver_.unknown().size())),
        near_(manifold_.ambient_dimension()),
        guess_(near_.size()),
        shifted_(VectorXd::Zero(manifold_.tangent_dimension())),
        corrected_(shifted_),
        found_(method.projected_.output_size()) {
    const Index m = method.system_->auxiliary_size();
    if (state_.v.size() != manifold_.tangent_dimension())
      state_.v = VectorXd::Zero(manifold_.tangent_dimension());
    if (state_.z.size() != m) state_.z = VectorXd::Zero(m);
    VectorXd& y = projector_.unknown();
    y.setZero();
    y.segment(n_, n_) = basis_.matrix().transpose() * state_.v;
    y.segment(method_.blocks_ * n_, m) = state_.z;
    near_ = state_.x;
    // A start at zero, as of a circuit at rest, has the size of its first step.
    project(state_.t, std::fabs(h_) * largest(state_.v));
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
      predictor_.predict(y);
    }
    const double* in[] = {y.data(), state_.x.data(), basis_.data(), directions_.data(),
                          &h_,      &state_.t};
    solve(solver_, in, largest(state_.x));
    method_.advance_.value(in, near_.data());
    if (!near_.allFinite())
      throw SolveError(SolveError::Reason::left_domain, state_.t, statistics_.steps + 1, {},
                       method_.name() + ": step " + std::to_string(statistics_.steps + 1) +
                           " leads to a state that is not finite.");
    round_off_projection_.apply(near_);
    if (!solver_.is_determined()) predictor_.limit_degree(Predictor::kUndetermined);
    predictor_.record(y);

    projector_.unknown() = y;
    const double t = origin_ + static_cast<double>(statistics_.steps + 1) * h_;
    project(t, largest(near_));
    record();
    accept(t);
  }

  void solve(StepSolver& solver, const double* const* in, double size) {
    const double scales[] = {size, size / std::fabs(h_), auxiliary_scale(largest(state_.z), size),
                             size};
    solver.solve(in, scales, start_, state_, statistics_);
  }

  // The point of M_f that P takes near_ to; leaves its unknowns in projector_, its basis and W
  // behind. Before, projector_ has those of the step. `size_besides`: of
  // coordinates, other than those of x_k.
  void project(double t, double size_besides) {
    VectorXd& y = projector_.unknown();
    y.head(n_).setZero();
    y.tail(d_).setZero();
    guess_ = near_;
    if (!shift_.is_empty()) {
      shift_.predict(shifted_);
      const double* in[] = {near_.data(), shifted_.data()};
      method_.shift_.value(in, guess_.data());
    }
    foreseen_ = guess_;
    double previous = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kMaxProjections; ++iteration) {
      move_basis(guess_, y);
      start_ = y;
      if (iteration == 0 && !end_.is_empty()) {
        end_.predict(y);
        y.head(n_).setZero();
      }
      aim(guess_, y, t);
      aimed_ = y;
      const double* in[] = {y.data(),           guess_.data(), basis_.data(),
                            directions_.data(), near_.data(),  &t};
      solve(projector_, in, std::max(largest(state_.x), size_besides));
      method_.projected_.value(in, found_.data());
      const double moved = largest(y.head(n_));
      const double size = largest(found_.head(guess_.size()));
      if (d_ == 0 || constant_directions_) return;
      // P does not depend on W once x no longer moves with it.
      if (iteration == 0) {
        const double distance = std::max(y.tail(d_).norm(), solver_.unknown().tail(d_).norm());
        const double change = std::max(moved, size * jet_change(aimed_, y));
        if (kSafety * turning_ * distance * change <= kTolerance * size) return;
      } else {
        const double contraction = moved / previous;
        if (moved <= 1e-15 * size || contraction * moved <= kTolerance * size ||
            (contraction >= 0.5 && moved < 1e-12 * (1.0 + size)))
          return;
      }
      guess_ = found_.head(guess_.size());
      y.head(n_).setZero();
      previous = moved;
    }
    throw SolveError(SolveError::Reason::diverged, state_.t, statistics_.steps + 1, {},
                     method_.name() + ": the projection onto M_f does not converge in step " +
                         std::to_string(statistics_.steps + 1) + "; the step is too large.");
  }

  // By how much ξ', … and z, … differ, relative to their size: W is computed with them.
  double jet_change(const VectorXd& from, const VectorXd& to) const {
    const auto change = [&](Index first, Index size) {
      const double moved = (to - from).segment(first, size).lpNorm<Eigen::Infinity>();
      return moved == 0.0 ? 0.0 : moved / to.segment(first, size).lpNorm<Eigen::Infinity>();
    };
    return std::max(change(n_, n_), rest_ == 0 ? 0.0 : change(2 * n_, rest_));
  }

  void move_basis(const VectorXd& x) {
    if (basis_.move_to(x)) return;
    predictor_.forget();
    end_.forget();
  }

  // The same vectors in the basis at x.
  void move_basis(const VectorXd& x, VectorXd& y) {
    if (n_ == manifold_.tangent_dimension()) return;
    vectors_.noalias() =
        basis_.matrix() * y.head(method_.blocks_ * n_).reshaped(n_, method_.blocks_);
    move_basis(x);
    y.head(method_.blocks_ * n_).reshaped(n_, method_.blocks_).noalias() =
        basis_.matrix().transpose() * vectors_;
  }

  // W at x, with columns near those of the last step, so that μ and the kept factorisations go on.
  void aim(const VectorXd& x, const VectorXd& y, double t) {
    if (d_ == 0 || (constant_directions_ && is_aimed_)) return;
    const double* in[] = {y.data(), x.data(), basis_.data(), &t};
    conormals_.move_to(in);
    if (method_.projector_->is_orthogonal()) {
      directions_ = conormals_.matrix();
    } else {
      directions_ = method_.projector_->directions(x, basis_.matrix(), conormals_.matrix());
      if (last_directions_.size() > 0) {
        turned_ = directions_ * (directions_.transpose() * last_directions_);
        make_orthonormal_(turned_, directions_);
      }
    }
    is_aimed_ = true;
  }

  // What the next projection starts from.
  void record() {
    VectorXd& y = projector_.unknown();
    if (!projector_.is_determined()) end_.limit_degree(Predictor::kUndetermined);
    y.head(n_).setZero();
    end_.record(y);
    // shifted_ led to foreseen_: to first order in what is left, this one leads to x.
    const double* in[] = {near_.data(), shifted_.data(), foreseen_.data(), found_.data()};
    method_.corrected_shift_.value(in, corrected_.data());
    shift_.record(corrected_);
  }

  void accept(double t) {
    const Index tangent = manifold_.tangent_dimension();
    if (d_ > 0 && !constant_directions_) {
      const double moved = (found_.head(state_.x.size()) - state_.x).norm();
      if (last_directions_.size() > 0 && moved > 1e-7 * largest(state_.x)) {
        const double turning = (directions_ - last_directions_).norm() / moved;
        turning_ = std::isfinite(turning_) ? std::max(turning, 0.9 * turning_) : turning;
      }
      last_directions_ = directions_;
      conormals_.keep();
    }
    state_.x = found_.head(state_.x.size());
    state_.v = found_.segment(state_.x.size(), tangent);
    state_.z = found_.tail(state_.z.size());
    state_.t = t;
    move_basis(state_.x);
  }

  const ConstrainFirst method_;  // its functions are shared, not copied
  const Manifold& manifold_;
  Index n_, d_, rest_;
  bool constant_directions_, is_aimed_ = false;
  StepSolver solver_, projector_;
  RoundOffProjection round_off_projection_;
  Predictor predictor_;  // of the unknowns of the step
  Predictor end_;        // of those of the projection
  Predictor shift_;      // of the vector at near_ that leads to x
  MovingBasis basis_;    // B at x_k
  MovingConormals conormals_;
  MatrixXd directions_, last_directions_, turned_;  // W, and that at x_k
  NearestOrthonormal make_orthonormal_;
  // ‖ΔW‖ / ‖Δx‖ of the last steps; unknown before the first
  double turning_ = std::numeric_limits<double>::infinity();
  MatrixXd vectors_;
  double origin_, h_;
  VectorXd start_, aimed_, near_, guess_, foreseen_, shifted_, corrected_, found_;
};

ConstrainFirst::ConstrainFirst(std::shared_ptr<const ImplicitSystem> system,
                               const ConstraintLadder& ladder,
                               std::shared_ptr<const DiscretizationMap> map,
                               std::shared_ptr<const Projector> projector, const Options& options)
    : system_(std::move(system)), map_(std::move(map)), projector_(std::move(projector)) {
  if (!system_ || !map_ || !projector_ || *map_->manifold() != *system_->manifold())
    throw std::invalid_argument(
        "ConstrainFirst::ConstrainFirst: the system, the map or the projector is missing, or the "
        "map is not on the manifold of the system.");
  check_ladder("ConstrainFirst::ConstrainFirst", *system_, ladder);
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
  const ExprVector equations = local.nonzero_equations();
  const auto [blocks, orders] = contained_jets(local, equations);
  blocks_ = blocks;
  std::vector<ExprVector> parts(local.xi.begin(), local.xi.begin() + blocks);
  parts.insert(parts.end(), local.z.begin(), local.z.begin() + orders);
  const ExprVector jets = join(parts);
  auxiliaries_ = jets.size() - blocks_ * n;
  const ExprVector y = join({jets, mu});
  const ExprVector basis_entries = basis_parameters(M, basis);

  const bool aims_once = n == M.tangent_dimension() &&
                         (codimension_ == 0 || projector_->has_constant_directions(codimension_));
  conormals_ = MovingConormals::trace(graph, equations, jets, n, codimension_,
                                      {{"x0", x0}, {"basis", basis_entries}, {"t", t}},
                                      aims_once ? Backend::interpreter : options.backend);

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
  const ExprVector s = graph.variables("s", M.tangent_dimension());
  shift_ = Function("shift", {{"near", near}, {"s", s}},
                    M.retract(near, ExprVector(M.tangent_projector(near) * s)),
                    {.backend = options.backend});
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  corrected_shift_ = Function("corrected shift", {{"near", near}, {"s", s}, {"x0", x0}, {"x", x}},
                              M.tangent_projector(near) * s + M.coframe(near) * ExprVector(x - x0),
                              {.backend = options.backend});
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
