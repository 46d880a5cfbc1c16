#include "courant/integrators/methods/composition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "courant/integrators/methods/composed_differential.hpp"
#include "courant/integrators/methods/verlet.hpp"
#include "courant/integrators/step/step_parts.hpp"
#include "courant/integrators/step/step_program.hpp"

namespace courant {
namespace {

// The palindrome that begins with these.
template <std::size_t half>
constexpr std::array<double, 2 * half - 1> palindrome(const std::array<double, half>& first) {
  std::array<double, 2 * half - 1> all{};
  for (std::size_t i = 0; i < half; ++i) all[i] = all[2 * half - 2 - i] = first[i];
  return all;
}

constexpr auto kOrder4 = palindrome(std::array{
    0.41449077179437573714235406, 0.41449077179437573714235406, -0.65796308717750294856941625});
constexpr auto kOrder6 = palindrome(std::array{
    0.39216144400731413927925056, 0.33259913678935943859974864, -0.70624617255763935980996482,
    0.08221359629355080023149045, 0.79854399093482996339895035});
constexpr auto kOrder8 = palindrome(std::array{
    0.13020248308889008087881763, 0.56116298177510838456196441, -0.38947496264484728640807860,
    0.15884190655515560089621075, -0.39590389413323757733623154, 0.18453964097831570709183254,
    0.25837438768632204729397911, 0.29501172360931029887096624, -0.60550853383003451169892108});

// Two times that a straight line goes through are at least so many times as far apart as the nearer one
// is away: it is not extended by more than twice the distance between them.
constexpr double kApart = 0.5;

}  // namespace

// Each stage has a stepper of its own: it sees equal steps along a smooth curve, one in each step
// of the composition, and keeps the factorisation for its size. It goes on with the bases of the
// stage before, and learns from the two stages that are nearest in time.
class Composition::Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const Integrator> method, int order, const std::string& name)
      : Stepper(name, method->system()),
        composed_(std::move(method)),
        order_(order),
        coefficients_(coefficients(order)) {
    for (std::size_t i = 0; i < coefficients_.size(); ++i) stages_.push_back(composed_->stepper());
    const auto at_stage = Composition::nearby_stages(coefficients_, 0.5);
    const auto at_end = Composition::nearby_stages(coefficients_, 1.0);
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      std::vector<Companion> companions;
      const auto add = [&](std::size_t stage, double at_stage, double at_end) {
        companions.push_back({.stepper = stages_[stage].get(),
                              .at_stage = at_stage,
                              .at_end = at_end,
                              .ratio = coefficients_[i] / coefficients_[stage]});
      };
      for (const auto& [stage, times] : at_stage[i]) add(stage, times, 0.0);
      for (const auto& [stage, times] : at_end[i]) add(stage, 0.0, times);
      stages_[i]->accompany(companions);
    }
  }

 private:
  void do_prepare(State& state, double h) override {
    stages_.front()->prepare(state, coefficients_.front() * h);
  }

  void do_step(const State& before, double h, State& after) override {
    const double end = after.t;
    double share = 0.0;
    after = before;
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      share += coefficients_[i];
      const bool is_last = i + 1 == stages_.size();
      const Stepper& previous = i == 0 ? *stages_.back() : *stages_[i - 1];
      const CountedWork counted(statistics_, *stages_[i]);
      stages_[i]->step_from(previous, after, coefficients_[i] * h,
                            is_last ? end : before.t + share * h);
    }
  }

  void do_keep(const State&, const State&) override { parts_.keep(stages_, tells_parts()); }
  void do_stage(Step& step) const override { parts_.tell(step); }
  void do_discard() override { do_forget(); }
  void do_forget() override {
    for (const auto& stage : stages_) stage->forget();
  }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(composed_, order_, method());
  }

  std::shared_ptr<const Integrator> composed_;
  int order_;
  std::span<const double> coefficients_;
  std::vector<std::unique_ptr<Stepper>> stages_;
  StepParts parts_;
};

Composition::Composition(std::shared_ptr<const Integrator> method, int order)
    : Integrator(method ? method->system() : nullptr), method_(std::move(method)), order_(order) {
  coefficients(order);
  if (method_->is_symmetric() && method_->order() == 2) return;
  throw std::invalid_argument("Composition::Composition: order " + std::to_string(order) +
                              " needs a symmetric method of order 2, but " + method_->name() +
                              " as it is chosen here is " +
                              (method_->is_symmetric() ? "symmetric" : "not symmetric") +
                              " and of order " + std::to_string(method_->order()) + ".");
}

std::span<const double> Composition::coefficients(int order) {
  switch (order) {
    case 4:
      return kOrder4;
    case 6:
      return kOrder6;
    case 8:
      return kOrder8;
    default:
      throw std::invalid_argument("Composition::coefficients: order is " + std::to_string(order) +
                                  "; expected 4, 6 or 8.");
  }
}

std::vector<std::array<Composition::NearbyStage, 2>> Composition::nearby_stages(
    std::span<const double> steps, double part) {
  std::vector<double> times;
  double begin = 0.0;
  for (const double step : steps) {
    times.push_back(begin + part * step);
    begin += step;
  }
  std::vector<std::array<NearbyStage, 2>> result;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto after = [&](std::size_t j) { return times[j] - times[i] - (j < i ? 0.0 : 1.0); };
    std::vector<std::size_t> others(steps.size());
    std::iota(others.begin(), others.end(), std::size_t{0});
    std::ranges::stable_sort(others, {}, [&](std::size_t j) { return std::fabs(after(j)); });
    const double first = after(others[0]);
    const auto second = std::ranges::find_if(others, [&](std::size_t j) {
      return std::fabs(after(j) - first) >= kApart * std::fabs(first);
    });
    const double other = after(*second);
    result.push_back({NearbyStage{.stage = others[0], .times = other / (other - first)},
                      NearbyStage{.stage = *second, .times = first / (first - other)}});
  }
  return result;
}

std::string Composition::name() const {
  return method_->name() + " of order " + std::to_string(order_);
}

StepProgram Composition::program() const {
  StepProgram program = step_program(*method_);
  const auto parts = coefficients(order_);
  program.method = name();
  program.substeps.assign(parts.begin(), parts.end());
  return program;
}

std::vector<StepFormulas> Composition::do_formulas() const { return method_->formulas(); }

std::shared_ptr<const StepDifferential> Composition::do_differential() const {
  return ComposedDifferential::of(name(), {method_->differential()});
}

std::unique_ptr<Stepper> Composition::do_stepper() const {
  if (const auto* verlet = dynamic_cast<const Verlet*>(method_.get()))
    if (auto explicit_steps = verlet->composed(coefficients(order_), name())) return explicit_steps;
  return std::make_unique<Trajectory>(method_, order_, name());
}

}  // namespace courant
