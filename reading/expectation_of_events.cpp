#include "courant/reading/expectation_of_events.hpp"

#include <cmath>
#include <optional>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {
namespace {

// {"event": "perihelion", "number": 3, "time": "6*pi", "tolerance": 1e-4}: one occurrence.
void read_occurrence(ObjectReader& entry, const std::string& name,
                     const ExpectationReading& reading) {
  const auto number_key = entry.optional("number");
  const auto time_key = entry.optional("time"), state_key = entry.optional("state");
  auto tolerance_key = entry.optional("tolerance");
  if (!number_key && !time_key && !state_key) return;
  const auto number = number_key ? number_key->integer(1) : std::optional<Index>(1);
  if (!tolerance_key) tolerance_key = entry.required("tolerance");
  const auto tolerance = tolerance_key ? tolerance_key->positive_number() : std::nullopt;
  if (!time_key && !state_key)
    number_key->problem("tests nothing; expected \"time\" or \"state\" beside it");
  const auto compare = [&](const std::string& quantity, const JsonReader& value) {
    const auto constant = reading.constant(value);
    if (!constant || !number || !tolerance) return;
    reading.expectations.occurrences[name].insert(static_cast<long>(*number));
    reading.expectations.checks.push_back(
        [=, expected = *constant, which = static_cast<long>(*number), bound = *tolerance,
         pointer = entry.place().pointer()](const RunRecord& record) {
          std::optional<double> found;
          if (const auto event = record.events.find(name); event != record.events.end())
            if (const auto at = event->second.occurrences.find(which);
                at != event->second.occurrences.end())
              if (const auto it = at->second.find(quantity); it != at->second.end())
                found = it->second;
          return deviating(
              pointer,
              quantity + " = " + exact_text(expected) + " at " + name + " " + std::to_string(which),
              std::abs(found.value_or(kUnknownValue) - expected), bound, found);
        });
  };
  if (time_key) compare("t", *time_key);
  if (!state_key) return;
  const auto entries = state_key->entries();
  if (!entries) return;
  if (entries->empty()) state_key->problem("is empty; expected values by name");
  for (const auto& [quantity, value] : *entries)
    if (reading.is_quantity(quantity, value)) compare(quantity, value);
}

}  // namespace

void read_event(ObjectReader& entry, const JsonReader& name_key,
                const ExpectationReading& reading) {
  const auto name = name_key.text();
  const bool known = name && std::ranges::find(reading.events, *name) != reading.events.end();
  if (name && !known)
    name_key.problem("unknown event \"" + *name + '"' + did_you_mean(*name, reading.events));
  const auto count_key = entry.optional("count");
  if (const auto count = count_key ? count_key->integer(0) : std::nullopt; count && known)
    reading.expectations.checks.push_back([name = *name, count = static_cast<long>(*count),
                                           pointer =
                                               entry.place().pointer()](const RunRecord& record) {
      const auto event = record.events.find(name);
      ExpectationResult result{pointer, "occurrences of " + name, false, nullptr, count, kNotKnown};
      if (!record.completed || event == record.events.end()) return result;
      result.value = event->second.count;
      result.passed = event->second.count == count;
      result.finding =
          "is " + std::to_string(event->second.count) + "; expected " + std::to_string(count);
      return result;
    });
  const auto has = [&](const char* key) { return entry.place().value().contains(key); };
  if (!count_key && !has("number") && !has("time") && !has("state"))
    entry.place().problem("expects nothing; expected \"count\", \"time\" or \"state\"");
  read_occurrence(entry, name.value_or(""), reading);
}

}  // namespace courant
