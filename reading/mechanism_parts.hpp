// The parts of a mechanism as an experiment writes them.
#pragma once

#include <optional>

#include "courant/reading/json_reader.hpp"
#include "courant/reading/written_mechanism.hpp"

namespace courant {

// Reads the keys of a mechanism (mechanism_keys); the numbers are checked at the values of the parameters. Nothing, and
// problems, where a part is wrong.
std::optional<WrittenMechanism> read_mechanism_parts(ObjectReader& system,
                                                     const SymbolTable& constants);

}  // namespace courant
