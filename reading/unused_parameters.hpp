// Parameters that nothing of an experiment uses.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "courant/reading/findings.hpp"
#include "courant/reading/setting.hpp"

namespace courant {

// A problem for each entry of a key `parameters` below /system whose name stands in no other text of the
// experiment: neither in a formula nor in the name of anything. Titles and descriptions do not count.
std::vector<Problem> unused_parameters(const Json& document);

// Throws ExperimentError, at `option` and the pointer, where a setting changes a parameter that nothing uses:
// such a change is a slip, and would do nothing.
void require_used(const Json& document, std::span<const Setting> settings,
                  const std::string& option = "--set");

}  // namespace courant
