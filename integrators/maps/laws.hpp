// The laws of DiscretizationMap and of CotangentLift, measured.
#pragma once

#include <vector>

#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/manifolds/laws.hpp"

namespace courant {

// Every law of `map` (D1 to D7 in the comment of DiscretizationMap), measured as check_manifold
// does, with tangent vectors of the same lengths (where the injectivity radius is infinite: 0.5 and
// 1). The order is the slope of the error of one step on a nonlinear random vector field that
// depends on time against a reference solution, less one. Claims are held against measurement in
// both directions: a map that is symmetric and says that it is not fails too.
std::vector<LawResult> check_discretization_map(const DiscretizationMap& map,
                                                const LawOptions& options = {});

// The laws of `lift` as a discretization map, and
//   L1  it covers its base map: (q₀, q₁) = R_d(q, v)                             (Proposition 4.11)
//   L2  it pulls Ω₁₂ = pr₂*ω_Q - pr₁*ω_Q back to d_Tω_Q, and so does its inverse  (Corollary 4.12)
// The forms are those of the ambient space, dq ∧ dP and dq ∧ dṖ + dq̇ ∧ dP with P = C(q)ᵀp, pulled
// back by exact derivatives: a route that knows nothing of frames' torsion.
std::vector<LawResult> check_cotangent_lift(const CotangentLift& lift,
                                            const LawOptions& options = {});

}  // namespace courant
