// The entries of `expect`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/reading/expectation.hpp"
#include "courant/reading/json_reader.hpp"

namespace courant {

// Reads the array `expect`; `quantities` are the names of coordinates and observables, `events` those of events;
// `is_run` where there are to be steps, though `time` is nothing if it cannot be read; `has_boundary` if it is sought
// by conditions at both ends; `has_ensemble` if there are many of them; `has_powers` if the system is an EnergySystem.
// What would pass or fail whatever the run does is a problem: drifts where there is no trajectory, bounds below zero of
// what cannot be, values that are not finite.
Expectations read_expectations(const JsonReader& expect, const Vocabulary& vocabulary,
                               const std::vector<std::string>& quantities,
                               const std::vector<std::string>& events,
                               const std::optional<TimeSpan>& time, bool is_run, bool has_boundary,
                               bool has_ensemble, bool has_powers);

}  // namespace courant
