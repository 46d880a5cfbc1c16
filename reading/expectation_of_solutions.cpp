#include "courant/reading/expectation_of_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

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
                  const Found* RunRecord::*of, const Value& value,
                  const ExpectationReading& reading) {
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

// {"duration": "4*pi", "tolerance": 1e-6} and {"multipliers": [2.5, 1, 1, 0.4], "tolerance": 1e-6}: numbers of the solution.
void read_numbers_of_solution(ObjectReader& entry, const ExpectationReading& reading) {
  const auto duration_key = entry.optional("duration");
  const auto multipliers_key = entry.optional("multipliers");
  if (!duration_key && !multipliers_key) return;
  const auto tolerance_key = entry.required("tolerance");
  const auto tolerance = tolerance_key ? tolerance_key->positive_number() : std::nullopt;
  const auto compare = [&](const JsonReader& value, const std::string& description,
                           std::function<double(const BoundarySolution&)> found) {
    const auto expected = reading.constant(value);
    if (!expected || !tolerance) return;
    reading.expectations.checks.push_back(
        [=, bound = *tolerance, number = *expected,
         pointer = entry.place().pointer()](const RunRecord& record) {
          const auto is = record.boundary ? std::optional(found(*record.boundary)) : std::nullopt;
          return deviating(pointer, description + " = " + exact_text(number),
                           std::abs(is.value_or(kUnknownValue) - number), bound, is);
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
              return i < solution.floquet.size() ? std::abs(solution.floquet[i]) : kUnknownValue;
            });
}

}  // namespace

bool read_certificate(ObjectReader& entry, const ExpectationReading& reading) {
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

bool read_solution(ObjectReader& entry, const ExpectationReading& reading) {
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

}  // namespace courant
