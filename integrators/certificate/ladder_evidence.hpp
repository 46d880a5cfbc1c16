// LadderEvidence: how certain the ranks of a ladder are, and doubts(): what is not, in words.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/certificate/ladder_ascent.hpp"

namespace courant {

// The ranks of a ladder decide its dimensions. They are computed at the point where the ascent ended, which is known up
// to an error, so they may be wrong. Four things make them certain:
//
// * bounds of the errors of the derivatives at the point,
// * the pattern of the equations, that is which unknowns each of them contains: no rank is larger than it allows,
// * the ranks at points nearby,
// * the same computation with 113 bits, where all that leaves something open.
struct LadderEvidence {
  // Whether the errors of the derivatives are small next to the terms of the equations.
  bool is_known = true;
  // Whether the ranks stay as they are if the point is taken for exact.
  bool is_same_rank = true;
  // Whether ranks that were doubtful are proven: the bounds of errors say that they are no smaller, the pattern that
  // they are no larger. Points nearby are then not needed.
  bool is_proven = false;
  // Whether they are proven and all equations are independent. Then there is a zero, and no entry of the Jacobian was
  // lost among errors.
  bool is_full = false;
  // Whether 113 bits settled what 53 left open.
  bool is_refined = false;

  // Looks at the levels of the ascent, and marks the doubtful ones that prove to be certain.
  explicit LadderEvidence(LadderAscent& ascent);
};

// What remains doubtful of the ladder, one sentence for each doubt. `consistent` is what the ascent was made with.
std::vector<Doubt> doubts(const ConsistentPoint& consistent, const LadderAscent& ascent,
                          const LadderEvidence& evidence);

}  // namespace courant
