// Methods whose steps are divided: the keys `corners` and `halvings` of `time`.
#pragma once

#include <optional>

#include "courant/integrators/methods/divided_integrator.hpp"
#include "courant/reading/json_reader.hpp"
#include "courant/reading/method_kinds.hpp"

namespace courant {

// The two keys of `time`: times, formulas of constants or objects {"first", "period"} of them; how often a step is
// halved. Nothing for neither.
std::optional<DividedIntegrator::Options> read_division(ObjectReader& time,
                                                        const SymbolTable& constants);

// The same choice with steps that are divided so: a DividedIntegrator.
MethodChoice in_divided_steps(MethodChoice choice, DividedIntegrator::Options options);

}  // namespace courant
