// Output: how the trajectory of a run is written.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "courant/core/language/symbol_table.hpp"
#include "courant/reading/expectation.hpp"

namespace courant {

// Rows at every so many steps, or at given times, in any case at the first and the last step; and
// what the quantities of the columns are measured in and called.
struct Output {
  enum class Format { csv, npy };
  Format format = Format::csv;
  long every = 1;     // steps a row
  long epoch = 4096;  // steps after which the workspace of the method is forgotten
  // Where not empty, in place of that: times of rows, rising, which need not be those of steps.
  std::vector<double> at;
  // The coordinates, or arrays for all of their elements, that have columns in the trajectory; all where
  // nothing is said. Everything else that is written has its column in any case.
  std::optional<std::set<std::string, std::less<>>> coordinates;
  // Of quantities, or of arrays for all of their elements.
  std::map<std::string, std::string, std::less<>> units, labels;

  // "q [m]" with a unit, "q" without: what stands at the head of a column.
  std::string heading(const std::string& quantity) const;

  bool has_column(const std::string& coordinate) const;
  // Whether a run writes the row of step k, and the times of rows between step k - 1 and step k. In
  // transformed time only the run knows which step is the last, and between which `at` falls.
  bool is_written(long k, const TimeSpan& time) const;
  std::vector<double> between(long k, const TimeSpan& time) const;
};

// The name of a column without the unit that its head has.
std::string without_unit(const std::string& heading);

// What `entries` has for a quantity or for an array that it is of: "r[3]", then "r" for "r[3][2]".
const std::string* entry_of(const std::map<std::string, std::string, std::less<>>& entries,
                            const std::string& quantity);

// The key `interval` of the object: the time between rows.
std::optional<JsonReader> interval_of(const std::optional<JsonReader>& output);

// Reads the object `output`. `quantities`, of which `coordinates` are the first, and `time` are nothing
// where they cannot be read; formulas of times may have `constants`.
Output read_output(const JsonReader& value, const SymbolTable& constants,
                   const std::optional<std::vector<std::string>>& quantities,
                   std::size_t coordinates, const std::optional<TimeSpan>& time);

}  // namespace courant
