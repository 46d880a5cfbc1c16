// Entries of `expect` about events.
#pragma once

#include "courant/reading/expectation_reading.hpp"

namespace courant {

// {"event": "perihelion", "count": 10}, and {"event": "perihelion", "number": 3, "time": "6*pi", "tolerance": 1e-4}.
void read_event(ObjectReader& entry, const JsonReader& name_key, const ExpectationReading& reading);

}  // namespace courant
