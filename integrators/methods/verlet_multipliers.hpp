// The formulas of a step by Verlet in which nothing but multipliers has to be solved for.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/methods/verlet_trace.hpp"

namespace courant {

// Of a step with constraints c(q) = 0 and an energy T(p) + V(q) elimination leaves
//
//   c(q₁(λ)) = 0,    c'(q₁) T'(p₁(λ, μ)) = 0,    c''(q₁, p₁; ν) = 0
//
// for the multipliers λ and μ of both halves and those ν at the end: square equations, of which the second are affine in
// μ and the third in ν. In general, the diagonal blocks of their block triangular form are solved one after the other;
// those of one affine equation give their unknown as a formula.
struct VerletMultipliers {
  // `trace`: by velocities. No value where more has to be solved for than this, as with an energy that is not separable.
  static std::optional<VerletMultipliers> of(const VerletTrace& trace, const Manifold& manifold);

  // Equations for some unknowns u, given those of all blocks before: inputs u, those, x₀, h, t.
  struct Block {
    Function::Formulas formulas;
    bool is_affine = false;     // in u; else u are multipliers of the first half
    std::vector<Index> begins;  // of those, their places in z
    Index size() const { return formulas.inputs[0].variables.size(); }
  };
  std::vector<Block> blocks;
  std::size_t moving = 0;  // so many blocks come first that x₁ depends on
  Index unknowns = 0;      // of all blocks

  Function::Formulas step;  // x₀, h, t, u of those ↦ x₁
  // Where each of them has one equation: the same for u after so many of Newton's iterations, each with a slope of its
  // own, from u as it is given ↦ x₁, u, the last changes of u. No outputs elsewhere.
  static constexpr int kIterations = 2;
  Function::Formulas iterated;
  Function::Formulas stages;  // the same ↦ what tell_halves() takes
  Function::Formulas ending;  // x₀, h, t, u of all blocks ↦ v, z at the end
  Function::Formulas middle;  // as `step` ↦ x_m
};

}  // namespace courant
