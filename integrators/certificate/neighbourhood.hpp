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
    bool is_zero = false;         // Newton's method came back, and squared its error
    bool has_same_ranks = false;  // as the point itself, at all levels
    StagedElimination elimination;
  };

  // `here`: the elimination at the jet.
  Neighbourhood(const JetEquations& equations, const NearestJet& nearest, const Jet& jet,
                const StagedElimination& here, int looks);

  const std::vector<Look>& looks() const { return looks_; }
  bool is_singular() const;     // no look has the same ranks
  bool is_divided() const;      // some have and some have not
  bool is_transversal() const;  // some look came back

 private:
  std::vector<Look> looks_;
};

}  // namespace courant
