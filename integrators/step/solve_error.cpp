#include "courant/integrators/step/solve_error.hpp"

#include <cmath>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// Two digits of a step, towards zero.
double rounded_down(double h) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::fabs(h))) - 1.0);
  return std::trunc(h / unit) * unit;
}

std::string text(const std::string& method, double time, double h, const std::string& what_happened,
                 const std::optional<SolveError::Reach>& reach) {
  std::string step = method + ": the step of " + number_text(h, 12) +
                     " from t = " + number_text(time, 12) + ' ' + what_happened;
  if (!reach) return step;
  return step + ": the one that is ends at a step of " + number_text(reach->h) + ". " +
         (reach->remedy.empty()
              ? "A step of " + number_text(rounded_down(0.9 * reach->h)) + " would do."
              : reach->remedy);
}

}  // namespace

SolveError::SolveError(Reason reason, const std::string& method, double time, double h,
                       std::string what_happened, std::vector<double> residuals,
                       std::optional<Reach> reach)
    : std::runtime_error(text(method, time, h, what_happened, reach)),
      reason_(reason),
      time_(time),
      h_(h),
      what_happened_(std::move(what_happened)),
      residuals_(std::move(residuals)),
      reach_(std::move(reach)) {}

SolveError SolveError::of_step(const std::string& method, double time, double h,
                               double unit) const {
  std::optional<Reach> reach = reach_;
  if (reach) reach->h *= unit;
  return {reason_, method, time, h, what_happened_, residuals_, std::move(reach)};
}

}  // namespace courant
