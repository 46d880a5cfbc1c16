// Experiments changed from outside: one value at one place, or several for a sweep.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "courant/reading/findings.hpp"

namespace courant {

// The value that a JSON pointer leads to in an experiment.
struct Setting {
  std::string pointer;
  Json value;
};

// `/json/pointer=VALUE`; VALUE is JSON or, where it is not, a text. Throws ExperimentError, whose
// `where` is `option` and the pointer.
Setting read_setting(const std::string& text, const std::string& option = "--set");

// Changes the document. The place may be new if what it is in is there; a word, as that of a method, is
// taken for an object that has it as its `type`. Throws ExperimentError with
// `option` and the pointer where it is not.
void apply_setting(const Setting& setting, Json& document, const std::string& option = "--set");

// The values that a place has one after the other.
struct ValueRange {
  std::string pointer;
  std::vector<Json> values;
  bool is_tied = false;  // changes together with the range before it, value by value
};

// `/json/pointer=a:b:n`, n numbers from a to b at equal distances, or `/json/pointer=v,w,…`, each
// as in a setting; commas inside brackets, braces and quotes do not separate. Throws
// ExperimentError.
ValueRange read_range(const std::string& text, const std::string& option = "--sweep");

// What places of an experiment are called beside each other: the ends of their pointers, as long as it takes to tell
// them apart, "step" of /time/step. An element of a list is called by its name where it has one: "R1/value" and
// "C1/value" of /system/elements/2/value and /system/elements/4/value.
std::vector<std::string> short_names(std::span<const std::string> pointers, const Json& document);

// The columns of a table of cases (comma-separated values, RFC 4180): its head has a JSON pointer for each column, a
// row a value for each, as in a setting. The ranges after the first are tied to it. `name` is that of the file, for
// messages. Throws ExperimentError.
std::vector<ValueRange> read_cases(std::string_view text, const std::string& name,
                                   const std::string& option = "--sweep");

// Every combination of a value of each range, where tied ranges are one; the last range changes fastest.
// Throws ExperimentError if there are more than 100,000.
std::vector<std::vector<Setting>> combinations(std::span<const ValueRange> ranges);

}  // namespace courant
