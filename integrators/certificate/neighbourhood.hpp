// Neighbourhood: the ranks at consistent points around one.
#pragma once

#include <random>
#include <vector>

#include "courant/integrators/certificate/nearest_jet.hpp"
#include "courant/integrators/certificate/staged_elimination.hpp"

namespace courant {

// Looks from a zero of F^[k] in random directions that are tangent to the zeros, some 2⁻³⁰ away in every
// unknown and in time, and brings each point back to a zero. Where all dimensions there are those here the sets are
// manifolds around the point; where all are others the point is singular.
class Neighbourhood {
 public:
  struct Look {
    Jet jet;
    bool is_zero = false;             // Newton's method came back, and squared its error
    bool has_same_ranks = false;      // as the point itself, at all levels
    std::int64_t smallest_pivot = 0;  // of the elimination there
    StagedElimination elimination;
  };

  // `here`: the elimination at the jet.
  Neighbourhood(const JetEquations& equations, const NearestJet& nearest, const Jet& jet,
                const StagedElimination& here, int looks);

  const std::vector<Look>& looks() const { return looks_; }
  bool is_singular() const;     // no look has the same ranks
  bool is_divided() const;      // some have and some have not
  bool is_transversal() const;  // some look came back

  // How far away, next to the size of the unknowns, the smallest pivot vanishes, if it goes on as it does from look
  // to look; infinite if it does not change.
  double distance_to_singular() const { return distance_; }

 private:
  std::vector<Look> looks_;
  double distance_;
};

}  // namespace courant
