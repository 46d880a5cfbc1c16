#include "courant/reading/expectation_of_quantities.hpp"

#include <cmath>
#include <optional>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// A property of a quantity along a complete run, NaN if there is none.
double along(const RunRecord& record, const std::string& quantity,
             double (*property)(const QuantityRecord&)) {
  const auto found = record.quantities.find(quantity);
  return found != record.quantities.end() && record.completed ? property(found->second)
                                                              : kUnknownValue;
}

// Whether something along a trajectory can be above and below the bound of its size; a problem if
// there is no trajectory, or the bound is below zero, or is a lower one of zero.
bool is_bound_of_change(const JsonReader& key, double bound, bool lower,
                        const ExpectationReading& reading) {
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

// {"at": 300, "state": {"x[0]": 24.47}}: values at one time.
void expect_moment(const std::string& name, double expected, double at, double tolerance,
                   const std::string& pointer, const ExpectationReading& reading) {
  reading.expectations.checks.push_back([=](const RunRecord& record) {
    std::optional<double> found;
    if (const auto moment = record.moments.find(at); moment != record.moments.end())
      if (const auto value = moment->second.find(name); value != moment->second.end())
        found = value->second;
    return deviating(pointer, name + " = " + exact_text(expected) + " at t = " + exact_text(at),
                     std::abs(found.value_or(kUnknownValue) - expected), tolerance, found);
  });
}

// {"state": {"q": "cos(t)"}}: a closed form at every step.
void expect_form(const std::string& name, const WrittenFormula& form, double tolerance,
                 const std::string& pointer, const ExpectationReading& reading) {
  auto& deviations = reading.expectations.deviations;
  const std::string key = "deviation[" + std::to_string(deviations.size()) + "]";
  deviations.push_back({key, name, form});
  reading.expectations.checks.push_back([=, text = form.text](const RunRecord& record) {
    const double deviation = along(record, key, [](const QuantityRecord& q) { return q.max; });
    return deviating(pointer, name + " = " + text + " at every step", deviation, tolerance);
  });
}

}  // namespace

void read_bounds(ObjectReader& entry, const JsonReader& name_key,
                 const ExpectationReading& reading) {
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

void read_state(ObjectReader& entry, const JsonReader& state_key,
                const ExpectationReading& reading) {
  const auto at_key = entry.optional("at");
  const double at = at_key ? reading.moment(*at_key) : kUnknownValue;
  const auto tolerance_key = entry.required("tolerance");
  const double tolerance =
      tolerance_key ? tolerance_key->positive_number().value_or(kUnknownValue) : kUnknownValue;
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

bool read_violation(ObjectReader& entry, const ExpectationReading& reading) {
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
                          record.completed ? record.max_violation : kUnknownValue, bound);
        });
  }
  return true;
}

bool read_imbalance(ObjectReader& entry, const ExpectationReading& reading, const char* name,
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
      return compared(pointer, description, record.completed ? record.*greatest : kUnknownValue,
                      bound);
    });
  }
  return true;
}

bool read_spread(ObjectReader& entry, const char* key, const std::string& name,
                 double EnsembleRecord::Spread::*number, const ExpectationReading& reading) {
  const auto values_key = entry.optional(key);
  if (!values_key) return false;
  const auto at_key = entry.optional("at"), tolerance_key = entry.required("tolerance");
  const double at = at_key         ? reading.moment(*at_key)
                    : reading.time ? reading.time->end()
                                   : kUnknownValue;
  const auto tolerance = tolerance_key ? tolerance_key->positive_number() : std::nullopt;
  if (!reading.has_ensemble)
    values_key->problem("is of an ensemble; expected \"ensemble\" beside \"initial\"");
  const auto entries = values_key->entries();
  if (!entries) return true;
  if (entries->empty()) values_key->problem("is empty; expected values by name");
  for (const auto& [quantity, value] : *entries) {
    const bool is_known = reading.is_quantity(quantity, value);
    const auto expected = reading.constant(value);
    if (!is_known || !expected || !tolerance || std::isnan(at)) continue;
    reading.expectations.ensemble_checks.push_back(
        [=, quantity = quantity, wanted = *expected, bound = *tolerance,
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

}  // namespace courant
