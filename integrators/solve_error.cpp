#include "courant/integrators/solve_error.hpp"

#include <sstream>
#include <utility>

namespace courant {
namespace {

std::string text(const std::string& method, double time, double h,
                 const std::string& what_happened) {
  std::ostringstream message;
  message.precision(12);
  message << method << ": the step of " << h << " from t = " << time << ' ' << what_happened;
  return message.str();
}

}  // namespace

SolveError::SolveError(Reason reason, const std::string& method, double time, double h,
                       const std::string& what_happened, std::vector<double> residuals)
    : std::runtime_error(text(method, time, h, what_happened)),
      reason_(reason),
      time_(time),
      h_(h),
      residuals_(std::move(residuals)) {}

}  // namespace courant
