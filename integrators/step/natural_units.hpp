// The sizes that are typical of a system's coordinates.
#pragma once

#include <optional>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {

// What is a typical size of each of the Ñ numbers of a tangent vector of M, near the ladder's
// point: the units in which the terms of the equations are of one size,
//
//   Σ (log r_i + log |∂F_i/∂y_j| + log c_j)²  least,    c_ξ' = c_ξ / T,
//
// for y = (ξ, ξ', z), units r of the equations and T of time. An entry that vanishes at the point is
// taken as large as it is nearby, and a number that is zero up to round-off is no size. A change of
// units of the coordinates changes these sizes with them, up to a common factor of those that the
// equations connect. Numbers that the tangent projector of M mixes, as those of a sphere, share a
// unit. All 1 where the ladder has no point.
VectorXd natural_units(const std::shared_ptr<const ImplicitSystem>& system,
                       const ConstraintLadder& ladder);

// The point with 0 for the coordinates and velocities that a run or a search left of a zero: those that are round-off
// next to the largest number, and that no equation connects with another one. A position of 10⁻⁶ beside a momentum
// of 10¹² is none of them.
State without_round_off(const std::shared_ptr<const ImplicitSystem>& system, const State& point);

// Units by the same least squares in which all terms count, however small beside others, and besides what
// the equations contain without unknowns: the weight of a body at rest tells the unit of time. What sines and
// exponentials are of has the size of 1. So those of a
// momentum of 10⁻²⁴ beside a position of 10⁻⁶ are found; those of a leak that is small beside a current are,
// too. To powers of two, of the equations the sizes of their largest terms. Empty where exponentials let
// entries be of any size, where a unit is made of nothing but itself, where M has no dilations, and for systems of more than 500 equations and unknowns.
std::optional<Units> units_of_all_terms(const std::shared_ptr<const ImplicitSystem>& system,
                                        const State& point);

// Units by the sizes of some coordinates (N) and unknowns (m), 0 where none is given, to powers of two: of what is not
// given those of `others`, or 1. Of equations the sizes of their largest terms at the point. Of coordinates that M has one
// unit for the largest size counts, and none of those that M has no unit for.
Units units_by_sizes(const std::shared_ptr<const ImplicitSystem>& system, const State& point,
                     const VectorXd& coordinates, const VectorXd& unknowns,
                     std::optional<Units> others = {});

}  // namespace courant
