// Whether a run has left the constraints of its system, or alternates from step to step.
#pragma once

#include <string>

#include "courant/integrators/step/integrator.hpp"
#include "courant/running/observer.hpp"
#include "courant/running/quantity_statistics.hpp"

namespace courant {

// Empty, or a sentence about the constraint[i] that is not small next to its terms where the run
// ended, or was not on the way:
//
//   |c_i| > 3/100 Σ_j |∂c_i/∂x_j| s_j,   s_j the greatest |x_j| of the run,
//
// so that the state is not near M_f. What a method of order p leaves of a constraint is a small part
// of its terms, unless the method is unstable for the index of the system: then H need not tell. Slopes
// are differences; on the way, the greater ones of the start and the end are taken. For up to 500
// coordinates. `statistics`: of the observer's rows.
std::string left_constraints(Observer& observer, const QuantityStatistics& statistics,
                             const State& start, const State& end);

// Empty, or a sentence about the constraint[i] that is more than 10⁻⁴ of its terms where the run ended, and is no
// smaller when the run is made again in steps of h/3 and of h/9: in each of them more than 3/5 of what it was before.
// An error of order 1 has a third. So it is where a method does not converge for a system. For runs of up to 10⁵ steps
// times coordinates, all parts together.
struct StepsOfRun {
  double h = 0.0;
  long steps = 0;
};
std::string kept_violation(const Integrator& integrator, Observer& observer,
                           const QuantityStatistics& statistics, const State& start,
                           const State& end, const StepsOfRun& run);

// Empty, or a sentence about the coordinate x_j or the observable that goes to and fro with each step: the second
// differences of four steps of h after the end have alternating signs, and are more than a fifth of
// the distance from the least to the greatest x_j of the run. Nothing that the steps resolve does so. A
// method does it whose factor is near -1 for what decays fast or is algebraic, as Method 1 by
// midpoints; where |factor| > 1 for what the system leaves open beside the constraints, the motion is
// lost in it, though each constraint may be a small part of its terms, which have grown as well.
// For up to 500 coordinates.
//
// With `field`, the same of velocities and unknowns that nobody asks for, for up to 60 coordinates that nothing
// constrains: more than a fifth of the largest they are in these steps, since what they were before is not known.
std::string alternation(const Integrator& integrator, Observer& observer,
                        const QuantityStatistics& statistics, State end, double h,
                        const ConstraintLadder* field = nullptr);

}  // namespace courant
