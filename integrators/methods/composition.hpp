// Higher order by substeps of a symmetric method.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/programmed.hpp"

namespace courant {

// The symmetric composition
//
//   Φ_{γ_s h} ∘ … ∘ Φ_{γ_1 h},      γ_i = γ_{s+1-i},   Σ γ_i = 1,
//
// of a symmetric method Φ of order 2, with coefficients that cancel the terms of order 3, 5, … of
// its error. The error of a symmetric method near the identity has only such terms, so that orders
// are even.
//
//   order   s    coefficients
//     4     5    M. Suzuki, Phys. Lett. A 146 (1990) 319
//     6     9    W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089
//     8    17    the same
//
// as E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, V.3.2 prints them; of those
// with few stages these have the smallest errors. What every Φ_h keeps the composition keeps:
// symmetry, a symplectic form, quadratic invariants, and the constraints of Method 2, at every
// node. Some γ_i are negative: steps go back in time in between, which damping does not like.
//
// Φ_h(x) → x as h → 0 is needed for every x, not only on M_f. Method 1 on a system with
// constraints takes their defect δ at the nodes to -δ, so that compositions of it have order 2.
class Composition final : public Integrator, public Programmed {
 public:
  // order: 4, 6 or 8. Throws std::invalid_argument otherwise, and unless `method` is symmetric and
  // of order 2.
  Composition(std::shared_ptr<const Integrator> method, int order);

  // γ_1 … γ_s of order 4, 6 or 8; throws std::invalid_argument for others.
  static std::span<const double> coefficients(int order);

  // `steps` make one step of size 1. For each of them, the two that were made last at times nearest to its own: from
  // this step those before it, from the step before itself and those after it. The time of each is at `part` of it, 1/2
  // in the middle or 1 at the end. What is smooth and belongs to these times is extrapolated by a straight line, by
  // adding both so many `times`.
  struct NearbyStage {
    std::size_t stage;
    double times;
  };
  static std::vector<std::array<NearbyStage, 2>> nearby_stages(std::span<const double> steps,
                                                               double part);

  std::string name() const override;
  int order() const override { return order_; }
  bool is_symmetric() const override { return true; }
  std::optional<bool> is_symplectic() const override { return method_->is_symplectic(); }
  bool is_native() const override { return method_->is_native(); }
  StepProgram program() const override;

 private:
  class Trajectory;

  std::unique_ptr<Stepper> do_stepper() const override;
  // Those of a stage: h is the size of a substep.
  std::vector<StepFormulas> do_formulas() const override;
  // The product of those of the stages.
  std::shared_ptr<const StepDifferential> do_differential() const override;

  std::shared_ptr<const Integrator> method_;
  int order_;
};

}  // namespace courant
