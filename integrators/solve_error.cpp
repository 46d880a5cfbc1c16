#include "courant/integrators/solve_error.hpp"

#include <utility>

#include "courant/core/message.hpp"

namespace courant {
namespace {

std::string text(const std::string& method, double time, double h,
                 const std::string& what_happened) {
  return method + ": the step of " + number_text(h, 12) + " from t = " + number_text(time, 12) +
         ' ' + what_happened;
}

}  // namespace

SolveError::SolveError(Reason reason, const std::string& method, double time, double h,
                       const std::string& what_happened, std::vector<double> residuals)
    : std::runtime_error(text(method, time, h, what_happened)),
      reason_(reason),
      time_(time),
      h_(h),
      residuals_(std::move(residuals)) {}

std::string what_happened(const SolveError& error) {
  const std::string text = error.what(), before = "from t = ";
  const std::size_t time = text.find(before);
  const std::size_t end = time == std::string::npos ? time : text.find(' ', time + before.size());
  return end == std::string::npos ? text : text.substr(end + 1);
}

}  // namespace courant
