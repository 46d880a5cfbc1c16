#include "courant/integrators/constrain_first.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/message.hpp"
#include "courant/core/qr_decomposition.hpp"
#include "courant/integrators/constrain_first_trace.hpp"
#include "courant/integrators/moving_basis.hpp"
#include "courant/integrators/moving_conormals.hpp"
#include "courant/integrators/moving_directions.hpp"
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

// P takes the end of a step to the point of M_f nearby: to a distance below that part of the step.
// Solutions farther away are other ones, which an old factorisation can lead to.
constexpr double kNearby = 0.5;
// Of the coordinates, a part that is no distance.
constexpr double kNoDistance = 1e-10;

// W if it is the same at every x, as for momenta that positions determine; empty otherwise.
MatrixXd fixed_directions(const Manifold& M, const Projector& projector,
                          const ConstraintLadder& ladder) {
  const Index n = M.dimension(), d = n - ladder.degrees_of_freedom;
  if (d == 0 || n != M.tangent_dimension() || !projector.has_constant_directions(d)) return {};
  const MatrixXd W = projector.directions(ladder.point.x, LinearMap<double>::identity(n),
                                          orthonormalized(ladder.conormals().transpose()));
  // Unit vectors where their span is the same: formulas become simpler.
  constexpr double round_off = 1e-12;
  const MatrixXd onto = W * W.transpose(), rounded = onto.array().round();
  if ((onto - rounded).norm() > round_off) return W;
  MatrixXd units(n, d);
  Index column = 0;
  for (Index i = 0; i < n; ++i)
    if (rounded(i, i) == 1.0) units.col(column++) = VectorXd::Unit(n, i);
  return units;
}

}  // namespace

class ConstrainFirst::Trajectory final : public Stepper {
 public:
  explicit Trajectory(const ConstrainFirst& method)
      : Stepper(method.name(), method.system()),
        method_(method),
        n_(manifold().dimension()),
        d_(method.codimension_),
        rest_((method.blocks_ - 2) * n_ + method.auxiliaries_),
        constant_directions_(method.fixed_directions_.size() > 0),
        solver_(method.equations_, {n_, n_, rest_, d_}, method.name(), method.whole_,
                {.displacements = n_, .shifts = d_, .h = 4}),
        projector_(method.projection_, {n_, n_, rest_, d_}, method.name() + " (projection)"),
        round_off_projection_(method.constraint_),
        predictor_(predicted_groups(), solver_.predicted()),
        end_(constant_directions_ ? Predictor(predicted_groups(), projector_.predicted())
                                  : Predictor(predicted_groups())),
        shift_({manifold().tangent_dimension()}),
        basis_(manifold(), method.basis_),
        conormals_(method.conormals_, n_, d_),
        directions_(*method_.projector_, n_, d_),
        jets_(VectorXd::Zero(solver_.unknown().size())),
        start_(jets_),
        near_(manifold().ambient_dimension()),
        guess_(near_.size()),
        shifted_(VectorXd::Zero(manifold().tangent_dimension())),
        corrected_(shifted_),
        advanced_(method.advance_.output_size()),
        found_(method.projected_.output_size()) {}

 private:
  // Onto M_f, where (v, z) and the jets are found.
  void do_prepare(State& state, double h) override {
    if (!basis_.move_to(state.x)) forget_motion();
    VectorXd& y = projector_.unknown();
    y = jets_;
    basis_.coordinates_of(state.v, y.segment(n_, n_));
    y.segment(method_.blocks_ * n_, state.z.size()) = state.z;
    near_ = state.x;
    project(state, {state.t, h}, state.t, 0.0, false);
    accept(near_);
    take(state);
  }

  void do_step(const State& before, double h, State& after) override {
    VectorXd& y = solver_.unknown();
    const auto begin = [&] {
      y = jets_;
      y.head(n_) = 0.5 * h * jets_.segment(n_, n_);
    };
    if (predictor_.is_empty())
      begin();
    else
      predictor_.predict(y);
    solver_.settle(2 * n_);
    const double* in[] = {y.data(), before.x.data(), basis_.data(), directions_.matrix().data(),
                          &h,       &before.t};
    const StepSolver::Attempt attempt{before.t, h};
    solver_.solve_connected(in, scales(before, h).data(), begin, attempt, statistics_);
    method_.advance_.value(in, advanced_.data());
    const Index N = before.x.size();
    near_ = advanced_.head(N);
    if (!near_.allFinite())
      throw SolveError(SolveError::Reason::left_domain, method(), before.t, h,
                       "leads to a state that is not finite.");
    round_off_projection_.apply(near_);

    projector_.unknown() = y;
    try {
      project(before, attempt, after.t, y.tail(d_).norm(), true);
    } catch (const std::domain_error& error) {
      throw SolveError(SolveError::Reason::singular, method(), before.t, h,
                       "cannot be projected: " + without_place(error.what()));
    }
    after.v.resize(before.v.size());
    after.z.resize(before.z.size());
    take(after);
  }

  void do_keep(const State& before, const State&) override {
    if (!solver_.is_determined()) predictor_.limit_degree(Predictor::kUndetermined);
    predictor_.record(solver_.unknown());
    solver_.keep();
    record();
    accept(before.x);
    stage_ = advanced_.tail(before.x.size() + before.v.size());
    stage_z_ = solver_.unknown().segment(method_.blocks_ * n_, before.z.size());
  }

  void do_stage(Step& step) const override {
    step.stage.t = step.before.t + method_.map_->stage_time() * step.h;
    step.stage.x = stage_.head(step.before.x.size());
    step.stage.v = stage_.tail(step.before.v.size());
    step.stage.z = stage_z_;
  }

  void do_discard() override {
    basis_.discard();
    conormals_.discard();
    directions_.discard();
    is_turned_ = false;
  }

  void do_change_step() override { forget_motion(); }

  void do_forget() override {
    solver_.forget();
    projector_.forget();
    forget_motion();
    basis_.forget();
    conormals_.forget();
    directions_.forget();
    is_turned_ = false;
    turning_ = std::numeric_limits<double>::infinity();
    jets_.setZero();
    shifted_.setZero();
  }

  Motion do_motion() const override { return solver_.motion(manifold()); }
  void do_expect(const Motion& motion) override { solver_.expect(motion); }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(method_);
  }

  std::vector<Index> predicted_groups() const {
    const Index tangent = method_.blocks_ * n_;
    return {tangent, solver_.unknown().size() - tangent};
  }

  void forget_motion() {
    predictor_.forget();
    end_.forget();
    shift_.forget();
  }

  // Of the groups of unknowns.
  // `besides`: a size of coordinates other than those of `before`.
  static std::array<double, 4> scales(const State& before, double h, double besides = 0.0) {
    // A start at zero, as of a circuit at rest, has the size of its first step.
    const double given = std::max(largest(before.x), besides);
    const double size = given > 0.0 ? given : std::fabs(h) * largest(before.v);
    return {size, size / std::fabs(h), auxiliary_scale(largest(before.z), size), size};
  }

  // The point of M_f that P takes near_ to; leaves its unknowns in projector_, its basis and W
  // behind. Before, projector_ has those of the step.
  // `far`: how far the step was from M_f; `goes_on`: whether this is a step like the last ones.
  void project(const State& before, const StepSolver::Attempt& attempt, double t, double far,
               bool goes_on) {
    VectorXd& y = projector_.unknown();
    y.head(n_).setZero();
    y.tail(d_).setZero();
    guess_ = near_;
    if (goes_on && !shift_.is_empty()) {
      shift_.predict(shifted_);
      const double* in[] = {near_.data(), shifted_.data()};
      method_.shift_.value(in, guess_.data());
    }
    foreseen_ = guess_;
    double previous = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kMaxProjections; ++iteration) {
      move_basis(guess_, y);
      start_ = y;
      if (iteration == 0 && goes_on && !end_.is_empty()) {
        end_.predict(y);
        y.head(n_).setZero();
        projector_.settle(2 * n_);
      }
      aim(guess_, y, t);
      aimed_ = y;
      const double* in[] = {y.data(),           guess_.data(), basis_.data(),
                            directions_.matrix().data(), near_.data(),  &t};
      const auto sizes = scales(before, attempt.h, largest(near_));
      const auto begin = [&] { y = start_; };
      const auto lands_nearby = [&] {
        projector_.solve(in, sizes.data(), begin, attempt, statistics_);
        method_.projected_.value(in, found_.data());
        return !goes_on || is_nearby(before, sizes[0]);
      };
      if (!lands_nearby()) {
        ++statistics_.failures;
        projector_.forget();
        begin();
        if (!lands_nearby())
          throw SolveError(SolveError::Reason::disconnected, method(), attempt.time, attempt.h,
                           "is too large: the projection onto M_f leads farther than half the "
                           "step.");
      }
      const double moved = largest(y.head(n_));
      const double size = largest(found_.head(guess_.size()));
      if (d_ == 0 || constant_directions_) return;
      // P does not depend on W once x no longer moves with it. Where steps begin, x moves with W not
      // at all; but the next one begins along W.
      if (iteration == 0) {
        const double distance = std::max(y.tail(d_).norm(), far);
        const double change = std::max(moved, size * jet_change(aimed_, y));
        if (goes_on && kSafety * turning_ * distance * change <= kTolerance * size) return;
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
    throw SolveError(SolveError::Reason::diverged, method(), attempt.time, attempt.h,
                     "is too large: the projection onto M_f does not converge.");
  }

  // Whether what was found is not far from near_, next to the step from `before` and to coordinates of
  // that size; nor ξ from guess_, which may have gone around a compact space.
  bool is_nearby(const State& before, double size) const {
    const auto found = found_.head(near_.size());
    const double step = (near_ - before.x).lpNorm<Eigen::Infinity>();
    const double nearby = std::max(kNearby * step, kNoDistance * size);
    const double foreseen = (guess_ - near_).lpNorm<Eigen::Infinity>();
    return (found - near_).lpNorm<Eigen::Infinity>() <= nearby &&
           largest(projector_.unknown().head(n_)) <= nearby + 2.0 * foreseen;
  }

  // By how much ξ', … and z, … differ, relative to their size: W is computed with them.
  double jet_change(const VectorXd& from, const VectorXd& to) const {
    const auto change = [&](Index first, Index size) {
      const double moved = (to - from).segment(first, size).lpNorm<Eigen::Infinity>();
      return moved == 0.0 ? 0.0 : moved / to.segment(first, size).lpNorm<Eigen::Infinity>();
    };
    return std::max(change(n_, n_), rest_ == 0 ? 0.0 : change(2 * n_, rest_));
  }

  // The same vectors in the basis at x.
  void move_basis(const VectorXd& x, VectorXd& y) {
    if (n_ == manifold().tangent_dimension()) return;
    vectors_.noalias() =
        basis_.map().entries() * y.head(method_.blocks_ * n_).reshaped(n_, method_.blocks_);
    if (!basis_.move_to(x)) is_turned_ = true;
    y.head(method_.blocks_ * n_).reshaped(n_, method_.blocks_).noalias() =
        basis_.map().entries().transpose() * vectors_;
  }

  // W at x, with columns near those of the last step, so that μ and the kept factorisations go on.
  void aim(const VectorXd& x, const VectorXd& y, double t) {
    if (d_ == 0 || constant_directions_) return;
    const double* in[] = {y.data(), x.data(), basis_.data(), &t};
    conormals_.move_to(in);
    directions_.move_to(x, basis_.map(), conormals_.matrix());
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

  // What the projection found, as a state.
  void take(State& state) const {
    const Index N = near_.size();
    state.x = found_.head(N);
    state.v = found_.segment(N, state.v.size());
    state.z = found_.tail(state.z.size());
  }

  // The next step begins where the projection ended; the last one began at x.
  void accept(const VectorXd& x) {
    if (d_ > 0 && !constant_directions_) {
      const double moved = (found_.head(x.size()) - x).norm();
      if (directions_.is_kept() && moved > 1e-7 * largest(x)) {
        const double turning = (directions_.matrix() - directions_.kept()).norm() / moved;
        turning_ = std::isfinite(turning_) ? std::max(turning, 0.9 * turning_) : turning;
      }
      directions_.keep();
      conormals_.keep();
    }
    if (!basis_.move_to(found_.head(x.size()))) is_turned_ = true;
    basis_.keep();
    if (is_turned_) forget_motion();
    is_turned_ = false;
    jets_ = projector_.unknown();
    jets_.head(n_).setZero();
    jets_.tail(d_).setZero();
  }

  const ConstrainFirst method_;  // its functions are shared, not copied
  Index n_, d_, rest_;
  bool constant_directions_;
  bool is_turned_ = false;  // the basis was made afresh
  StepSolver solver_, projector_;
  RoundOffProjection round_off_projection_;
  Predictor predictor_;  // of the unknowns of the step
  Predictor end_;        // of those of the projection; of all of them where W depends on them
  Predictor shift_;      // of the vector at near_ that leads to x
  MovingBasis basis_;    // B at x_k
  MovingConormals conormals_;
  MovingDirections directions_;  // W
  // ‖ΔW‖ / ‖Δx‖ of the last steps; unknown before the first
  double turning_ = std::numeric_limits<double>::infinity();
  MatrixXd vectors_;
  VectorXd jets_;  // ξ', … and z, … at x_k; ξ and μ are zero
  VectorXd start_, aimed_, near_, guess_, foreseen_, shifted_, corrected_, advanced_, found_;
  VectorXd stage_, stage_z_;  // (x̄, v) and z of the last step that stands
};

ConstrainFirst::ConstrainFirst(std::shared_ptr<const ImplicitSystem> system,
                               const ConstraintLadder& ladder,
                               std::shared_ptr<const DiscretizationMap> map,
                               std::shared_ptr<const Projector> projector, const Options& options)
    : Integrator(std::move(system)), map_(std::move(map)), projector_(std::move(projector)) {
  if (!map_ || !projector_ || *map_->manifold() != *this->system()->manifold())
    throw std::invalid_argument(
        "ConstrainFirst::ConstrainFirst: the system, the map or the projector is missing, or the "
        "map is not on the manifold of the system.");
  if (ladder.verdict != Verdict::regular && ladder.verdict != Verdict::gauge)
    throw std::invalid_argument("ConstrainFirst::ConstrainFirst: the ladder's verdict is " +
                                to_string(ladder.verdict) + "; expected regular or gauge. " +
                                ladder.reason);
  check_ladder("ConstrainFirst::ConstrainFirst", *this->system(), ladder);
  ladder_ = std::make_shared<const ConstraintLadder>(ladder);
  const Manifold& M = *this->system()->manifold();
  codimension_ = M.dimension() - ladder.degrees_of_freedom;
  gauge_dimension_ = ladder.gauge_dimension;
  differentiations_ = ladder.differentiations;
  fixed_directions_ = fixed_directions(M, *projector_, ladder);

  const Trace trace(*this);
  const Backend backend = options.backend.together();
  const Function::Options compiled = {.backend = backend};
  blocks_ = trace.blocks;
  auxiliaries_ = trace.auxiliaries;
  equations_ = trace.step.compile(backend);
  if (!trace.step.is_affine())
    whole_ = equations_.is_reduced() ? trace.step.whole() : equations_.left();
  advance_ = Function("advance", trace.step.inputs, trace.advanced, compiled);
  projection_ = trace.projection.compile(backend);
  projected_ = Function("projected", trace.projection.inputs, trace.projected, compiled);
  shift_ = Function("shift", {{"near", trace.near}, {"s", trace.s}}, trace.shifted, compiled);
  corrected_shift_ = Function(
      "corrected shift", {{"near", trace.near}, {"s", trace.s}, {"x0", trace.x0}, {"x", trace.x}},
      trace.corrected, compiled);
  const bool is_never_aimed = codimension_ == 0 || fixed_directions_.size() > 0;
  conormals_ = MovingConormals::trace(
      trace.step.graph, trace.constraints, trace.jets, M.dimension(), codimension_,
      {{"x0", trace.x0}, {"basis", trace.basis_entries}, {"t", trace.t}},
      is_never_aimed ? Backend::interpreter : backend);
  basis_ = MovingBasis::projection(M, backend);
  constraint_ = RoundOffProjection::constraint(M, backend);
  backend.compile();
}

std::vector<StepFormulas> ConstrainFirst::do_formulas() const {
  const Trace trace(*this);
  return {trace.step, trace.projection};
}

StepProgram ConstrainFirst::program() const {
  const Manifold& M = *system()->manifold();
  check_program_space(name(), M);
  if (codimension_ > 0 && fixed_directions_.size() == 0)
    throw std::invalid_argument(
        name() +
        " projects along directions that change from point to point, which are not among the "
        "formulas of a step; expected the momentum projector, or a system without constraints");
  const Trace trace(*this);
  StepProgram program{.method = name()};
  program.solve = {.formulas = trace.step,
                   .is_affine = trace.step.is_affine(),
                   .tangent_blocks = trace.blocks,
                   .displacements = M.dimension(),
                   .auxiliaries = trace.auxiliaries,
                   .advanced = trace.advanced,
                   .effort = ExprVector(0),
                   .stage_inputs = {},
                   .stage = ExprVector(0),
                   .stage_time = map_->stage_time(),
                   .stage_is_advanced = true,
                   .projection = StepProgram::Solve::Projection{
                       .formulas = trace.projection,
                       .shifts = codimension_,
                       .projected = trace.projected,
                       .shift_inputs = {{"near", trace.near}, {"s", trace.s}},
                       .correction_inputs =
                           {{"near", trace.near}, {"s", trace.s}, {"x0", trace.x0}, {"x", trace.x}},
                       .shifted = trace.shifted,
                       .corrected = trace.corrected}};
  return program;
}

std::unique_ptr<Stepper> ConstrainFirst::do_stepper() const {
  return std::make_unique<Trajectory>(*this);
}

}  // namespace courant
