#include "courant/reading/expectation_entries.hpp"

#include "courant/reading/expectation_of_events.hpp"
#include "courant/reading/expectation_of_quantities.hpp"
#include "courant/reading/expectation_of_solutions.hpp"
#include "courant/reading/expectation_reading.hpp"

namespace courant {
namespace {

void read_entry(const JsonReader& value, const ExpectationReading& reading) {
  ObjectReader entry(value);
  if (!value.value().is_object()) return;
  if (const auto name = entry.optional("observable")) return read_bounds(entry, *name, reading);
  if (const auto event = entry.optional("event")) return read_event(entry, *event, reading);
  if (const auto state = entry.optional("state")) return read_state(entry, *state, reading);
  if (read_spread(entry, "mean", "mean", &EnsembleRecord::Spread::mean, reading)) return;
  if (read_spread(entry, "standard_deviation", "standard deviation",
                  &EnsembleRecord::Spread::standard_deviation, reading))
    return;
  const bool solution = read_solution(entry, reading);
  const bool certificate = read_certificate(entry, reading);
  const bool violation = read_violation(entry, reading);
  const bool imbalance =
      read_imbalance(entry, reading, "max_imbalance", "greatest imbalance of energy in a step",
                     &RunRecord::max_imbalance);
  const bool stage_imbalance = read_imbalance(entry, reading, "max_stage_imbalance",
                                              "greatest imbalance of power at the stage of a step",
                                              &RunRecord::max_stage_imbalance);
  if (!solution && !certificate && !violation && !imbalance && !stage_imbalance &&
      value.value().empty())
    value.problem(
        "expects nothing; expected \"observable\", \"state\", \"event\", \"verdict\", \"ladder\", "
        "\"max_violation\", \"max_imbalance\", \"max_stage_imbalance\", \"boundary\", "
        "\"duration\", "
        "\"multipliers\", \"mean\" or \"standard_deviation\"");
}

}  // namespace

Expectations read_expectations(const JsonReader& expect, const Vocabulary& vocabulary,
                               const std::vector<std::string>& quantities,
                               const std::vector<std::string>& events,
                               const std::optional<TimeSpan>& time, bool is_run, bool has_boundary,
                               bool has_ensemble, bool has_powers) {
  Expectations expectations;
  const auto entries = expect.elements();
  if (!entries) return expectations;
  const ExpectationReading reading{vocabulary,   quantities,   events,     time,        is_run,
                                   has_boundary, has_ensemble, has_powers, expectations};
  for (const JsonReader& entry : *entries) read_entry(entry, reading);
  return expectations;
}

}  // namespace courant
