// The cells of comma-separated values.
#pragma once

#include <string>

#include "courant/reading/findings.hpp"

namespace courant {

// A value as a cell: numbers by the fewest digits that read back to the same, null as nothing,
// texts in quotes where they have a comma, a quote or a line end (RFC 4180).
std::string csv_cell(const Json& value);

}  // namespace courant
