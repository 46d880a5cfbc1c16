// What came out of a sweep, over what was swept.
#pragma once

#include <optional>

#include "courant/reading/findings.hpp"
#include "courant/reporting/report_figures.hpp"

namespace courant {

// Of a table of `sweep`: panels over the values of its first place, with a curve for each
// combination of the values of the others. For runs: the greatest energy error, the greatest
// violation of the constraints, and where the observables end, or the coordinates where there are
// none; at most eight panels. For ladders: degrees of freedom, index, and the gap of the weakest
// rank decision. For studies: the measured order, and the least error. Logarithmic axes for what
// is positive and spreads over decades. Nothing where there is no number to show.
std::optional<Figure> sweep_figure(const Json& table);

}  // namespace courant
