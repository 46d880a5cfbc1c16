// Whether a summary.json has the fields of the contract, of the right types.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace courant {

// The first field that is missing or mistyped, as `/json/pointer: what it is`; nothing when there
// is none. A null stands for a number that was not finite. Fields that the contract does not name
// are let through.
std::optional<std::string> summary_defect(const nlohmann::ordered_json& summary);

}  // namespace courant
