// RankProfile: the ranks of a structure along a set of points.
#pragma once

#include <iosfwd>
#include <span>
#include <vector>

#include "courant/structures/dirac_structure.hpp"

namespace courant {

// The dimensions at one point.
struct FibreRanks {
  Index dimension = 0;       // dim D_x
  Index vector_range = 0;    // dim F_D, the projection on T_xM
  Index covector_range = 0;  // dim F_D^(*), the projection on T_x*M
  Index equations = 0;       // rank [F E P] of the membership F v + E α + P u
  Index ports = 0;           // rank P
  double gap = 0.0;          // the least of all rank decisions; below 10³ they are doubtful

  Index casimirs() const { return dimension - vector_range; }     // dim D ∩ T*M
  Index kernel() const { return dimension - covector_range; }     // dim D ∩ TM
  Index rank_of_form() const { return vector_range - kernel(); }  // rank ω_D, if D_x is Dirac
};

// Throws std::domain_error where the membership is not a finite number.
FibreRanks fibre_ranks(const DiracStructure& structure, const VectorXd& x);

// D is a smooth bundle where the ranks of its equations and of their ports are constant: the
// kernel of a matrix of constant rank is smooth. A Dirac structure made of others (a composition, a
// pullback) is Dirac at each point even where these ranks jump, but it jumps there too, or is not
// known to be smooth.
struct RankProfile {
  std::vector<FibreRanks> at;  // of each point
  FibreRanks generic;          // that of almost every point: the largest ranks
  // Points where dim D, or the rank of the equations or of the ports, is not the generic one.
  std::vector<std::size_t> jumps;
  // Other points where dim F_D or dim F_D^(*) is not the generic one: singular leaves. D is smooth
  // there, as the graph of a bivector is at its zeros.
  std::vector<std::size_t> singular;

  bool is_smooth() const { return jumps.empty(); }
};

// The ranks at the given points, and which of these points are not generic.
RankProfile rank_profile(const DiracStructure& structure, std::span<const VectorXd> points);

// One line for each point that is not generic, and one for the rest.
std::ostream& operator<<(std::ostream& out, const RankProfile& profile);

}  // namespace courant
