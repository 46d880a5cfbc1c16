// The JSON Schema of experiments.
#pragma once

#include <string_view>

namespace courant::cli {

// The text of experiments/schema.json, as it was when the program was built.
std::string_view schema_text();

}  // namespace courant::cli
