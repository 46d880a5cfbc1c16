#include "courant/reading/substepping.hpp"

#include <algorithm>
#include <utility>

#include "courant/reading/written_formula.hpp"

namespace courant {
namespace {

// Steps of a 10⁹th of their size are shorter than what any of them resolves.
constexpr Index kMostHalvings = 30;

std::optional<double> constant_time(const JsonReader& value, const SymbolTable& constants) {
  const auto formula = read_formula(value);
  if (!formula) return std::nullopt;
  const auto number = evaluate_constants({{}, {*formula}}, constants, value.findings());
  return number ? std::optional((*number)[0]) : std::nullopt;
}

std::optional<Corner> read_corner(const JsonReader& entry, const SymbolTable& constants) {
  if (!entry.value().is_object()) {
    const auto time = constant_time(entry, constants);
    return time ? std::optional(Corner{*time, 0.0}) : std::nullopt;
  }
  ObjectReader object(entry);
  const auto first_key = object.required("first"), period_key = object.required("period");
  if (!first_key || !period_key) return std::nullopt;
  const auto first = constant_time(*first_key, constants);
  const auto period = constant_time(*period_key, constants);
  if (!first || !period) return std::nullopt;
  if (*period > 0.0) return Corner{*first, *period};
  period_key->expected("a number greater than 0");
  return std::nullopt;
}

}  // namespace

std::optional<SubsteppingIntegrator::Options> read_division(ObjectReader& time,
                                                            const SymbolTable& constants) {
  SubsteppingIntegrator::Options options;
  const auto corners_key = time.optional("corners"), halvings_key = time.optional("halvings");
  if (corners_key)
    if (const auto entries = corners_key->elements())
      for (const JsonReader& entry : *entries)
        if (const auto corner = read_corner(entry, constants)) options.corners.push_back(*corner);
  if (halvings_key)
    if (const auto halvings = halvings_key->integer(0)) {
      options.halvings = static_cast<int>(std::min(*halvings, kMostHalvings));
      if (*halvings > kMostHalvings)
        halvings_key->expected("an integer from 0 to " + std::to_string(kMostHalvings));
    }
  if (options.corners.empty() && options.halvings == 0) return std::nullopt;
  if (!options.corners.empty() && time.optional("transformation"))
    corners_key->problem(
        "are times, but a step in transformed time does not know where it ends; expected "
        "\"corners\" or \"transformation\"");
  return options;
}

MethodChoice with_substeps(MethodChoice choice, SubsteppingIntegrator::Options options) {
  auto prepare = [prepare = std::move(choice.prepare),
                  options = std::move(options)](const MethodSetting& at) {
    PreparedMethod method = prepare(at);
    method.integrator =
        std::make_shared<SubsteppingIntegrator>(std::move(method.integrator), options);
    return method;
  };
  choice.prepare = std::move(prepare);
  return choice;
}

}  // namespace courant
