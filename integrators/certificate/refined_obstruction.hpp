// Obstruction, asked with more digits where doubles leave the answer open.
#pragma once

#include <optional>
#include <vector>

#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/level_certainty.hpp"
#include "courant/integrators/certificate/obstruction.hpp"

namespace courant {

// The Obstruction at a zero of given levels, and, from the first direction that round-off hides on, also that of its
// RefinedArray: what more digits say does not obstruct, does not.
class RefinedObstruction {
 public:
  // `magnitude` as for Obstruction. The jet and the levels have to outlive it.
  RefinedObstruction(const ConsistentJet& at, const std::vector<LadderLevel>& levels,
                     const SparseMatrixXd& magnitude);
  RefinedObstruction(const RefinedObstruction&) = delete;
  RefinedObstruction& operator=(const RefinedObstruction&) = delete;

  Obstruction::Answer is_seen_along(const VectorXd& direction);

  // Whether more digits have the ranks of the levels (has_refined_ranks); no value if they were not asked.
  std::optional<bool> has_refined_ranks() const { return has_refined_ranks_; }

 private:
  const ConsistentJet& at_;
  const std::vector<LadderLevel>& levels_;
  SparseMatrixXd magnitude_;
  Obstruction rough_;
  std::optional<bool> has_refined_ranks_;
  std::optional<RefinedArray> array_;
  std::optional<Obstruction> refined_;  // of array_
};

}  // namespace courant
