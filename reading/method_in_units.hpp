// Methods whose steps are made in natural units where those of the system are far apart.
#pragma once

#include "courant/reading/method_kinds.hpp"

namespace courant {

// What `prepare` makes, in units where numbers are comparable if the system needs them (needed_units) and
// its ladder is the same there: then an IntegratorInUnits. Not in transformed time.
PreparedMethod prepared_in_units(const std::function<PreparedMethod(const MethodSetting&)>& prepare,
                                 const MethodSetting& at);

}  // namespace courant
