// Entries of `expect` about quantities along a run, or over an ensemble.
#pragma once

#include "courant/reading/expectation_reading.hpp"

namespace courant {

// {"observable": "H", "max_drift": 2e-4}: bounds of one quantity along the run.
void read_bounds(ObjectReader& entry, const JsonReader& name_key,
                 const ExpectationReading& reading);

// {"at": 300, "state": {"x[0]": 24.47}, "tolerance": 0.01}: values at one time; without `at` closed forms at every
// step.
void read_state(ObjectReader& entry, const JsonReader& state_key,
                const ExpectationReading& reading);

// These return false, and do nothing, where the entry does not have their key.

// {"max_violation": 1e-12}: of the constraints.
bool read_violation(ObjectReader& entry, const ExpectationReading& reading);

// {"max_imbalance": 1e-12}: how far any step is from the balance of energy; {"max_stage_imbalance": 1e-12}: from
// that of power at its stage.
bool read_imbalance(ObjectReader& entry, const ExpectationReading& reading, const char* name,
                    const char* description, double RunRecord::*greatest);

// {"mean": {"q": 0.5}, "at": 10, "tolerance": 1e-3} and {"standard_deviation": {…}, …}: of the members of an ensemble
// at the time of a row.
bool read_spread(ObjectReader& entry, const char* key, const std::string& name,
                 double EnsembleRecord::Spread::*number, const ExpectationReading& reading);

}  // namespace courant
