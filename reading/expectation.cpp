#include "courant/reading/expectation.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "courant/core/spelling.hpp"

namespace courant {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::string digits(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

// What all the readers of an entry need.
struct Reading {
  const Vocabulary& vocabulary;
  const std::vector<std::string>& quantities;
  const std::optional<TimeSpan>& time;
  Expectations& expectations;

  bool is_quantity(const std::string& name, const JsonReader& place) const {
    if (std::find(quantities.begin(), quantities.end(), name) != quantities.end()) return true;
    place.problem("unknown observable or coordinate \"" + name + "\"" +
                  did_you_mean(name, quantities));
    return false;
  }
};

// passed = value ≤ bound, or value ≥ bound for a lower one; not for a value that is NaN.
ExpectationResult compared(std::string pointer, std::string description, double value, double bound,
                           bool lower = false) {
  return {std::move(pointer), std::move(description), lower ? value >= bound : value <= bound,
          value, bound};
}

// A property of a quantity along a complete run, NaN if there is none.
double along(const RunRecord& record, const std::string& quantity,
             double (*property)(const QuantityRecord&)) {
  const auto found = record.quantities.find(quantity);
  return found != record.quantities.end() && record.completed ? property(found->second) : kUnknown;
}

// {"observable": "H", "max_drift": 2e-4}: bounds of one quantity along the run.
void read_bounds(ObjectReader& entry, const JsonReader& name_key, const Reading& reading) {
  struct Bound {
    const char* key;
    const char* before;  // of the name in the description
    const char* after;
    double (*value)(const QuantityRecord&);
    bool lower;
  };
  static constexpr Bound bounds[] = {
      {"max_drift", "greatest drift of ", "", [](const QuantityRecord& q) { return q.max_drift; },
       false},
      {"min_drift", "greatest drift of ", ", at least",
       [](const QuantityRecord& q) { return q.max_drift; }, true},
      {"max_slope", "drift of ", " per unit of time",
       [](const QuantityRecord& q) { return std::abs(q.slope); }, false},
      {"max", "greatest ", "", [](const QuantityRecord& q) { return q.max; }, false},
      {"min", "least ", "", [](const QuantityRecord& q) { return q.min; }, true},
  };
  const auto name = name_key.text();
  const bool known = name && reading.is_quantity(*name, name_key);
  bool any = false;
  for (const Bound& bound : bounds) {
    const auto key = entry.optional(bound.key);
    if (!key) continue;
    any = true;
    const auto limit = key->number();
    if (!limit || !known) continue;
    reading.expectations.checks.push_back(
        [=, name = *name, limit = *limit,
         pointer = entry.place().pointer()](const RunRecord& record) {
          return compared(pointer, bound.before + name + bound.after,
                          along(record, name, bound.value), limit, bound.lower);
        });
  }
  if (!any)
    entry.place().problem(
        "has no bound; expected \"max_drift\", \"min_drift\", \"max_slope\", \"min\" or \"max\"");
}

// {"at": 300, "state": {"x[0]": 24.47}}: values at one time.
void expect_moment(const std::string& name, const WrittenFormula& form, double at, double tolerance,
                   const std::string& pointer, const Reading& reading) {
  const double expected = evaluate(form, reading.vocabulary.symbols({.t = Expr(at)})).value();
  reading.expectations.checks.push_back([=](const RunRecord& record) {
    double difference = kUnknown;
    if (const auto moment = record.moments.find(at); moment != record.moments.end())
      if (const auto value = moment->second.find(name); value != moment->second.end())
        difference = std::abs(value->second - expected);
    return compared(pointer, name + " = " + digits(expected) + " at t = " + digits(at), difference,
                    tolerance);
  });
}

// {"state": {"q": "cos(t)"}}: a closed form at every step.
void expect_form(const std::string& name, const WrittenFormula& form, double tolerance,
                 const std::string& pointer, const Reading& reading) {
  auto& deviations = reading.expectations.deviations;
  const std::string key = "deviation[" + std::to_string(deviations.size()) + "]";
  deviations.push_back({key, name, form});
  reading.expectations.checks.push_back([=, text = form.text](const RunRecord& record) {
    const double deviation = along(record, key, [](const QuantityRecord& q) { return q.max; });
    return compared(pointer, name + " = " + text + " at every step", deviation, tolerance);
  });
}

void read_state(ObjectReader& entry, const JsonReader& state_key, const Reading& reading) {
  const auto at_key = entry.optional("at");
  const double at = at_key ? at_key->number().value_or(kUnknown) : kUnknown;
  const auto tolerance_key = entry.required("tolerance");
  const double tolerance =
      tolerance_key ? tolerance_key->positive_number().value_or(kUnknown) : kUnknown;
  if (!std::isnan(at) && reading.time && !reading.time->step_at(at)) {
    at_key->expected("the time of a step, from " + digits(reading.time->start) + " to " +
                     digits(reading.time->end()) + " by " + digits(reading.time->step));
  }
  const auto entries = state_key.entries();
  if (!entries) return;
  Graph graph;
  const SymbolTable symbols = reading.vocabulary.symbols({.t = graph.variable("t")});
  for (const auto& [name, value] : *entries) {
    const bool known = reading.is_quantity(name, value);
    const auto form = read_formula(value);
    if (!form || !check(*form, symbols, value.findings()) || !known) continue;
    if (!at_key)
      expect_form(name, *form, tolerance, entry.place().pointer(), reading);
    else if (!std::isnan(at))
      expect_moment(name, *form, at, tolerance, entry.place().pointer(), reading);
  }
  if (!std::isnan(at)) reading.expectations.times.push_back(at);
}

// The levels of a ladder as [[dim S₀, dim M₀], …], without those that only confirm the one before.
Json dimensions(const Json& ladder) {
  Json list = Json::array();
  if (ladder.is_null()) return list;
  for (const Json& level : ladder.at("levels")) {
    const Json pair{level.at("dim_S"), level.at("dim_M")};
    if (list.empty() || list.back() != pair) list.push_back(pair);
  }
  return list;
}

void expect_equal(const JsonReader& key, const std::string& description, const ObjectReader& entry,
                  std::function<Json(const Json& ladder)> value, const Reading& reading) {
  reading.expectations.checks.push_back(
      [=, bound = key.value(), pointer = entry.place().pointer()](const RunRecord& record) {
        ExpectationResult result{pointer, description, false, nullptr, bound};
        if (!record.ladder.is_null()) result.value = value(record.ladder);
        result.passed = result.value == bound;
        return result;
      });
}

bool is_dimension_list(const JsonReader& key) {
  const auto levels = key.elements();
  if (!levels) return false;
  bool right = !levels->empty();
  for (const JsonReader& level : *levels) {
    const auto pair = level.elements();
    if (!pair) return false;
    right = right && pair->size() == 2;
    for (const JsonReader& dimension : *pair)
      if (!dimension.value().is_null()) right = right && dimension.integer(0);
  }
  if (!right) key.expected("pairs [dim S, dim M] such as [[16, 8], [8, 8]], null for an empty set");
  return right;
}

// {"verdict": "regular", "ladder": [[16, 8], [8, 8]], "index": 1}: what the constraint algorithm
// finds.
bool read_certificate(ObjectReader& entry, const Reading& reading) {
  bool any = false;
  if (const auto key = entry.optional("verdict")) {
    any = true;
    const auto verdict =
        key->word({"regular", "gauge", "inconsistent", "rank-change", "not-reached"});
    if (verdict) {
      if (*verdict == "inconsistent") reading.expectations.inconsistent = true;
      expect_equal(
          *key, "verdict of the constraint algorithm", entry,
          [](const Json& ladder) { return ladder.at("verdict"); }, reading);
    }
  }
  if (const auto key = entry.optional("ladder")) {
    any = true;
    if (is_dimension_list(*key))
      expect_equal(*key, "(dim S, dim M) of the ladder", entry, dimensions, reading);
  }
  for (const char* name : {"index", "gauge_dimension", "degrees_of_freedom"}) {
    const auto key = entry.optional(name);
    if (!key) continue;
    any = true;
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (key->integer(0))
      expect_equal(
          *key, words + " of the ladder", entry,
          [name](const Json& ladder) { return ladder.value(name, Json()); }, reading);
  }
  return any;
}

bool read_violation(ObjectReader& entry, const Reading& reading) {
  const auto key = entry.optional("max_violation");
  if (!key) return false;
  if (const auto bound = key->number())
    reading.expectations.checks.push_back(
        [bound = *bound, pointer = entry.place().pointer()](const RunRecord& record) {
          return compared(pointer, "greatest violation of the constraints",
                          record.completed ? record.max_violation : kUnknown, bound);
        });
  return true;
}

void read_entry(const JsonReader& value, const Reading& reading) {
  ObjectReader entry(value);
  if (!value.value().is_object()) return;
  if (const auto name = entry.optional("observable")) return read_bounds(entry, *name, reading);
  if (const auto state = entry.optional("state")) return read_state(entry, *state, reading);
  const bool certificate = read_certificate(entry, reading);
  const bool violation = read_violation(entry, reading);
  if (!certificate && !violation && value.value().empty())
    value.problem(
        "expects nothing; expected \"observable\", \"state\", \"verdict\", \"ladder\" or "
        "\"max_violation\"");
}

}  // namespace

std::optional<long> TimeSpan::step_at(double t) const {
  const double k = std::round((t - start) / step);
  if (!(k >= 0.0 && k <= static_cast<double>(steps))) return std::nullopt;
  const long whole = static_cast<long>(k);
  if (std::abs(time(whole) - t) > 1e-9 * step + 1e-15 * std::abs(t)) return std::nullopt;
  return whole;
}

Expectations read_expectations(const JsonReader& expect, const Vocabulary& vocabulary,
                               const std::vector<std::string>& quantities,
                               const std::optional<TimeSpan>& time) {
  Expectations expectations;
  const auto entries = expect.elements();
  if (!entries) return expectations;
  const Reading reading{vocabulary, quantities, time, expectations};
  for (const JsonReader& entry : *entries) read_entry(entry, reading);
  return expectations;
}

}  // namespace courant
