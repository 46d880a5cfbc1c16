// Whether solutions branch at a point.
#pragma once

#include <string>

#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"

namespace courant {

// Why solutions branch at a point.
struct Bifurcation {
  std::string reason = "";   // in words; empty if nothing says so
  bool is_confirmed = true;  // whether the points next to it are zeros with 113 bits too
};

// Whether solutions branch at the point of a ladder that has an index.
// Where M_{k+1} has fewer dimensions than M_k, points of M_k next to it that its constraints leave out should
// have no velocity. If they have one, and it leads back to another velocity of the point along which the sets
// are larger, another curve leads through the point: as at the turning points of θ'²/2 = cos θ, where both rest
// and motion solve the equations. Up to 200 unknowns.
Bifurcation bifurcation(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const ConstraintLadder& ladder);

}  // namespace courant
