#include "courant/integrators/methods/verlet_steps.hpp"

#include <utility>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/methods/verlet_halves.hpp"
#include "courant/integrators/step/predictor.hpp"
#include "courant/integrators/step/round_off_projection.hpp"
#include "courant/integrators/step/step_solver.hpp"
#include "courant/integrators/step/transported_frame.hpp"

namespace courant {

// Both halves in one solve.
class VerletSteps::Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const VerletSteps> functions, const std::string& name,
             const std::shared_ptr<const ImplicitSystem>& system)
      : Stepper(name, system),
        functions_(std::move(functions)),
        n_(manifold().dimension()),
        tangents_(functions_->codimension_ > 0 ? 3 * n_ : 2 * n_),
        solver_(functions_->equations_, {tangents_, functions_->equations_.size() - tangents_},
                name, functions_->whole_, {.displacements = 2 * n_, .h = 3}),
        predictor_({tangents_, functions_->equations_.size() - tangents_}, solver_.predicted()),
        projection_(functions_->constraint_),
        basis_(manifold(), functions_->basis_),
        next_(functions_->advance_.output_size()),
        kept_(next_) {}

 private:
  // Onto M_f, where (v, z) are found.
  void do_prepare(State& state, double h) override {
    move_basis(state.x);
    functions_->start_.find(state, h, basis_, method(), statistics_);
    move_basis(state.x);
  }

  bool do_take_over(const Stepper& other) override {
    const auto* before = dynamic_cast<const Trajectory*>(&other);
    if (before == nullptr) return false;
    if (!basis_.take_over(before->basis_)) predictor_.forget();
    return true;
  }

  void do_step(const State& before, double h, State& after) override {
    VectorXd& y = solver_.unknown();
    const auto begin = [&] {
      const Index m = before.z.size();
      y.setZero();
      basis_.coordinates_of(before.v, y.segment(n_, n_));
      if (functions_->codimension_ > 0) {
        y.segment(2 * n_, n_) = y.segment(n_, n_);
        y.segment((functions_->tangents_ + 1) * n_, m) = before.z;
      }
      y.segment(n_, n_) *= h;
      y.head(n_) = kHalf * y.segment(n_, n_);
      y.tail(2 * m) << before.z, before.z;
    };
    if (predictor_.is_empty())
      begin();
    else
      predictor_.predict(y);
    const double size = coordinate_scale(before, h);
    const double scales[] = {size, auxiliary_scale(largest(before.z), size)};
    const Inputs in(y.data(), {before.x.data(), basis_.data(), &h, &before.t});
    solver_.solve_connected(in, scales, begin, {before.t, h}, statistics_);
    functions_->advance_.value(in.data(), next_.data());
    StateReader(next_.data()).take(after, before.x.size(), before.v.size(), before.z.size());
    projection_.apply(after.x);
  }

  void do_keep(const State&, const State& after) override {
    if (!solver_.is_determined()) predictor_.limit_degree(Predictor::kUndetermined);
    predictor_.record(solver_.unknown());
    solver_.keep();
    kept_.swap(next_);
    move_basis(after.x);
  }

  void do_stage(Step& step) const override {
    tell_halves(kept_.data() + step.before.x.size() + step.before.v.size() + step.before.z.size(),
                step, tells_parts());
  }

  void do_change_step() override { predictor_.forget(); }
  void do_forget() override {
    solver_.forget();
    predictor_.forget();
    basis_.forget();
  }
  Motion do_motion() const override { return solver_.motion(manifold()); }
  void do_expect(const Motion& motion) override { solver_.expect(motion); }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(functions_, method(), shared_system());
  }

  void move_basis(const VectorXd& x) {
    if (!basis_.move_to(x)) predictor_.forget();
  }

  const std::shared_ptr<const VerletSteps> functions_;
  Index n_;
  Index
      tangents_;  // so many of the unknowns are displacements, or the velocity at the end, which tells momenta
  StepSolver solver_;
  Predictor predictor_;
  RoundOffProjection projection_;
  TransportedFrame basis_;  // at the state
  VectorXd next_, kept_;
};

VerletSteps::VerletSteps(const VerletTrace& trace, const Manifold& manifold, const Backend& backend)
    : codimension_(trace.codimension),
      tangents_(trace.tangents),
      equations_(trace.step.compile(backend)),
      advance_("advance", trace.step.inputs, joined(trace.ended, trace.advanced),
               {.backend = backend}),
      start_(trace, manifold, backend),
      basis_(TransportedFrame::projection(manifold, backend)),
      constraint_(RoundOffProjection::constraint(manifold, backend)) {
  // Of multipliers the solution near the last ones is taken: for steps that go to zero their equations say nothing, so that
  // no curve leads there from the state.
  if (codimension_ == 0) whole_ = trace.step.followed(equations_);
}

std::unique_ptr<Stepper> VerletSteps::stepper(
    const std::string& name, const std::shared_ptr<const ImplicitSystem>& system) const {
  return std::make_unique<Trajectory>(shared_from_this(), name, system);
}

}  // namespace courant
