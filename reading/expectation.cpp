#include "courant/reading/expectation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// What all the readers of an entry need.
struct Reading {
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

  bool is_quantity(const std::string& name, const JsonReader& place) const {
    if (std::find(quantities.begin(), quantities.end(), name) != quantities.end()) return true;
    place.problem("unknown observable or coordinate \"" + name + "\"" +
                  did_you_mean(name, quantities));
    return false;
  }
};

const char* const kNotKnown = "is not known: the run did not come to it";

// passed = value ≤ bound, or value ≥ bound for a lower one; not for a value that is NaN.
ExpectationResult compared(std::string pointer, std::string description, double value, double bound,
                           bool lower = false) {
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
                            double tolerance, std::optional<double> found = std::nullopt) {
  ExpectationResult result =
      compared(std::move(pointer), std::move(description), deviation, tolerance);
  if (found || !std::isnan(deviation))
    result.finding = "is " + (found ? number_text(*found) + ", " : std::string()) + "off by " +
                     number_text(deviation, 3) + "; allowed " + number_text(tolerance);
  return result;
}

// A property of a quantity along a complete run, NaN if there is none.
double along(const RunRecord& record, const std::string& quantity,
             double (*property)(const QuantityRecord&)) {
  const auto found = record.quantities.find(quantity);
  return found != record.quantities.end() && record.completed ? property(found->second) : kUnknown;
}

// Whether something along a trajectory can be above and below the bound of its size; a problem if
// there is no trajectory, or the bound is below zero, or is a lower one of zero.
bool is_bound_of_change(const JsonReader& key, double bound, bool lower, const Reading& reading) {
  if (lower ? bound <= 0.0 : bound < 0.0) {
    key.expected(lower ? "a number greater than 0" : "a number that is at least 0");
    return false;
  }
  if (!reading.has_trajectory())
    key.problem(
        "tests nothing: there is no trajectory; expected \"method\" and \"time\", or another "
        "expectation");
  return reading.has_trajectory();
}

// {"observable": "H", "max_drift": 2e-4}: bounds of one quantity along the run.
void read_bounds(ObjectReader& entry, const JsonReader& name_key, const Reading& reading) {
  struct Bound {
    const char* key;
    const char* before;  // of the name in the description
    const char* after;
    double (*value)(const QuantityRecord&);
    bool lower;
    bool is_change;  // along a trajectory: not below zero
  };
  static constexpr Bound bounds[] = {
      {"max_drift", "greatest drift of ", "", [](const QuantityRecord& q) { return q.max_drift; },
       false, true},
      {"min_drift", "greatest drift of ", ", at least",
       [](const QuantityRecord& q) { return q.max_drift; }, true, true},
      {"max_slope", "drift of ", " per unit of time",
       [](const QuantityRecord& q) { return std::abs(q.slope); }, false, true},
      {"max", "greatest ", "", [](const QuantityRecord& q) { return q.max; }, false, false},
      {"min", "least ", "", [](const QuantityRecord& q) { return q.min; }, true, false},
  };
  const auto name = name_key.text();
  const bool known = name && reading.is_quantity(*name, name_key);
  bool any = false;
  for (const Bound& bound : bounds) {
    const auto key = entry.optional(bound.key);
    if (!key) continue;
    any = true;
    const auto limit = key->number();
    if (limit && bound.is_change && !is_bound_of_change(*key, *limit, bound.lower, reading))
      continue;
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
void expect_moment(const std::string& name, double expected, double at, double tolerance,
                   const std::string& pointer, const Reading& reading) {
  reading.expectations.checks.push_back([=](const RunRecord& record) {
    std::optional<double> found;
    if (const auto moment = record.moments.find(at); moment != record.moments.end())
      if (const auto value = moment->second.find(name); value != moment->second.end())
        found = value->second;
    return deviating(pointer, name + " = " + exact_text(expected) + " at t = " + exact_text(at),
                     std::abs(found.value_or(kUnknown) - expected), tolerance, found);
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
    return deviating(pointer, name + " = " + text + " at every step", deviation, tolerance);
  });
}

// A time, or "end".
double read_moment(const JsonReader& key, const Reading& reading) {
  if (key.value() == "end") return reading.time ? reading.time->end() : kUnknown;
  return key.number().value_or(kUnknown);
}

void read_state(ObjectReader& entry, const JsonReader& state_key, const Reading& reading) {
  const auto at_key = entry.optional("at");
  const double at = at_key ? read_moment(*at_key, reading) : kUnknown;
  const auto tolerance_key = entry.required("tolerance");
  const double tolerance =
      tolerance_key ? tolerance_key->positive_number().value_or(kUnknown) : kUnknown;
  if (!std::isnan(at) && reading.time && !reading.time->is_known_at(at)) {
    const std::string span =
        "from " + exact_text(reading.time->start) + " to " + exact_text(reading.time->end());
    at_key->expected(reading.time->is_transformed()
                         ? "a time " + span
                         : "the time of a step, " + span + " by " + exact_text(reading.time->step));
  }
  if (at_key && !reading.is_run)
    at_key->problem("there is no trajectory; expected \"method\" and \"time\", or no \"at\"");
  const auto entries = state_key.entries();
  if (!entries) return;
  if (entries->empty()) state_key.problem("is empty; expected values by name");
  Graph graph;
  const Expr t = graph.variable("t");
  const SymbolTable symbols = reading.vocabulary.symbols({.t = t});
  for (const auto& [name, value] : *entries) {
    const bool known = reading.is_quantity(name, value);
    const auto form = read_formula(value);
    if (!form || !check(*form, symbols, value.findings()) || !known) continue;
    const double when = at_key ? at : reading.time ? reading.time->start : 0.0;
    if (std::isnan(when)) continue;
    const double expected = evaluate(*form, reading.vocabulary.symbols({.t = Expr(when)})).value();
    if (!std::isfinite(expected))
      value.problem("is " + number_text(expected) + " at t = " + number_text(when) +
                    "; expected a finite number");
    else if (!at_key && !reading.has_trajectory() && !evaluate(*form, symbols).is_constant())
      value.problem(
          "changes with t, but there is no trajectory; expected \"method\" and \"time\", or a "
          "number");
    else if (!at_key)
      expect_form(name, *form, tolerance, entry.place().pointer(), reading);
    else
      expect_moment(name, expected, at, tolerance, entry.place().pointer(), reading);
  }
  if (!std::isnan(at)) reading.expectations.times.push_back(at);
}

// {"event": "perihelion", "number": 3, "time": "6*pi", "tolerance": 1e-4}: one occurrence.
void read_occurrence(ObjectReader& entry, const std::string& name, const Reading& reading) {
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
    const auto form = read_formula(value);
    if (!form) return;
    const auto constant =
        evaluate_constants({{}, {*form}}, reading.vocabulary.symbols({}), value.findings());
    if (!constant || !number || !tolerance) return;
    reading.expectations.occurrences[name].insert(static_cast<long>(*number));
    reading.expectations.checks.push_back(
        [=, expected = (*constant)[0], which = static_cast<long>(*number), bound = *tolerance,
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
              std::abs(found.value_or(kUnknown) - expected), bound, found);
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

// {"event": "perihelion", "count": 10}, and occurrences.
void read_event(ObjectReader& entry, const JsonReader& name_key, const Reading& reading) {
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

// The levels of a ladder as [[dim S₀, dim M₀], …], without those that only confirm the one before.
Json dimensions(const ConstraintLadder& ladder) {
  Json list = Json::array();
  for (const LadderLevel& level : ladder.levels) {
    const Json pair = level.is_empty ? Json{nullptr, nullptr} : Json{level.dim_S, level.dim_M};
    if (list.empty() || list.back() != pair) list.push_back(pair);
  }
  return list;
}

std::string value_in_words(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// A property of the ladder or of the solution of the boundary problem, `of` the run if it has one, that is to be this value.
template <class Found, class Value>
void expect_equal(const JsonReader& key, const std::string& description, const ObjectReader& entry,
                  const Found* RunRecord::*of, const Value& value, const Reading& reading) {
  reading.expectations.checks.push_back([=, bound = key.value(), pointer = entry.place().pointer()](
                                            const RunRecord& record) {
    ExpectationResult result{pointer, description, false, nullptr, bound, kNotKnown};
    const Found* found = record.*of;
    if (!found) return result;
    result.value = value(*found);
    result.passed = result.value == bound;
    result.finding = "is " + value_in_words(result.value) + "; expected " + value_in_words(bound);
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
// finds. A verdict that is doubted is not met but by {"verdict": "regular", "doubted": true}.
bool read_certificate(ObjectReader& entry, const Reading& reading) {
  bool any = false;
  const auto doubt = entry.optional("doubted");
  if (doubt && !doubt->value().is_boolean()) doubt->expected("true or false");
  const bool doubted = doubt && doubt->value() == true;
  if (const auto key = entry.optional("verdict")) {
    any = true;
    const auto verdict =
        key->word({"regular", "gauge", "inconsistent", "rank-change", "not-reached"});
    if (verdict) {
      if (*verdict == "inconsistent") reading.expectations.inconsistent = true;
      expect_equal(
          *key, std::string(doubted ? "doubted " : "") + "verdict of the constraint algorithm",
          entry, &RunRecord::ladder,
          [doubted](const ConstraintLadder& ladder) {
            const std::string found = to_string(ladder.verdict);
            if (ladder.is_ambiguous() == doubted) return found;
            return found + (doubted ? ", and not doubted" : ", but doubted");
          },
          reading);
    }
  }
  if (const auto key = entry.optional("ladder")) {
    any = true;
    if (is_dimension_list(*key))
      expect_equal(*key, "(dim S, dim M) of the ladder", entry, &RunRecord::ladder, dimensions,
                   reading);
  }
  for (const auto& [name, member] :
       {std::pair("index", &ConstraintLadder::index),
        std::pair("gauge_dimension", &ConstraintLadder::gauge_dimension),
        std::pair("degrees_of_freedom", &ConstraintLadder::degrees_of_freedom)}) {
    const auto key = entry.optional(name);
    if (!key) continue;
    any = true;
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (key->integer(0))
      expect_equal(
          *key, words + " of the ladder", entry, &RunRecord::ladder,
          [member = member](const ConstraintLadder& ladder) {
            const Index found = ladder.*member;
            return found < 0 ? Json() : Json(found);
          },
          reading);
  }
  return any;
}

bool read_violation(ObjectReader& entry, const Reading& reading) {
  const auto key = entry.optional("max_violation");
  if (!key) return false;
  const auto bound = key->number();
  if (bound && *bound < 0.0) {
    key->expected("a number that is at least 0");
  } else if (bound) {
    reading.expectations.violations.push_back(key->pointer());
    reading.expectations.checks.push_back(
        [bound = *bound, pointer = entry.place().pointer()](const RunRecord& record) {
          return compared(pointer, "greatest violation of the constraints",
                          record.completed ? record.max_violation : kUnknown, bound);
        });
  }
  return true;
}

// {"max_imbalance": 1e-12}: how far any step is from the balance of energy; {"max_stage_imbalance": 1e-12}: from
// that of power at its stage.
bool read_imbalance(ObjectReader& entry, const Reading& reading, const char* name,
                    const char* description, double RunRecord::*greatest) {
  const auto key = entry.optional(name);
  if (!key) return false;
  const auto bound = key->number();
  if (!bound) return true;
  if (!reading.has_powers) {
    key->problem(
        "tests nothing: the system is given by its equations, which do not say what they supply; "
        "expected another expectation");
  } else if (is_bound_of_change(*key, *bound, false, reading)) {
    reading.expectations.imbalance = true;
    reading.expectations.checks.push_back([bound = *bound, pointer = entry.place().pointer(),
                                           description, greatest](const RunRecord& record) {
      return compared(pointer, description, record.completed ? record.*greatest : kUnknown, bound);
    });
  }
  return true;
}

// {"duration": "4*pi", "tolerance": 1e-6} and {"multipliers": [2.5, 1, 1, 0.4], "tolerance": 1e-6}: numbers of the solution.
void read_numbers_of_solution(ObjectReader& entry, const Reading& reading) {
  const auto duration_key = entry.optional("duration");
  const auto multipliers_key = entry.optional("multipliers");
  if (!duration_key && !multipliers_key) return;
  const auto tolerance_key = entry.required("tolerance");
  const auto tolerance = tolerance_key ? tolerance_key->positive_number() : std::nullopt;
  const auto compare = [&](const JsonReader& value, const std::string& description,
                           std::function<double(const BoundarySolution&)> found) {
    const auto form = read_formula(value);
    const auto expected =
        form ? evaluate_constants({{}, {*form}}, reading.vocabulary.symbols({}), value.findings())
             : std::nullopt;
    if (!expected || !tolerance) return;
    reading.expectations.checks.push_back(
        [=, bound = *tolerance, number = (*expected)[0],
         pointer = entry.place().pointer()](const RunRecord& record) {
          const auto is = record.boundary ? std::optional(found(*record.boundary)) : std::nullopt;
          return deviating(pointer, description + " = " + exact_text(number),
                           std::abs(is.value_or(kUnknown) - number), bound, is);
        });
  };
  if (duration_key)
    compare(*duration_key, "duration",
            [](const BoundarySolution& solution) { return solution.duration(); });
  const auto values = multipliers_key ? multipliers_key->elements() : std::nullopt;
  if (values && values->empty()) multipliers_key->expected("moduli in descending order");
  for (std::size_t i = 0; values && i < values->size(); ++i)
    compare((*values)[i], "modulus of multiplier " + std::to_string(i + 1),
            [i = static_cast<Index>(i)](const BoundarySolution& solution) {
              return i < solution.floquet.size() ? std::abs(solution.floquet[i]) : kUnknown;
            });
}

// {"boundary": "isolated", "family_dimension": 0, "conjugate_points": 1, "duration": 2, "tolerance": 1e-6}: what is found
// of conditions at both ends.
bool read_solution(ObjectReader& entry, const Reading& reading) {
  const Json& object = entry.place().value();
  bool any = false;
  for (const char* key :
       {"boundary", "family_dimension", "conjugate_points", "duration", "multipliers"})
    any = any || object.contains(key);
  if (!any) return false;
  if (const auto key = entry.optional("boundary"); key && key->word({"isolated", "family"}))
    expect_equal(
        *key, "solution of the boundary problem", entry, &RunRecord::boundary,
        [](const BoundarySolution& solution) { return Json(to_string(solution.verdict)); },
        reading);
  if (const auto key = entry.optional("family_dimension"); key && key->integer(0))
    expect_equal(
        *key, "dimension of the family of solutions", entry, &RunRecord::boundary,
        [](const BoundarySolution& solution) { return Json(solution.family_dimension); }, reading);
  if (const auto key = entry.optional("conjugate_points"); key && key->integer(0))
    expect_equal(
        *key, "conjugate points", entry, &RunRecord::boundary,
        [](const BoundarySolution& solution) {
          return solution.conjugate_times ? Json(solution.conjugate_times->size()) : Json();
        },
        reading);
  read_numbers_of_solution(entry, reading);
  if (!reading.has_boundary)
    entry.place().problem(
        "tests nothing: there are no conditions at both ends; expected \"boundary\" beside "
        "\"initial\"");
  return true;
}

// {"mean": {"q": 0.5}, "at": 10, "tolerance": 1e-3} and {"standard_deviation": {…}, …}: of the members of an ensemble at
// the time of a row.
bool read_spread(ObjectReader& entry, const char* key, const std::string& name,
                 double EnsembleRecord::Spread::*number, const Reading& reading) {
  const auto values_key = entry.optional(key);
  if (!values_key) return false;
  const auto at_key = entry.optional("at"), tolerance_key = entry.required("tolerance");
  const double at = at_key         ? read_moment(*at_key, reading)
                    : reading.time ? reading.time->end()
                                   : kUnknown;
  const auto tolerance = tolerance_key ? tolerance_key->positive_number() : std::nullopt;
  if (!reading.has_ensemble)
    values_key->problem("is of an ensemble; expected \"ensemble\" beside \"initial\"");
  const auto entries = values_key->entries();
  if (!entries) return true;
  if (entries->empty()) values_key->problem("is empty; expected values by name");
  for (const auto& [quantity, value] : *entries) {
    const bool is_known = reading.is_quantity(quantity, value);
    const auto form = read_formula(value);
    const auto expected =
        form ? evaluate_constants({{}, {*form}}, reading.vocabulary.symbols({}), value.findings())
             : std::nullopt;
    if (!is_known || !expected || !tolerance || std::isnan(at)) continue;
    reading.expectations.ensemble_checks.push_back(
        [=, quantity = quantity, wanted = (*expected)[0], bound = *tolerance,
         pointer = entry.place().pointer()](const EnsembleRecord& record) {
          const double is = record.spread(quantity, at).*number;
          return deviating(
              pointer,
              name + " of " + quantity + " at t = " + exact_text(at) + " = " + exact_text(wanted),
              std::abs(is - wanted), bound, std::isnan(is) ? std::nullopt : std::optional(is));
        });
  }
  return true;
}

void read_entry(const JsonReader& value, const Reading& reading) {
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

std::optional<long> TimeSpan::step_at(double t) const {
  if (rate) return std::nullopt;
  const double k = std::round((t - start) / step);
  if (!(k >= 0.0 && k <= static_cast<double>(steps))) return std::nullopt;
  const long whole = static_cast<long>(k);
  if (std::abs(time(whole) - t) > 1e-9 * step + 1e-15 * std::abs(t)) return std::nullopt;
  return whole;
}

bool TimeSpan::is_known_at(double t) const {
  return rate ? t >= start && t <= until : step_at(t).has_value();
}

Expectations read_expectations(const JsonReader& expect, const Vocabulary& vocabulary,
                               const std::vector<std::string>& quantities,
                               const std::vector<std::string>& events,
                               const std::optional<TimeSpan>& time, bool is_run, bool has_boundary,
                               bool has_ensemble, bool has_powers) {
  Expectations expectations;
  const auto entries = expect.elements();
  if (!entries) return expectations;
  const Reading reading{vocabulary,   quantities,   events,     time,        is_run,
                        has_boundary, has_ensemble, has_powers, expectations};
  for (const JsonReader& entry : *entries) read_entry(entry, reading);
  return expectations;
}

}  // namespace courant
