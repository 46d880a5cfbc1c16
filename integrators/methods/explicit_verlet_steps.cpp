#include "courant/integrators/methods/explicit_verlet_steps.hpp"

#include <utility>
#include <vector>

#include "courant/integrators/methods/verlet_halves.hpp"

namespace courant {

// Steps of given parts of h, each one call.
class ExplicitVerletSteps::Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const ExplicitVerletSteps> functions, const std::string& name,
             const std::shared_ptr<const ImplicitSystem>& system, std::span<const double> parts)
      : Stepper(name, system),
        functions_(std::move(functions)),
        parts_(parts.begin(), parts.end()),
        n_(manifold().ambient_dimension()),
        count_(functions_->handed_on_),
        handed_on_(count_),
        ended_(functions_->ending_.output_size()),
        told_(functions_->stages_.output_size()) {
    if (functions_->multipliers_)
      multipliers_.emplace(*functions_->multipliers_, std::ssize(parts_), name);
    points_.resize(n_ + count_ + (multipliers_ ? multipliers_->iterated() : 0),
                   std::ssize(parts_) + 1);
    kept_ = points_;
  }

 private:
  void do_prepare(State& state, double h) override {
    if (multipliers_) {
      TransportedFrame basis(manifold(), functions_->basis_);
      basis.move_to(state.x);
      functions_->start_.find(state, h, basis, method(), statistics_);
    }
    const double* in[] = {state.x.data(), &state.t};
    functions_->beginning_.value(in, handed_on_.data());
  }

  bool do_take_over(const Stepper& other) override {
    const auto* before = dynamic_cast<const Trajectory*>(&other);
    if (before == nullptr) return false;
    handed_on_ = before->handed_on_;
    return true;
  }

  void do_step(const State& before, double h, State& after) override {
    points_.col(0).head(n_ + count_) << before.x, handed_on_;
    if (multipliers_) multipliers_->begin(before, h);
    double share = 0.0;
    double* from = points_.data();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      double* const to = from + points_.rows();
      const double part = parts_[i] * h, t = before.t + share * h;
      double* const u = multipliers_ ? multipliers_->unknowns(static_cast<Index>(i)) : nullptr;
      make_part(static_cast<Index>(i), from, part, t, u, to);
      share += parts_[i];
      if (i + 1 == parts_.size()) {
        if (multipliers_) multipliers_->end(static_cast<Index>(i), from, part, t, statistics_);
        const double* of_ending[] = {from, from + n_, to + n_, &part, &t, u};
        functions_->ending_.value(of_ending, ended_.data());
      }
      from = to;
    }
    after.x = points_.col(points_.cols() - 1).head(n_);
    StateReader reader(ended_.data());
    reader.take(after.v, before.v.size());
    reader.take(after.z, before.z.size());
  }

  void make_part(Index i, const double* from, double part, double t, double* u, double* to) {
    if (multipliers_) {
      if (multipliers_->iterated() > 0 && multipliers_->moves(i, from, part, t, to, statistics_))
        return;
      multipliers_->move(i, from, part, t, statistics_);
    }
    const double* in[] = {from, from + n_, &part, &t, u};
    functions_->step_.value(in, to);
  }

  void do_keep(const State&, const State&) override {
    if (multipliers_) multipliers_->keep();
    kept_.swap(points_);
    handed_on_ = kept_.col(kept_.cols() - 1).segment(n_, count_);
  }

  void do_stage(Step& step) const override {
    std::vector<Step> parts;
    double share = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double* from = kept_.col(static_cast<Index>(i)).data();
      Step part{.h = parts_[i] * step.h,
                .before = {.t = step.before.t + share * step.h,
                           .x = kept_.col(static_cast<Index>(i)).head(n_),
                           .v = step.before.v,
                           .z = step.before.z}};
      share += parts_[i];
      part.after = step.after;
      part.after.t = step.before.t + share * step.h;
      part.after.x = kept_.col(static_cast<Index>(i) + 1).head(n_);
      const double* u = multipliers_ ? multipliers_->kept(static_cast<Index>(i)) : nullptr;
      const double* in[] = {from,    from + n_,      from + points_.rows() + n_,
                            &part.h, &part.before.t, u};
      functions_->stages_.value(in, told_.data());
      tell_halves(told_.data(), part, tells_parts());
      if (!parts.empty()) parts.back().after.v = part.before.v = parts.back().stage.v;
      parts.push_back(std::move(part));
    }
    step.stage = parts.back().stage;
    step.parts.clear();
    if (tells_parts()) step.parts = parts_.size() == 1 ? parts.front().parts : std::move(parts);
  }

  void do_change_step() override {
    if (multipliers_) multipliers_->change_step();
  }
  void do_forget() override {
    if (multipliers_) multipliers_->forget();
  }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(functions_, method(), shared_system(), parts_);
  }

  const std::shared_ptr<const ExplicitVerletSteps> functions_;
  const std::vector<double> parts_;
  const Index n_, count_;
  MatrixXd points_,
      kept_;  // (x, r), and what is known of an iteration that led there, before each part and at the end: of the step that is made, and of the last one
  VectorXd handed_on_, ended_;
  std::optional<MultiplierSolver> multipliers_;
  mutable VectorXd told_;  // workspace
};

ExplicitVerletSteps::ExplicitVerletSteps(const ExplicitVerlet& formulas, const Backend& backend)
    : handed_on_(std::ssize(formulas.handed_on)),
      beginning_("beginning", formulas.beginning, {.backend = backend}),
      step_("step", formulas.step, {.backend = backend}),
      stages_("stages", formulas.stages, {.backend = backend}),
      ending_("ending", formulas.ending, {.backend = backend}) {}

ExplicitVerletSteps::ExplicitVerletSteps(const ExplicitVerlet& formulas, const VerletTrace& trace,
                                         const Manifold& manifold, const Backend& backend)
    : ExplicitVerletSteps(formulas, backend) {
  multipliers_.emplace(*formulas.multipliers, backend);
  start_ = VerletStart(trace, manifold, backend);
  basis_ = TransportedFrame::projection(manifold, backend);
}

std::unique_ptr<Stepper> ExplicitVerletSteps::stepper(
    const std::string& name, const std::shared_ptr<const ImplicitSystem>& system,
    std::span<const double> parts) const {
  return std::make_unique<Trajectory>(shared_from_this(), name, system, parts);
}

}  // namespace courant
