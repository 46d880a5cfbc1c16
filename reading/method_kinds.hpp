// The methods that an experiment can ask for.
#pragma once

#include <optional>
#include <string>

#include "courant/reading/method_choice.hpp"
#include "courant/reading/registry.hpp"

namespace courant {

Registry<MethodChoice>& method_kinds();
Registry<DiscretizationChoice>& discretization_kinds();
Registry<ProjectorChoice>& projector_kinds();
// The discretization at `key`, where it has to be one map; nothing, and a problem, for "verlet".
std::optional<DiscretizationChoice> read_map(ObjectReader& object, const std::string& key);

}  // namespace courant
