#include "courant/reading/expectation_reading.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {

bool ExpectationReading::is_quantity(const std::string& name, const JsonReader& place) const {
  if (std::find(quantities.begin(), quantities.end(), name) != quantities.end()) return true;
  place.problem("unknown observable or coordinate \"" + name + "\"" +
                did_you_mean(name, quantities));
  return false;
}

double ExpectationReading::moment(const JsonReader& key) const {
  if (key.value() == "end") return time ? time->end() : kUnknownValue;
  return key.number().value_or(kUnknownValue);
}

std::optional<double> ExpectationReading::constant(const JsonReader& key) const {
  const auto form = read_formula(key);
  const auto values =
      form ? evaluate_constants({{}, {*form}}, vocabulary.symbols({}), key.findings())
           : std::nullopt;
  return values ? std::optional((*values)[0]) : std::nullopt;
}

ExpectationResult compared(std::string pointer, std::string description, double value, double bound,
                           bool lower) {
  const std::string finding = std::isnan(value) ? kNotKnown
                                                : "is " + number_text(value) + "; " +
                                                      (lower ? "expected at least " : "allowed ") +
                                                      number_text(bound);
  return {std::move(pointer),
          std::move(description),
          lower ? value >= bound : value <= bound,
          value,
          bound,
          finding};
}

// Off by `deviation`: of one value, which is `found`, or the greatest along a run.
ExpectationResult deviating(std::string pointer, std::string description, double deviation,
                            double tolerance, std::optional<double> found) {
  ExpectationResult result =
      compared(std::move(pointer), std::move(description), deviation, tolerance);
  if (found || !std::isnan(deviation))
    result.finding = "is " + (found ? number_text(*found) + ", " : std::string()) + "off by " +
                     number_text(deviation, 3) + "; allowed " + number_text(tolerance);
  return result;
}

}  // namespace courant
