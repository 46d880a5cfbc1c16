// First and second class: what a Dirac structure says of the constraints of a ladder.
#pragma once

#include <optional>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// Of the constraints φ_a of a ladder (n - dim M_f of them, by their gradients at the consistent
// point), for a system with a Dirac structure D at that point:
//
//   primary       those of level 0; the others are secondary
//   second class  rank of the matrix of brackets {φ_a, φ_b} = ⟨dφ_a, ♯dφ_b⟩
//   first class   the others: as many combinations of the φ_a have bracket 0 with all of them
//
// where D is the graph of a bivector, the canonical one of T*Q for example. The vector fields of the
// first class are tangent to M_f and span the directions in which D does not tell its points apart,
//
//   K = {v ∈ T M_f : (v, α) ∈ D for some α ∈ (T M_f)°},     degrees of freedom up to gauge: dim M_f - dim K.
//
// For D symplectic dim K is the number of the first class, and the difference the rank of the
// two-form restricted to M_f. Where D is the graph of a two-form that is not symplectic there are no
// brackets, and the difference is still that rank.
//
// All of it holds at the point, and along M_f where the ranks are constant. Dirac took the first
// class for generators of gauge; that this is so for secondary constraints too is his conjecture,
// true unless a constraint is a square.
// Reference: Henneaux, Teitelboim, Quantization of Gauge Systems (1992), chapters 1 and 2.
struct ConstraintClasses {
  struct Brackets {
    Index first_class = 0;
    Index second_class = 0;
    Index primary_first_class = 0;  // combinations of primary constraints that are first class
  };

  Index primary = 0, secondary = 0;
  std::optional<Brackets> brackets;  // none where D is not the graph of a bivector
  Index degrees_of_freedom_up_to_gauge = 0;
  std::vector<RankDecision> decisions;  // the ranks behind the numbers

  bool is_ambiguous() const;
};

// Nothing for systems without a structure, or with one that is the graph of neither a bivector nor a
// two-form at the point, or with constraints on velocities (nonholonomic ones, whose reactions are no
// vector fields of functions), and for ladders without an index.
std::optional<ConstraintClasses> constraint_classes(const ImplicitSystem& system,
                                                    const ConstraintLadder& ladder);

}  // namespace courant
