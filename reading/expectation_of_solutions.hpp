// Entries of `expect` about what is found before there are steps.
#pragma once

#include "courant/reading/expectation_reading.hpp"

namespace courant {

// Both return false, and do nothing, where the entry has none of their keys.

// {"verdict": "regular", "ladder": [[16, 8], [8, 8]], "index": 1}: what the constraint algorithm
// finds. A verdict that is doubted is not met but by {"verdict": "regular", "doubted": true}.
bool read_certificate(ObjectReader& entry, const ExpectationReading& reading);

// {"boundary": "isolated", "family_dimension": 0, "conjugate_points": 1, "duration": 2, "tolerance": 1e-6}: what is
// found of conditions at both ends.
bool read_solution(ObjectReader& entry, const ExpectationReading& reading);

}  // namespace courant
