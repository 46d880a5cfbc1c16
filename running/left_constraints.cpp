#include "courant/running/left_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/message.hpp"

namespace courant {
namespace {

constexpr Index kMostCoordinates = 500;

// A constraint that is this part of its terms is not met. A product of d coordinates counts d times, so
// that for d = 6 this is a fifth of it. Constraints that a method meets up to its order are left 10⁻⁴ of
// their terms in the steps that people take.
constexpr double kPartOfTerms = 0.03;
// Below this part of the terms of another one it may be round-off; a coordinate below this part of the
// largest one is measured by that part.
constexpr double kSmallPart = 1e-6;

// Of a coordinate, for slopes.
constexpr double kPartForSlopes = 1e-6;

}  // namespace

std::string left_constraints(Observer& observer, const QuantityStatistics& statistics,
                             const State& end) {
  const Index n = end.x.size(), count = static_cast<Index>(observer.constraint_count());
  if (n == 0 || n > kMostCoordinates || count == 0 || statistics.empty()) return "";
  const QuantityStatistics::Memory& all = statistics.memory();
  VectorXd size = all.min.head(n).cwiseAbs().cwiseMax(all.max.head(n).cwiseAbs());
  size = size.cwiseMax(kSmallPart * size.maxCoeff());
  const auto constraints = [&](const State& state) -> VectorXd {
    return observer.row(state).segment(static_cast<Index>(observer.first_constraint()), count);
  };
  VectorXd at, terms = VectorXd::Zero(count);
  try {
    at = constraints(end);
    State moved = end;
    for (Index j = 0; j < n; ++j) {
      moved.x[j] += kPartForSlopes * size[j];
      terms += (constraints(moved) - at).cwiseAbs() / kPartForSlopes;
      moved.x[j] = end.x[j];
    }
  } catch (const std::domain_error&) {  // of what is not defined there nothing is said
    return "";
  }
  if (!terms.allFinite()) return "";
  for (Index i = 0; i < count; ++i) {
    const double least = std::max(kPartOfTerms * terms[i], kSmallPart * terms.maxCoeff());
    if (std::fabs(at[i]) > least)
      return "constraint[" + std::to_string(i) + "] is " + number_text(at[i]) +
             " at the end, its terms " + number_text(terms[i], 3) +
             ": the run has left the constraints, and the trajectory may be wrong.";
  }
  return "";
}

}  // namespace courant
