#include "courant/integrators/methods/substepping_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/integrators/methods/composed_differential.hpp"
#include "courant/integrators/step/step_parts.hpp"

namespace courant {
namespace {

constexpr int kMostHalvings = 60;
constexpr double kMostCorners = 1e4;

}  // namespace

// Whole steps have a stepper of their own, so that what it knows of equal steps stays of use.
class SubsteppingIntegrator::Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const Integrator> integrator, Options options, const std::string& name)
      : Stepper(name, integrator->system()),
        integrator_(std::move(integrator)),
        options_(std::move(options)),
        whole_(integrator_->stepper()),
        piece_(integrator_->stepper()) {}

 private:
  void do_prepare(State& state, double h) override {
    whole_->prepare(state, h);
    if (expected_) whole_->expect(*expected_);
    expected_.reset();
  }

  void do_step(const State& before, double h, State& after) override {
    if (tells_parts()) {
      whole_->tell_parts();
      piece_->tell_parts();
    }
    const double end = after.t;
    next_parts_.clear();
    is_halved_ = false;
    after = before;
    const std::vector<double> corners = corners_within(options_.corners, before.t, h);
    if (corners.empty() && options_.parts == 1)
      return make_piece(*whole_, after, h, end, options_.halvings);
    double begin = before.t;
    for (const double corner : corners) {
      make_parts(after, corner - begin, corner);
      begin = corner;
    }
    make_parts(after, before.t + h - begin, end);
  }

  // The piece of h to the time `end`.
  void make_parts(State& state, double h, double end) {
    const double part = h / options_.parts;
    for (int left = options_.parts - 1; left >= 0; --left)
      make_piece(*piece_, state, part, end - left * part, options_.halvings);
  }

  // The step of h to the time `end`, in halves if it is refused and may be halved so many times.
  void make_piece(Stepper& stepper, State& state, double h, double end, int halvings) {
    try {
      const CountedWork counted(statistics_, stepper);
      stepper.step(state, h, end);
    } catch (const SolveError&) {
      if (halvings == 0) throw;
      is_halved_ = true;
      const double middle = 0.5 * (state.t + end);
      make_piece(*piece_, state, 0.5 * h, middle, halvings - 1);
      make_piece(*piece_, state, 0.5 * h, end, halvings - 1);
      return;
    }
    last_ = &stepper;
    if (tells_parts()) next_parts_.push_back(stepper.last());
  }

  void do_keep(const State&, const State&) override {
    if (is_halved_) ++statistics_.divisions;
    is_divided_ = last_ != whole_.get();
    const Step& last = last_->last();
    rate_ = last.rate;
    parts_.keep(last, 1);
    if (tells_parts()) parts_.exchange(next_parts_);
  }
  void do_stage(Step& step) const override {
    step.rate = rate_ == 1.0 ? 1.0 : (step.after.t - step.before.t) / step.h;
    parts_.tell(step);
  }

  // A piece that was made may have gone where the step does not end.
  void do_discard() override { do_forget(); }
  void do_forget() override {
    whole_->forget();
    piece_->forget();
    expected_.reset();
  }
  Motion do_motion() const override { return is_divided_ ? Motion() : whole_->motion(); }
  void do_expect(const Motion& motion) override { expected_ = motion; }
  // The method itself asks.
  bool do_keeps_to_manifold() const override { return false; }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(integrator_, options_, method());
  }

  std::shared_ptr<const Integrator> integrator_;
  Options options_;
  std::unique_ptr<Stepper> whole_, piece_;
  bool is_halved_ = false;          // the step that is made
  std::vector<Step> next_parts_;    // of that
  Stepper* last_ = nullptr;         // which made its last piece
  bool is_divided_ = false;         // the last step that stands
  StepParts parts_;                 // of that
  double rate_ = 1.0;               // of its last piece
  std::optional<Motion> expected_;  // for the step after the next preparation
};

SubsteppingIntegrator::SubsteppingIntegrator(const std::shared_ptr<const Integrator>& method,
                                             Options options)
    : IntegratorAdaptor("SubsteppingIntegrator", method ? method->system() : nullptr,
                        method ? method->system() : nullptr, method),
      options_(std::move(options)) {
  if (options_.halvings < 0 || options_.halvings > kMostHalvings)
    throw std::invalid_argument("SubsteppingIntegrator::SubsteppingIntegrator: halvings is " +
                                std::to_string(options_.halvings) + "; expected 0 to " +
                                std::to_string(kMostHalvings) + ".");
  if (options_.parts < 1)
    throw std::invalid_argument("SubsteppingIntegrator::SubsteppingIntegrator: parts is " +
                                std::to_string(options_.parts) + "; expected at least 1.");
  for (const Corner& corner : options_.corners)
    if (!std::isfinite(corner.first) || !std::isfinite(corner.period) || corner.period < 0.0)
      throw std::invalid_argument(
          "SubsteppingIntegrator::SubsteppingIntegrator: a corner has the time " +
          number_text(corner.first) + " and the period " + number_text(corner.period) +
          "; expected finite numbers, the period 0 or greater.");
}

std::shared_ptr<const SubsteppingIntegrator> SubsteppingIntegrator::in_parts(int parts) const {
  Options options = options_;
  options.parts *= parts;
  return std::make_shared<const SubsteppingIntegrator>(wrapped(), std::move(options));
}

std::vector<double> SubsteppingIntegrator::corners_within(const std::vector<Corner>& corners,
                                                          double t, double h) {
  const double margin = kSmallestPart * std::fabs(h);
  const double low = std::min(t, t + h) + margin, high = std::max(t, t + h) - margin;
  std::vector<double> within;
  for (const auto& [first, period] : corners) {
    if (first > high) continue;
    if (period == 0.0) {
      if (first > low) within.push_back(first);
      continue;
    }
    if (high - low > kMostCorners * period)
      throw SolveError(SolveError::Reason::left_domain, "SubsteppingIntegrator", t, h,
                       "has more than " + number_text(kMostCorners) + " corners of the period " +
                           number_text(period) + "; expected a shorter step.");
    for (double k = std::max(0.0, std::floor((low - first) / period)); first + k * period < high;
         ++k)
      if (first + k * period > low) within.push_back(first + k * period);
  }
  std::ranges::sort(within);
  const auto same = [margin](double a, double b) { return b - a <= margin; };
  within.erase(std::unique(within.begin(), within.end(), same), within.end());
  if (h < 0.0) std::ranges::reverse(within);
  return within;
}

std::shared_ptr<const StepDifferential> SubsteppingIntegrator::do_differential() const {
  return ComposedDifferential::of(name(), {wrapped()->differential()});
}

std::unique_ptr<Stepper> SubsteppingIntegrator::do_stepper() const {
  return std::make_unique<Trajectory>(wrapped(), options_, name());
}

}  // namespace courant
