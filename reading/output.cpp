#include "courant/reading/output.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {
namespace {

using Entries = std::map<std::string, std::string, std::less<>>;

// A moment this part of a step from a step is that step.
constexpr double kSame = 1e-9;

// Quantities and the arrays that they are elements of.
std::vector<std::string> names_of(const std::vector<std::string>& quantities) {
  std::vector<std::string> names = {"t"};
  std::unordered_set<std::string> known = {"t"};
  for (std::string name : quantities)
    for (;;) {
      if (known.insert(name).second) names.push_back(name);
      const std::size_t bracket = name.rfind('[');
      if (bracket == std::string::npos) break;
      name.erase(bracket);
    }
  return names;
}

std::optional<std::vector<std::string>> first(std::optional<std::vector<std::string>> quantities,
                                              std::size_t count) {
  if (quantities) quantities->resize(count);
  return quantities;
}

std::set<std::string, std::less<>> read_coordinates(
    const JsonReader& value, const std::optional<std::vector<std::string>>& coordinates) {
  std::set<std::string, std::less<>> found;
  const auto entries = value.elements();
  if (!entries) return found;
  const std::vector<std::string> names =
      coordinates ? names_of(*coordinates) : std::vector<std::string>();
  for (const JsonReader& entry : *entries) {
    const auto name = entry.text();
    if (!name) continue;
    if (coordinates && (*name == "t" || std::ranges::find(names, *name) == names.end()))
      entry.problem("there is no such coordinate" + did_you_mean(*name, names));
    else
      found.insert(*name);
  }
  return found;
}

Entries read_texts(const std::optional<JsonReader>& value,
                   const std::optional<std::vector<std::string>>& quantities,
                   const std::string& forbidden, const std::string& expected) {
  Entries found;
  if (!value) return found;
  const auto entries = value->entries();
  if (!entries) return found;
  const std::vector<std::string> names =
      quantities ? names_of(*quantities) : std::vector<std::string>();
  for (const auto& [name, entry] : *entries) {
    if (quantities && std::ranges::find(names, name) == names.end())
      entry.problem("there is no such quantity" + did_you_mean(name, names) +
                    "; expected t, a coordinate, H or an observable");
    const auto text = entry.text();
    if (!text) continue;
    const bool is_plain = std::ranges::all_of(
        *text, [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; });
    if (text->empty() || !is_plain || text->find_first_of(forbidden) != std::string::npos)
      entry.expected(expected);
    else
      found[name] = *text;
  }
  return found;
}

std::vector<double> read_times(const JsonReader& value, const SymbolTable& constants,
                               const std::optional<TimeSpan>& time) {
  std::vector<double> times;
  const auto entries = value.elements();
  if (!entries) return times;
  for (const JsonReader& entry : *entries) {
    const auto formula = read_formula(entry);
    if (!formula) continue;
    const auto number = evaluate_constants({{}, {*formula}}, constants, value.findings());
    if (!number) continue;
    const double t = (*number)[0];
    const double slack = time ? kSame * time->step : 0.0;
    if (time && !(t >= time->start - slack && t <= time->end() + slack))
      entry.expected("a time from " + exact_text(time->start) + " to " + exact_text(time->end()));
    else
      times.push_back(t);
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

// The step that a time is at, or the number of steps before it and a part of one.
double steps_before(double t, const TimeSpan& time) { return (t - time.start) / time.step; }

bool is_at_step(double t, const TimeSpan& time) {
  const double steps = steps_before(t, time);
  return std::abs(steps - std::round(steps)) <= kSame;
}

}  // namespace

const std::string* entry_of(const std::map<std::string, std::string, std::less<>>& entries,
                            const std::string& quantity) {
  for (std::string name = quantity;;) {
    if (const auto found = entries.find(name); found != entries.end()) return &found->second;
    const std::size_t bracket = name.rfind('[');
    if (bracket == std::string::npos) return nullptr;
    name.erase(bracket);
  }
}

std::string Output::heading(const std::string& quantity) const {
  const std::string* unit = entry_of(units, quantity);
  return unit ? quantity + " [" + *unit + "]" : quantity;
}

bool Output::has_column(const std::string& coordinate) const {
  if (!coordinates) return true;
  for (std::string name = coordinate;;) {
    if (coordinates->contains(name)) return true;
    const std::size_t bracket = name.rfind('[');
    if (bracket == std::string::npos) return false;
    name.erase(bracket);
  }
}

bool Output::is_written(long k, const TimeSpan& time) const {
  if (k == 0 || k == time.steps) return true;
  if (time.is_transformed() && !at.empty()) return false;
  if (at.empty()) return k % every == 0;
  return std::ranges::any_of(
      at, [&](double t) { return is_at_step(t, time) && std::lround(steps_before(t, time)) == k; });
}

std::vector<double> Output::between(long k, const TimeSpan& time) const {
  std::vector<double> found;
  if (time.is_transformed()) return found;
  for (const double t : at)
    if (!is_at_step(t, time) && std::ceil(steps_before(t, time)) == static_cast<double>(k))
      found.push_back(t);
  return found;
}

std::string without_unit(const std::string& heading) {
  const std::size_t unit = heading.find(" [");
  return unit == std::string::npos || !heading.ends_with(']') ? heading : heading.substr(0, unit);
}

std::optional<JsonReader> interval_of(const std::optional<JsonReader>& output) {
  if (!output || !output->value().is_object() || !output->value().contains("interval"))
    return std::nullopt;
  return JsonReader(output->value().at("interval"), output->pointer() + "/interval",
                    output->findings());
}

// How many steps a time between rows is: a whole number.
long steps_of_interval(const JsonReader& interval, const SymbolTable& constants,
                       const std::optional<TimeSpan>& time) {
  const auto formula = read_formula(interval);
  const auto number =
      formula ? evaluate_constants({{}, {*formula}}, constants, interval.findings()) : std::nullopt;
  if (!number || !time) return 1;
  const double steps = (*number)[0] / time->step, whole = std::round(steps);
  // Of the end of the run, which may be no whole number of intervals, the step is a part.
  constexpr double slack = 1e-3;
  if (whole >= 1.0 && std::abs(steps - whole) <= slack * whole) return static_cast<long>(whole);
  interval.problem("is " + exact_text(steps) + " steps; expected a whole number of them");
  return 1;
}

Output read_output(const JsonReader& value, const SymbolTable& constants,
                   const std::optional<std::vector<std::string>>& quantities,
                   std::size_t coordinates, const std::optional<TimeSpan>& time) {
  ObjectReader object(value);
  Output output;
  const auto every = object.optional("every"), at = object.optional("at"),
             interval = object.optional("interval");
  if (every)
    output.every = static_cast<long>(every->integer(1).value_or(1));
  else if (interval)
    output.every = steps_of_interval(*interval, constants, time);
  else if (!at)
    object.default_value("every", 1);
  if (interval && (every || at))
    interval->problem("stands beside \"every\" or \"at\"; expected one of them");
  if (at) {
    if (every) at->problem("stands beside \"every\"; expected one of them");
    output.at = read_times(*at, constants, time);
  }
  output.epoch = object.integer("epoch", output.epoch, 1);
  if (object.word("format", "csv", {"csv", "npy"}) == "npy") output.format = Output::Format::npy;
  if (const auto written = object.optional("coordinates"))
    output.coordinates = read_coordinates(*written, first(quantities, coordinates));
  output.units = read_texts(object.optional("units"), quantities, ",\"[]",
                            "a unit without comma, quotes and brackets, such as \"kg m/s\"");
  output.labels = read_texts(object.optional("labels"), quantities, "", "a text in one line");
  return output;
}

}  // namespace courant
