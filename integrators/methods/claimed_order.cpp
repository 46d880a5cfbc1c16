#include "courant/integrators/methods/claimed_order.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace courant {
namespace {

constexpr double kWrong = std::numeric_limits<double>::infinity();

// Parts of the step of a setting, for systems that are stiff.
constexpr double kShorter[] = {0.125, 0.125 / 8, 0.125 / 64, 0.125 / 512, 0.125 / 4096};
// An order is one of errors above round-off: where those of the setting are that, such multiples are.
constexpr double kLonger[] = {8.0, 64.0};

}  // namespace

ClaimedOrder::ClaimedOrder(const Integrator& integrator, const IntegratorSetting& setting,
                           const IntegratorLawOptions& options, const StateSeparation& separation)
    : integrator_(integrator),
      setting_(setting),
      options_(options),
      separation_(separation),
      orders_(integrator, setting.initial,
              [&separation](const State& a, const State& b) { return separation(a, b); }) {}

// The order measured with h next to the claim. With other steps than that of the setting it has to be
// the claim: on the way to short ones it may be any. Infinite, which is exact, is a defect there, where
// it may be round-off, and of both_ways, where what is measured is to be seen.
double ClaimedOrder::defect(double h, bool is_other) {
  if (setting_.system->manifold()->dimension() == 0 || setting_.is_gauge) return 0.0;
  const double order = orders_.errors(h).order;
  const bool is_exactly = options_.both_ways || is_other;
  if (std::isinf(order)) return is_exactly ? kWrong : 0.0;
  const double low = integrator_.order() - order;
  return is_exactly ? std::abs(low) : std::max(0.0, low);
}

// Whether the order with the setting's step is.
bool ClaimedOrder::is_hidden_by_round_off() {
  try {
    return orders_.errors(setting_.step).are_round_off;
  } catch (const std::exception&) {
    return false;
  }
}

// The first of defect(h, is_other) that is none, or else the least: with the setting's step, and other
// ones. Throws what the first one throws, if all do.
double ClaimedOrder::with_other_steps(const std::function<double(double, bool)>& defect) {
  double least = kWrong;
  std::exception_ptr failure;
  bool is_measured = false;
  const auto try_step = [&](double h, bool is_other) {
    try {
      least = std::min(least, defect(h, is_other));
      is_measured = true;
    } catch (const std::exception&) {
      if (!failure) failure = std::current_exception();
    }
  };
  const double h = setting_.step;
  try_step(h, false);
  for (const double part : kShorter)
    if (!(least <= kTolerance)) try_step(part * h, true);
  if (!(least <= kTolerance) && is_hidden_by_round_off())
    for (const double multiple : kLonger)
      if (!(least <= kTolerance)) try_step(multiple * h, true);
  if (!is_measured) std::rethrow_exception(failure);
  return least;
}

ClaimedOrder::Defect ClaimedOrder::defect() {
  Defect result;
  result.value = with_other_steps([&](double h, bool is_other) {
    const double missed = defect(h, is_other);
    if (is_other && missed <= kTolerance) result.order = orders_.errors(h).order;
    return missed;
  });
  return result;
}

double ClaimedOrder::backward_defect() {
  const State& start = setting_.initial;
  return with_other_steps([&](double h, bool is_other) {
    const State before = integrator_.advance(start, -h, 1);
    if (!(before.t - start.t < 0.0) != (h < 0.0)) return kWrong;
    // Forward again is where it came from, up to the error of the step.
    const State there = integrator_.advance(before, h, 1);
    if (!setting_.is_gauge &&
        separation_(there, start) > 0.5 * separation_(before, start) + StateSeparation::kSame)
      return kWrong;
    return defect(-h, is_other);
  });
}

}  // namespace courant
