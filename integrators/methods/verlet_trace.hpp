// The formulas of a step by Verlet that is solved for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/step_formulas.hpp"

namespace courant {

// The formulas of both halves of a step, see Verlet. With constraints there are those of S_f at the end too, of which
// the jets are unknowns.
struct VerletTrace {
  // What the unknowns w and ξ of a step are: displacements of the first half and of both; or, where the map moves points
  // by x + v, ẋ in the first half and in the second one, for which no equation divides by h.
  enum class Unknowns { displacements, velocities };
  // Whether the map and its adjoint take x₀ to x₀ + v, with v for a velocity.
  static bool moves_by_sums(const std::shared_ptr<const DiscretizationMap>& map);

  // `map`: of the first half. Throws std::invalid_argument where there are constraints other than on positions, or
  // redundant ones.
  VerletTrace(const ImplicitSystem& system, const ConstraintLadder& ladder,
              const std::shared_ptr<const DiscretizationMap>& map, const std::string& name,
              Unknowns kind = Unknowns::displacements);

  Index codimension = 0;  // of M_f
  StepFormulas step;      // y; x₀, basis, h, t
  // (ξ, jets); x₀, basis, t, if M_f is not M; of these the equations of S_f and those of M_f; x, v, z.
  std::vector<Function::Input> consistent_inputs;
  ExprVector consistent, found;
  ExprVector ended, advanced;  // x₁, v, z; and what is known of the halves, see tell_halves()
  Index tangents = 0;          // so many of ξ, ξ', … at the end are unknowns
  Index multipliers = 0;       // the size of z; of both halves they are the last unknowns

 private:
  std::vector<Index> equations_of_motion(const ImplicitSystem& system, const LinearMap<Expr>& basis,
                                         const ExprVector& first, const ExprVector& second,
                                         const ExprVector& w) const;
};

}  // namespace courant
