// Natural units: nominal values of a system's coordinates, found from its equations.
#pragma once

#include <optional>

#include "courant/core/linear/uncertain_matrix.hpp"
#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {

// The nominal values of the Ñ numbers of a tangent vector of M, near the ladder's point. In these units the terms of
// the equations are of one size, as far as that can be:
//
//   Σ (log r_i + log |∂F_i/∂y_j| + log c_j)²  least,    c_ξ' = c_ξ / T,
//
// for y = (ξ, ξ', z), units r of the equations and T of time. An entry that vanishes at the point counts with its size
// nearby. A number that is zero up to round-off tells no size. Coordinates that are written in other units have other
// natural units accordingly, up to a common factor of those that equations connect. Numbers that the tangent projector
// of M mixes, such as the components of a vector on a sphere, share a unit. All are 1 where the ladder has no point.
VectorXd natural_units(const std::shared_ptr<const ImplicitSystem>& system,
                       const ConstraintLadder& ladder);

// The point with 0 in place of the coordinates and velocities that are only what a run or a search left of a zero.
// These are round-off next to the largest number, and no equation connects them with another one. A position of 10⁻⁶
// beside a momentum of 10¹² stays.
State without_round_off(const std::shared_ptr<const ChartEquations>& equations, const State& point);

// Units by the same least squares, in which all terms count, however small they are beside others. Terms without
// unknowns count too: the weight of a body at rest tells the unit of time. Arguments of sines and exponentials have the
// unit 1. This finds the unit of a momentum of 10⁻²⁴ beside a position of 10⁻⁶; it also finds that of a leak which is
// small beside a current. Units are rounded to powers of two, and that of an equation is the size of its largest term.
//
// Empty where exponentials let entries have any size, where a unit follows from nothing but itself, where M has no
// scaling symmetries, and for systems of more than 500 equations and unknowns.
std::optional<Units> units_of_all_terms(const std::shared_ptr<const ChartEquations>& equations,
                                        const State& point);

// The power of two next to a size; 1 for what is no size.
double unit_next_to(double size);

// By the numbers that Manifold::ScalingSymmetries has: the largest of these sizes for each number, 0 where there is
// none; and for each entry that of its number, `without` where it has no number.
VectorXd largest_by_number(const std::vector<Index>& numbers, const VectorXd& sizes, Index count);
VectorXd by_number(const std::vector<Index>& numbers, const VectorXd& of_number, double without);

// The largest entry of each row of a matrix without negative ones.
VectorXd largest_of_rows(const SparseMatrixXd& matrix);

// The sizes of the largest entries of equations (r × any), rounded to powers of two; equations that are components of
// one vector or covector share theirs.
VectorXd equation_units(const ImplicitSystem& system, const SparseMatrixXd& terms);

// Units of coordinates by given sizes (N), rounded to powers of two; a size of 0 is none. What is not given has 1. Of
// coordinates that have one unit by the scaling symmetries of M the largest size counts; of those that have none by
// them no size does. There are no units of unknowns and equations.
Units units_by_sizes(const Manifold& M, const VectorXd& coordinates);

// Units by given sizes of coordinates (N) and unknowns (m), rounded to powers of two; a size of 0 is none. What is not
// given has its unit from `others`, or 1. The unit of an equation is the size of its largest term at the point. Of
// coordinates that have one unit by the scaling symmetries of M the largest size counts; of those that have none by
// them no size does.
Units units_by_sizes(const std::shared_ptr<const ImplicitSystem>& system, const State& point,
                     const VectorXd& coordinates, const VectorXd& unknowns,
                     std::optional<Units> others = {});

}  // namespace courant
