// Order 2 with damping, by two steps of the theta family.
#pragma once

#include <array>

#include "courant/integrators/step/integrator.hpp"

namespace courant {

// The composition
//
//   Φ^{1}_{γh} ∘ Φ^{θ}_{(1-γ)h},      γ = 1 - 1/√2,   θ = √2 - 1
//
// of two steps of the theta family (Theta): the second one is implicit Euler. The error of a theta step
// of size k is (1/2 - θ) k² times the same vector for every θ, on every manifold, up to terms of order 3:
// the composition has order 2 since
//
//   (1/2 - θ) (1-γ)² + (1/2 - 1) γ² = 0.
//
// On x' = λx, with z = hλ, a step is multiplication by
//
//   R(z) = (1 + (1-2γ) z) / (1 - γz)²,      |R| ≤ 1 for Re z ≤ 0,   R(∞) = 0
//
// so that the method is L-stable, where the midpoint rule has R(∞) = -1: a motion that is much faster than
// a step dies out within it, the current of a coil behind a diode that blocks, say. Of all γ this one has the
// least error constant |R - exp| = 0.0404 |z|³, half that of the midpoint rule; R is that of TR-BDF2 and of
// the SDIRK method of order 2 (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.6;
// R. E. Bank et al., IEEE Trans. CAD 4 (1985) 436). Implicit Euler comes last: a step ends where the
// equations hold at its end, with efforts and multipliers that belong to it.
//
// Not symmetric; no form and no energy is preserved.
class DampedComposition final : public Integrator {
 public:
  static constexpr double kRootOfTwo = 1.41421356237309504880;
  // θ of the two steps, and their parts of h.
  static constexpr std::array<double, 2> kThetas = {kRootOfTwo - 1.0, 1.0};
  static constexpr std::array<double, 2> kParts = {0.5 * kRootOfTwo, 1.0 - 0.5 * kRootOfTwo};

  // The same method with Theta of kThetas. Throws std::invalid_argument unless both are of
  // order 1 and of one system.
  DampedComposition(std::shared_ptr<const Integrator> first,
                    std::shared_ptr<const Integrator> second);

  std::string name() const override;
  int order() const override { return 2; }
  bool is_symmetric() const override { return false; }
  std::optional<bool> is_symplectic() const override { return false; }
  bool is_native() const override { return steps_[0]->is_native() && steps_[1]->is_native(); }

 private:
  class Trajectory;

  std::unique_ptr<Stepper> do_stepper() const override;
  // Those of the first step, then those of the second: h is the size of each.
  std::vector<StepFormulas> do_formulas() const override;
  // The product of theirs.
  std::shared_ptr<const StepDifferential> do_differential() const override;

  std::array<std::shared_ptr<const Integrator>, 2> steps_;
};

}  // namespace courant
