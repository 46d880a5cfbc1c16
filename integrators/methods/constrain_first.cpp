#include "courant/integrators/methods/constrain_first.hpp"

#include <cmath>
#include <stdexcept>

#include "courant/core/linear/pairs.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/methods/constrain_first_projection.hpp"
#include "courant/integrators/methods/constrain_first_trace.hpp"
#include "courant/integrators/step/round_off_projection.hpp"

namespace courant {
namespace {

// W if it is the same at every x, as for momenta that positions determine; empty otherwise.
MatrixXd fixed_directions(const Manifold& M, const Projector& projector,
                          const ConstraintLadder& ladder) {
  const Index n = M.dimension(), d = n - ladder.degrees_of_freedom;
  if (d == 0 || n != M.tangent_dimension() || !projector.has_constant_directions(d)) return {};
  MatrixXd W =
      projector.directions(ladder.point.x, LinearMap<double>::identity(n),
                           orthonormalized(ladder.conormals().transpose()), ladder.point.t);
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
        solver_(method.equations_, {n_, n_, (method.blocks_ - 2) * n_ + method.auxiliaries_, d_},
                method.name(), method.whole_, {.displacements = n_, .shifts = d_, .h = 4}),
        predictor_(Projection::predicted_groups(method, solver_.unknown().size()),
                   solver_.predicted()),
        round_off_projection_(method.constraint_),
        basis_(manifold(), method.basis_),
        projection_(method_, basis_),
        near_(manifold().ambient_dimension()),
        advanced_(method.advance_.output_size()),
        kept_(advanced_) {}

 private:
  // Onto M_f, where (v, z) and the jets are found.
  void do_prepare(State& state, double h) override {
    State prepared = state;
    is_with_all_ = !is_prepared_without(prepared, h);
    if (is_with_all_)
      with_all().prepare(state, h);
    else
      state = prepared;
  }

  // Without redundant equations, and false where they do not hold then.
  bool is_prepared_without(State& state, double h) {
    const bool leaves_some_out = method_.redundant_.output_size() > 0;
    try {
      if (!basis_.move_to(state.x)) forget_motion();
      VectorXd& y = projection_.unknown();
      y = projection_.jets();
      basis_.coordinates_of(state.v, y.segment(n_, n_));
      y.segment(method_.blocks_ * n_, state.z.size()) = state.z;
      for (const auto& [i, value] : method_.held_z_) y[method_.blocks_ * n_ + i] = value;
      const VectorXd x = state.x;
      const VectorXd no_shift = VectorXd::Zero(d_);
      projection_.project(x, {state, {state.t, h}, state.t, no_shift, false}, statistics_);
      if (leaves_some_out && !projection_.redundant_hold(state, h)) return false;
      accept(x);
      projection_.take(state);
      return true;
    } catch (const SolveError&) {
      if (!leaves_some_out) throw;
    } catch (const std::domain_error&) {
      if (!leaves_some_out) throw;
    }
    return false;
  }

  bool do_take_over(const Stepper& other) override {
    const auto* before = dynamic_cast<const Trajectory*>(&other);
    if (before == nullptr || is_with_all_ || before->is_with_all_) return false;
    const bool goes_on = basis_.take_over(before->basis_);
    if (!goes_on) predictor_.forget();
    projection_.take_over(before->projection_, goes_on);
    return true;
  }

  void do_accompany(std::span<const Companion> companions) override {
    for (const Companion& of : companions) {
      const auto& other = dynamic_cast<const Trajectory&>(*of.stepper);
      if (is_with_all_ || other.is_with_all_) continue;
      if (of.at_stage != 0.0)
        predictor_.learn_from(other.predictor_, projection_.times_of(of.at_stage, of.ratio, n_));
      projection_.learn_from(other.projection_, of);
    }
  }

  void do_step(const State& before, double h, State& after) override {
    if (method_.redundant_.output_size() == 0) return step_without(before, h, after);
    steps_with_all_ = false;
    State state = before;
    try {
      if (!is_with_all_ || takes_up_without(state, h)) {
        step_without(state, h, after);
        if (projection_.redundant_hold(before, h)) return;
      }
    } catch (const SolveError&) {
    }
    do_discard();
    steps_with_all_ = true;
    ++statistics_.failures;
    Stepper& all = with_all();
    const SolverStatistics work = all.statistics();
    state = before;
    all.step(state, h, after.t);
    statistics_.add_work(work, all.statistics());
    after = state;
  }

  void step_without(const State& before, double h, State& after) {
    VectorXd& y = solver_.unknown();
    const auto begin = [&] {
      y = projection_.jets();
      y.head(n_) = 0.5 * h * y.segment(n_, n_);
    };
    if (predictor_.is_empty() || solver_.needs_start()) begin();
    if (!predictor_.is_empty()) {
      if (!solver_.is_determined()) start_ = y;
      predictor_.predict(y);
      solver_.settle(start_);
    }
    const Inputs in(
        y.data(), {before.x.data(), basis_.data(), projection_.directions().data(), &h, &before.t});
    const StepSolver::Attempt attempt{before.t, h};
    solver_.solve_connected(in, Projection::scales(before, h).data(), begin, attempt, statistics_);
    method_.advance_.value(in.data(), advanced_.data());
    copy_pairs(advanced_.data(), near_.size(), near_.data());
    if (!are_finite(near_.data(), near_.size()))
      throw SolveError(SolveError::Reason::left_domain, method(), before.t, h,
                       "leads to a state that is not finite.");
    round_off_projection_.apply(near_);

    projection_.begin_with(y);
    try {
      projection_.project(near_, {before, attempt, after.t, y.tail(d_), true}, statistics_);
    } catch (const std::domain_error& error) {
      throw SolveError(SolveError::Reason::singular, method(), before.t, h,
                       "cannot be projected: " + without_place(error.what()));
    }
    after.v.resize(before.v.size());
    after.z.resize(before.z.size());
    projection_.take(after);
  }

  void do_keep(const State& before, const State&) override {
    is_with_all_ = steps_with_all_;
    if (is_with_all_) return;
    if (!solver_.is_determined()) predictor_.limit_degree(Predictor::kUndetermined);
    predictor_.record(solver_.unknown());
    solver_.keep();
    projection_.record();
    accept(before.x);
    kept_.swap(advanced_);
    stage_z_.resize(before.z.size());
    copy_pairs(solver_.unknown().data() + method_.blocks_ * n_, stage_z_.size(), stage_z_.data());
  }

  void do_stage(Step& step) const override {
    if (is_with_all_) {
      step.stage = with_all_->last().stage;
      return;
    }
    step.stage.t = step.before.t + method_.map_->stage_time() * step.h;
    const Index N = step.before.x.size();
    step.stage.x = kept_.segment(N, N);
    step.stage.v = kept_.tail(step.before.v.size());
    step.stage.z = stage_z_;
  }

  void do_discard() override {
    basis_.discard();
    projection_.discard();
  }

  void do_change_step() override { forget_motion(); }

  void do_forget() override {
    is_with_all_ = steps_with_all_ = false;
    if (with_all_) with_all_->forget();
    solver_.forget();
    predictor_.forget();
    basis_.forget();
    projection_.forget();
  }

  Motion do_motion() const override {
    return is_with_all_ ? with_all_->motion() : solver_.motion(manifold());
  }
  void do_expect(const Motion& motion) override { solver_.expect(motion); }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(method_);
  }

  // Of all equations, for steps after which those that are left out do not hold: where those that are left have become
  // dependent, or where some have ceased to follow.
  Stepper& with_all() {
    if (!with_all_) {
      const ConstrainFirst all(method_.system(), *method_.ladder_, method_.map_, method_.projector_,
                               {.backend = Backend::interpreter, .keeps_all_equations = true});
      with_all_ = all.stepper();
    }
    return *with_all_;
  }

  // After a step with all equations, from where that ended.
  bool takes_up_without(State& state, double h) {
    solver_.forget();
    basis_.forget();
    projection_.forget();
    predictor_.forget();
    return is_prepared_without(state, h);
  }

  void forget_motion() {
    predictor_.forget();
    projection_.forget_motion();
  }

  // The next step begins where the projection ended; the last one began at x.
  void accept(const VectorXd& x) {
    if (!projection_.accept(x)) predictor_.forget();
  }

  const ConstrainFirst method_;  // its functions are shared, not copied
  Index n_, d_;
  StepSolver solver_;
  Predictor predictor_;  // of the unknowns of the step
  RoundOffProjection round_off_projection_;
  MovingBasis basis_;  // B at x_k
  Projection projection_;
  VectorXd start_;  // what the state alone predicts
  VectorXd near_, advanced_;
  VectorXd kept_, stage_z_;            // what was advanced, and z, of the last step that stands
  std::unique_ptr<Stepper> with_all_;  // null before it is needed
  bool is_with_all_ = false;           // the last step that stands, or what was prepared, is its
  bool steps_with_all_ = false;        // the step that was just made is
};

ConstrainFirst::ConstrainFirst(std::shared_ptr<const ImplicitSystem> system,
                               const ConstraintLadder& ladder,
                               std::shared_ptr<const DiscretizationMap> map,
                               std::shared_ptr<const Projector> projector, const Options& options)
    : Integrator(std::move(system)),
      map_(std::move(map)),
      projector_(std::move(projector)),
      keeps_all_equations_(options.keeps_all_equations) {
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
  omitted_ = trace.omitted;
  held_z_ = trace.held_z;
  const Backend backend = options.backend.together();
  const Function::Options compiled = {.backend = backend};
  blocks_ = trace.blocks;
  auxiliaries_ = trace.auxiliaries;
  equations_ = trace.step.compile(backend);
  whole_ = trace.step.followed(equations_);
  advance_ = Function("advance", trace.step.inputs, trace.advanced, compiled);
  projection_ = trace.projection.compile(backend);
  projected_ = Function("projected", trace.projection.inputs, trace.projected, compiled);
  if (engine_of(backend) && trace.redundant.size() > 0)
    throw std::invalid_argument(
        "ConstrainFirst::ConstrainFirst: the system has equations that follow from others, which "
        "steps "
        "may have to be solved with by least squares; the engine solves as many equations as "
        "unknowns.");
  redundant_ = Function("redundant equations", trace.projection.inputs, trace.redundant,
                        {.differentiate = {"y"}, .backend = backend});
  shift_ = Function("shift", {{"near", trace.near}, {"s", trace.s}}, trace.shifted, compiled);
  corrected_shift_ = Function(
      "corrected shift", {{"near", trace.near}, {"s", trace.s}, {"x0", trace.x0}, {"x", trace.x}},
      trace.corrected, compiled);
  conormals_ = {trace.conormals(), has_fixed_directions() ? Backend::interpreter : backend};
  if (!has_fixed_directions()) {
    MatrixXd conormals = ladder.conormals().transpose();
    if (const VectorXd sizes = projector_->conormal_sizes(); sizes.size() > 0)
      conormals = (sizes.cwiseInverse().asDiagonal() * conormals).eval();
    references_ = MovingConormals::references(orthonormalized(conormals));
    span_ = Function("directions", projector_->span_formulas(M, codimension_), compiled);
  }
  basis_ = MovingBasis::projection(M, backend);
  constraint_ = RoundOffProjection::constraint(M, backend);
  backend.compile();
}

std::vector<StepFormulas> ConstrainFirst::do_formulas() const {
  const Trace trace(*this);
  return {trace.step, trace.projection};
}

StepProgram ConstrainFirst::program() const {
  // A program does not look at what steps do without.
  if (!omitted_->redundant.empty())
    return ConstrainFirst(system(), *ladder_, map_, projector_,
                          {.backend = Backend::interpreter, .keeps_all_equations = true})
        .program();
  const Manifold& M = *system()->manifold();
  const Trace trace(*this);
  StepProgram program{.method = name()};
  program.solve = {.formulas = trace.step,
                   .space = SpaceFormulas(M),
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
  if (!has_fixed_directions())
    program.solve->projection->turning = StepProgram::Solve::Projection::Turning{
        .conormals = trace.conormals(),
        .references = references_,
        .span = projector_->span_formulas(M, codimension_),
        .is_always_complement = projector_->is_always_complement()};
  return program;
}

std::unique_ptr<Stepper> ConstrainFirst::do_stepper() const {
  return std::make_unique<Trajectory>(*this);
}

}  // namespace courant
