// What is known of the ranks of a ladder.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/certificate/ladder_ascent.hpp"

namespace courant {

// How far the ranks at the point where an ascent ended are certain, by the bounds of errors there, by the
// pattern of the equations, by points nearby, and by more digits where these leave something open.
struct LadderEvidence {
  // Whether the errors of the derivatives are small next to what the equations are made of.
  bool is_known = true;
  // Whether the ranks stay as they are if the point is taken for exact.
  bool is_same_rank = true;
  // Whether ranks that were doubtful are proven from below by the bounds of errors and from above by the pattern of
  // the equations. Then they need no points nearby.
  bool is_proven = false;
  // Whether they are proven, and all equations independent: then there is a zero, and no entry that could have been
  // lost.
  bool is_full = false;
  // Whether 113 bits settled what 53 left open.
  bool is_refined = false;

  // Clears what is doubtful of the levels where it is certain all the same.
  explicit LadderEvidence(LadderAscent& ascent);
};

// What remains doubtful of the ladder, a sentence each. `consistent` is that of the ascent.
std::vector<Doubt> doubts(const ConsistentPoint& consistent, const LadderAscent& ascent,
                          const LadderEvidence& evidence);

}  // namespace courant
