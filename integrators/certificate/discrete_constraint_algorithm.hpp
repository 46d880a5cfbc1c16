// DiscreteConstraintAlgorithm: which points a discrete system can start from and go on.
#pragma once

#include <memory>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/discretization_map.hpp"

namespace courant {

// The constraint algorithm on S_d ⊂ M × M (Remark 6.1 of the paper), with pairs of points in place
// of tangent vectors and the first point in place of the base point:
//
//   S_k = {(x_0, x_1) : there are x_2, …, x_{k+1} with (x_i, x_{i+1}) ∈ S_d for i = 0 … k}
//   M_k = {x_0 : …},      until the dimensions of both repeat
//
// M_k are the points from which k+1 steps can be made. The result need not be that of
// ConstraintAlgorithm for S: the equations are asked for between the points, so the points
// themselves may be free. Verdicts:
//
//   regular       S_f is the graph of a map x_0 ↦ x_1 on M_f
//   gauge         x_1 is free in gauge_dimension directions
//   inconsistent  as for S
//   not_reached   as for S
//
// The result holds near the point if the ranks are constant there, which is not examined.
class DiscreteConstraintAlgorithm {
 public:
  struct Options {
    Index max_level = 12;
  };

  DiscreteConstraintAlgorithm() = default;
  explicit DiscreteConstraintAlgorithm(Options options) : options_(options) {}

  // `guess`: x near the first point of the chain, v and z to start the search from; nothing is
  // held. In the ladder, point.x is x_0, jet the chain (in the chart at guess.x), moved the
  // distance of x_0 from guess.x in that chart; constraints and what else is described is left
  // empty. Throws std::invalid_argument as ChainArray does.
  ConstraintLadder run(const std::shared_ptr<const ImplicitSystem>& system,
                       const std::shared_ptr<const DiscretizationMap>& map, double h,
                       const InitialGuess& guess) const;

 private:
  Options options_;
};

}  // namespace courant
