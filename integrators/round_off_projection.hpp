// Keeps points on their manifold at round-off level.
#pragma once

#include "courant/core/function.hpp"
#include "courant/manifolds/manifold.hpp"

namespace courant {

// One Gauss–Newton step onto {constraint(x) = 0} for an x that is on it up to accumulated
// round-off: x moves by as little as its defect, so a method is not changed by it, and the defect
// does not grow over 10⁶ steps. Nothing happens where the defect is below 4 eps ‖x‖.
class RoundOffProjection {
 public:
  explicit RoundOffProjection(const Manifold& manifold);
  void apply(VectorXd& x) const;

 private:
  Function constraint_;
};

}  // namespace courant
