// Substepping: the keys `corners` and `halvings` of `time`.
#pragma once

#include <optional>

#include "courant/integrators/methods/substepping_integrator.hpp"
#include "courant/reading/json_reader.hpp"
#include "courant/reading/method_kinds.hpp"

namespace courant {

// The two keys of `time`: times, formulas of constants or objects {"first", "period"} of them; how often a step is
// halved. Nothing for neither.
std::optional<SubsteppingIntegrator::Options> read_division(ObjectReader& time,
                                                            const SymbolTable& constants);

// The same choice with substeps: a SubsteppingIntegrator.
MethodChoice with_substeps(MethodChoice choice, SubsteppingIntegrator::Options options);

}  // namespace courant
