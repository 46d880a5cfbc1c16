// Units of steps by the kinetic energy.
#pragma once

#include <memory>
#include <optional>

#include "courant/structures/system_in_units.hpp"

namespace courant {

// The diagonal g_ii of the kinetic energy ½ g_ij w^i w^j at x. Empty where the manifold is no cotangent bundle, or the
// energy is not kinetic (see kinetic_metric).
std::optional<VectorXd> kinetic_masses(const std::shared_ptr<const ImplicitSystem>& system,
                                       const VectorXd& x);

// What counts as 1 of the N coordinates of T*Q in steps of h from x: c/√g_ii of positions and c √g_ii/|h| of momenta, for
// these masses g_ii,
//
//   q̃_i = √g_ii q_i / c,     p̃_i = h p_i / (c √g_ii),
//
// with c such that the largest of these is 1. So a system that is written in other units of length, mass and time has
// the same numbers. A body at rest tells how large its momenta are as one in motion does, and a coordinate of 0 or of
// 10⁻¹⁷ beside others as they do. Coordinates that share a unit by the scaling symmetries of T*Q have the largest of
// their sizes; those without a unit have 0.
VectorXd kinetic_sizes(const Manifold& phase_space, const VectorXd& masses, const VectorXd& x,
                       double h);

// The largest of such sizes by the smallest; 1 where there are none.
double spread(const VectorXd& sizes);

// The units of these sizes, rounded to powers of two, with |h| as that of time. Every unknown has the one in which it is
// as large as an equation that contains it, by the entries at the point: a multiplier counts as 1 where it changes
// momenta by 1 in a step. Where no entry tells an unknown has 1.
Units kinetic_units(const std::shared_ptr<const ImplicitSystem>& system, const State& point,
                    const VectorXd& sizes, double h);

}  // namespace courant
