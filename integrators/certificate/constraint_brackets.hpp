// Brackets of constraints in formulas: what a course on constrained dynamics writes on the blackboard.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/integrators/certificate/constraint_formulas.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// Of the constraints φ_a of a ladder, where the Dirac structure of the system is the graph of a bivector Λ,
// {f, g} = ⟨df, Λ dg⟩. Formulas are simplified by the constraints: they hold on M_f.
struct ConstraintBrackets {
  // Why there are no formulas, in words; "" where there are.
  std::string missing = {};

  // φ_a, in the order of ConstraintFormulas but as functions, not as equations, which may be divided.
  std::vector<std::string> constraints = {};
  // {φ_a, φ_b}: "0" where that is 0 on M_f around the point; the number at the point where the formula is longer than
  // five lines, which may be 0 at the point alone.
  struct Entry {
    std::string text;
    bool is_at_point = false;
    bool is_zero() const { return !is_at_point && text == "0"; }
  };
  std::vector<std::vector<Entry>> matrix = {};  // as rows
  // Whether φ_a is first class as it stands: {φ_a, φ_b} = 0 on M_f for all b.
  std::vector<bool> is_first_class = {};

  // The energy with the unknowns that are known put in: of a Lagrangian that is the total Hamiltonian. Velocities that
  // nothing determines stand behind the rest with the primary constraints that they multiply, and so does a multiplier
  // whose formula is longer than a line.
  // "" where it is longer than five lines.
  std::string hamiltonian = {};
  // Whether it is written with a multiplier u_1, u_2, … of each primary constraint in the place of unknowns: of an
  // energy that is not linear in those that nothing determines, as that of a Lagrangian that is a length.
  bool has_multipliers = false;

  // Of the first class, what they generate: δx = ε {x, φ} for the coordinates that φ moves. φ is one of the φ_a, or one
  // with multiples of others that its bracket with them is 0 by.
  struct Generator {
    std::string constraint;
    std::vector<std::pair<std::string, std::string>> moves;  // coordinate, {x, φ}
  };
  std::vector<Generator> generators = {};

  // As many φ_a as the rank of the matrix is, whose own matrix C can be inverted.
  std::vector<std::size_t> second_class = {};

  // {x_i, x_j} - {x_i, φ_a} C^ab {φ_b, x_j} of the second class φ_a, for
  // i < j where that is not 0. Nothing where the rank is 0, where C is not constant and has
  // more than four rows, for more than 16 coordinates, or where one is longer than five lines.
  struct DiracBracket {
    std::string first, second, value;
  };
  std::vector<DiracBracket> dirac_brackets = {};
};

// Nothing where there are no constraints, where there is no structure or none whose bivector elimination with constant
// pivots finds, and with constraints on velocities; no formulas where not all constraints have some, or one that is
// longer than five lines, and of more than 24 constraints.
// Reference: Henneaux, Teitelboim, Quantization of Gauge Systems (1992), chapter 1.
std::optional<ConstraintBrackets> constraint_brackets(const ImplicitSystem& system,
                                                      const ConstraintLadder& ladder,
                                                      const ConstraintFormulas& formulas);

}  // namespace courant
