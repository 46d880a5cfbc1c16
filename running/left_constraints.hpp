// Whether a run has left the constraints of its system.
#pragma once

#include <string>

#include "courant/running/observer.hpp"
#include "courant/running/quantity_statistics.hpp"

namespace courant {

// Empty, or a sentence about the constraint[i] that is not small next to its terms where the run
// ended:
//
//   |c_i| > 3/100 Σ_j |∂c_i/∂x_j| s_j,   s_j the greatest |x_j| of the run,
//
// so that the state is not near M_f. What a method of order p leaves of a constraint is a small part
// of its terms, unless the method is unstable for the index of the system: then H need not tell. Slopes
// are differences; for up to 500 coordinates. `statistics`: of the observer's rows.
std::string left_constraints(Observer& observer, const QuantityStatistics& statistics,
                             const State& end);

}  // namespace courant
