#include "courant/integrators/methods/order_measurement.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "courant/manifolds/measurement.hpp"

namespace courant {
namespace {

// Errors below are round-off.
constexpr double kFloor = 1e-12;
// So are small ones of which this part stays where the step is half as long.
constexpr double kSmall = 1e-6, kStays = 0.7;

}  // namespace

const OrderMeasurement::Errors& OrderMeasurement::errors(double h) {
  if (const auto known = errors_.find(h); known != errors_.end()) return known->second;
  std::vector<double> steps, errors;
  State coarse = integrator_.advance(from_, h / 2.0, 2);
  for (int count = 4; count <= 64; count *= 2) {
    const State fine = integrator_.advance(from_, h / count, count);
    steps.push_back(1.0 / count);
    errors.push_back(separation_(fine, coarse));
    coarse = fine;
  }
  const auto above = std::ranges::count_if(errors, [](double error) { return error > kFloor; });
  const auto stays = [](double coarser, double finer) { return finer > kStays * coarser; };
  return errors_[h] = {.order = above < 3 ? std::numeric_limits<double>::infinity()
                                          : log_log_slope(steps, errors, kFloor),
                       .are_round_off = std::ranges::max(errors) < kSmall &&
                                        std::ranges::adjacent_find(errors, stays) != errors.end()};
}

}  // namespace courant
