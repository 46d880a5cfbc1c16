// Methods whose steps are made in natural units where those of the system are far apart.
#pragma once

#include "courant/reading/method_choice.hpp"

namespace courant {

// The method is the same map: a projector measures as it does in the numbers of the system (ProjectorInUnits).
//
// What `prepare` makes, in units where numbers are comparable: by sizes that are given (units_by_sizes), by the kinetic
// energy where there are constraints and numbers are far apart otherwise (kinetic_sizes), or if the system needs them
// (needed_units). Then that is an IntegratorInUnits. Its ladder is found anew in these units. Where it is another
// one steps are made in the numbers of the system; with sizes that are given, in their units, with the ladder that was
// decided. Not in transformed time, and not where parameters are coordinates: these methods are asked for their
// differential alone.
//
// The units are those at the ladder's point. consistent_start looked for units before, at the given values, to find
// that point, and the two are not one search: velocities and unknowns that are not given are in the second alone. Of
// 203 experiments 156 have other units at the point than at the given values, one needs units at the given values only,
// and the one that needs them at both needs others.
PreparedMethod prepared_in_units(const std::function<PreparedMethod(const MethodSetting&)>& prepare,
                                 const MethodSetting& at);

// The method with these sizes in its setting.
MethodChoice with_nominal_sizes(MethodChoice choice, NominalSizes sizes);

}  // namespace courant
