#include "courant/integrators/methods/constrain_first.hpp"

#include "courant/core/linear/pairs.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/methods/constrain_first_functions.hpp"
#include "courant/integrators/methods/constrain_first_projection.hpp"
#include "courant/integrators/methods/constrain_first_trace.hpp"
#include "courant/integrators/step/round_off_projection.hpp"
#include "courant/integrators/step/step_program.hpp"

namespace courant {

namespace {

// The method that solves the equations which follow from others too.
ConstrainFirst with_all_equations(const ConstrainFirstScheme& scheme) {
  return {scheme.system,
          *scheme.ladder,
          scheme.map,
          scheme.projector,
          {.backend = Backend::interpreter, .keeps_all_equations = true}};
}

}  // namespace

class ConstrainFirst::Trajectory final : public Stepper {
 public:
  explicit Trajectory(std::shared_ptr<const ConstrainFirstFunctions> functions)
      : Stepper(functions->scheme.name(), functions->scheme.system),
        shared_(std::move(functions)),
        functions_(*shared_),
        n_(manifold().dimension()),
        d_(functions_.scheme.codimension()),
        solver_(functions_.equations,
                {n_, n_, (functions_.blocks - 2) * n_ + functions_.auxiliaries, d_},
                functions_.scheme.name(), functions_.whole,
                {.displacements = n_, .multipliers = d_, .h = 4}),
        predictor_(ConstrainFirstProjection::predicted_groups(functions_, solver_.unknown().size()),
                   solver_.predicted()),
        round_off_projection_(functions_.constraint),
        basis_(manifold(), functions_.basis),
        projection_(functions_, basis_),
        near_(manifold().ambient_dimension()),
        advanced_(functions_.advance.output_size()),
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
    const bool leaves_some_out = functions_.redundant.output_size() > 0;
    try {
      if (!basis_.move_to(state.x)) forget_motion();
      VectorXd& y = projection_.unknown();
      y = projection_.jets();
      basis_.coordinates_of(state.v, y.segment(n_, n_));
      y.segment(functions_.blocks * n_, state.z.size()) = state.z;
      for (const auto& [i, value] : functions_.held_z) y[functions_.blocks * n_ + i] = value;
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
    if (functions_.redundant.output_size() == 0) return step_without(before, h, after);
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
    solver_.solve_connected(in, ConstrainFirstProjection::scales(before, h).data(), begin, attempt,
                            statistics_);
    functions_.advance.value(in.data(), advanced_.data());
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
    copy_pairs(solver_.unknown().data() + functions_.blocks * n_, stage_z_.size(), stage_z_.data());
  }

  void do_stage(Step& step) const override {
    if (is_with_all_) {
      step.stage = with_all_->last().stage;
      return;
    }
    step.stage.t = step.before.t + functions_.scheme.map->stage_time() * step.h;
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
    return std::make_unique<Trajectory>(shared_);
  }

  // Of all equations, for steps after which those that are left out do not hold: where those that are left have become
  // dependent, or where some have ceased to follow.
  Stepper& with_all() {
    if (!with_all_) {
      with_all_ = with_all_equations(functions_.scheme).stepper();
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

  std::shared_ptr<const ConstrainFirstFunctions> shared_;
  const ConstrainFirstFunctions& functions_;
  Index n_, d_;
  StepSolver solver_;
  Predictor predictor_;  // of the unknowns of the step
  RoundOffProjection round_off_projection_;
  TransportedFrame basis_;  // B at x_k
  ConstrainFirstProjection projection_;
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
      functions_(std::make_shared<const ConstrainFirstFunctions>(
          ConstrainFirstScheme(this->system(), ladder, std::move(map), std::move(projector),
                               options.keeps_all_equations),
          options.backend)) {}

std::string ConstrainFirst::name() const { return functions_->scheme.name(); }

int ConstrainFirst::order() const { return functions_->scheme.map->order(); }

bool ConstrainFirst::is_symmetric() const {
  return functions_->scheme.gauge_dimension() == 0 && functions_->scheme.map->is_symmetric();
}

std::optional<bool> ConstrainFirst::is_symplectic() const {
  const ConstrainFirstScheme& scheme = functions_->scheme;
  if (scheme.codimension() == 0 && scheme.map->is_symplectic().value_or(false) &&
      system()->is_lagrangian().value_or(false))
    return true;
  return std::nullopt;
}

bool ConstrainFirst::is_native() const { return functions_->equations.is_native(); }

std::vector<StepFormulas> ConstrainFirst::do_formulas() const {
  const ConstrainFirstTrace trace(functions_->scheme, functions_->omitted);
  return {trace.step, trace.projection};
}

StepProgram ConstrainFirst::program() const {
  // A program does not look at what steps do without.
  const ConstrainFirstScheme& scheme = functions_->scheme;
  if (!functions_->omitted.redundant.empty()) return with_all_equations(scheme).program();
  const Manifold& M = scheme.manifold();
  const ConstrainFirstTrace trace(functions_->scheme, functions_->omitted);
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
                   .stage_time = scheme.map->stage_time(),
                   .stage_is_advanced = true,
                   .projection = StepProgram::Solve::Projection{
                       .formulas = trace.projection,
                       .multipliers = scheme.codimension(),
                       .projected = trace.projected,
                       .shift_inputs = {{"near", trace.near}, {"s", trace.s}},
                       .correction_inputs =
                           {{"near", trace.near}, {"s", trace.s}, {"x0", trace.x0}, {"x", trace.x}},
                       .shifted = trace.shifted,
                       .corrected = trace.corrected}};
  if (!scheme.has_fixed_directions())
    program.solve->projection->turning = StepProgram::Solve::Projection::Turning{
        .conormals = trace.conormals(),
        .references = functions_->references,
        .span = scheme.projector->span_formulas(M, scheme.codimension()),
        .is_always_complement = scheme.projector->is_always_complement()};
  return program;
}

std::unique_ptr<Stepper> ConstrainFirst::do_stepper() const {
  return std::make_unique<Trajectory>(functions_);
}

}  // namespace courant
