// What the readers of an entry of `expect` share.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "courant/reading/expectation.hpp"
#include "courant/reading/json_reader.hpp"

namespace courant {

// What is known of the experiment, and where the check of an entry goes.
struct ExpectationReading {
  const Vocabulary& vocabulary;
  const std::vector<std::string>& quantities;
  const std::vector<std::string>& events;
  const std::optional<TimeSpan>& time;
  bool is_run;  // there are to be steps, even if their time could not be read
  bool has_boundary;
  bool has_ensemble;
  bool has_powers;
  Expectations& expectations;

  // Whether there are steps along which something could drift.
  bool has_trajectory() const { return is_run && !(time && time->steps == 0); }

  // If not, that is a problem at this place.
  bool is_quantity(const std::string& name, const JsonReader& place) const;
  // A time, or "end"; NaN, and a problem, for what is none.
  double moment(const JsonReader& key) const;
  // The value of a formula of constants; nothing, and problems, where it has none.
  std::optional<double> constant(const JsonReader& key) const;
};

inline constexpr double kUnknownValue = std::numeric_limits<double>::quiet_NaN();
inline constexpr const char* kNotKnown = "is not known: the run did not come to it";

// passed = value ≤ bound, or value ≥ bound for a lower one; not for a value that is NaN.
ExpectationResult compared(std::string pointer, std::string description, double value, double bound,
                           bool lower = false);

// Off by `deviation`: of one value, which is `found`, or the greatest along a run.
ExpectationResult deviating(std::string pointer, std::string description, double deviation,
                            double tolerance, std::optional<double> found = std::nullopt);

}  // namespace courant
