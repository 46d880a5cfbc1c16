#include "courant/integrators/step/redundant_equations.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/regular_matrix.hpp"

namespace courant {
namespace {

// The part of a dependence, a unit vector, below which an equation has no part in it.
constexpr double kTakesNoPart = 1e-6;
// Squares of parts that differ by less are equal.
constexpr double kEqualParts = 1e-6;

// The rows that stay without an equation.
std::vector<Index> without(const std::vector<Index>& rows, const std::vector<Index>& source,
                           Index equation) {
  std::vector<Index> rest;
  std::ranges::copy_if(rows, std::back_inserter(rest), [&](Index row) {
    return source[static_cast<std::size_t>(row)] != equation;
  });
  return rest;
}

}  // namespace

std::vector<Index> redundant_rows(const MatrixXd& J, const std::vector<Index>& source,
                                  const std::vector<Index>& named) {
  struct Candidate {
    Index equation;
    double part;
  };
  std::vector<Index> left(static_cast<std::size_t>(J.rows()));
  std::iota(left.begin(), left.end(), Index{0});
  const MatrixXd scaled = equilibrate(J, regular_matrix::kNoise).scaled;
  std::vector<Candidate> candidates;
  for (const Index equation : named) candidates.push_back({equation, 0.0});
  while (!candidates.empty()) {
    const MatrixXd rows = scaled(left, Eigen::all);
    const FundamentalSubspaces spaces(rows);
    if (spaces.decision().ambiguous()) return {};
    const MatrixXd dependences = spaces.left_kernel();
    if (dependences.cols() == 0) break;
    for (Candidate& candidate : candidates) {
      candidate.part = 0.0;
      for (std::size_t i = 0; i < left.size(); ++i)
        if (source[static_cast<std::size_t>(left[i])] == candidate.equation)
          candidate.part += dependences.row(static_cast<Index>(i)).squaredNorm();
    }
    std::erase_if(candidates,
                  [](const Candidate& of) { return of.part < kTakesNoPart * kTakesNoPart; });
    // Of equal parts, up to round-off, the later equation goes: it repeats the others.
    std::ranges::sort(candidates, std::greater<>(), [](const Candidate& of) {
      return std::pair(std::round(of.part / kEqualParts), of.equation);
    });
    const auto follows = std::ranges::find_if(candidates, [&](const Candidate& candidate) {
      const std::vector<Index> rest = without(left, source, candidate.equation);
      const RankDecision decision = decide_rank(MatrixXd(scaled(rest, Eigen::all)));
      return decision.rank == spaces.rank() && !decision.ambiguous();
    });
    if (follows == candidates.end()) break;
    left = without(left, source, follows->equation);
    candidates.erase(follows);
  }
  std::vector<Index> result;
  for (Index row = 0; row < J.rows(); ++row)
    if (!std::ranges::binary_search(left, row)) result.push_back(row);
  return result;
}

}  // namespace courant
