// TangentMap: the differential of the flow of steps along a run.
#pragma once

#include <memory>
#include <optional>

#include "courant/integrators/step/integrator.hpp"
#include "courant/structures/dirac_structure.hpp"

namespace courant {

// T(Φ_h ∘ … ∘ Φ_h) from the first state of a run to its present one, the product of the StepDifferentials,
// and by how much it changes the geometry. With V, whose columns are the images of a basis of T_xM, or of
// T_xM_f for given conormals:
//
//   symplecticity   ‖Vᵀ ω(x_k) V - V₀ᵀ ω(x₀) V₀‖ / ‖V₀ᵀ ω(x₀) V₀‖   pulled back to M_f, of a structure that
//                   is the graph of a two-form
//                   ‖V Λ(x₀) Vᵀ - Λ(x_k)‖ / ‖Λ(x_k)‖   of one that is the graph of a bivector, as of
//                   Lie–Poisson structures, where M_f = M
//   volume          √(det Vᵀ ω V / det V₀ᵀ ω V₀) - 1   Liouville's, where the form is regular on M_f
//                   |det V| - 1   in orthonormal bases of the tangent representation, where M_f = M
//
// Round-off in V grows with V, and V with the time or faster: so do the defects of a map that preserves
// all of it, from 1e-15. One object a trajectory.
class TangentMap {
 public:
  // `conormals`: of M_f at the first state, rows of Ñ numbers (ConstraintLadder::conormals()); none: M_f
  // is M. `structure` may be null. Throws std::invalid_argument if the method has no differential, and as
  // Integrator::differential does.
  TangentMap(const Integrator& method, const MatrixXd& conormals,
             std::shared_ptr<const DiracStructure> structure);

  // The first state.
  void begin(const VectorXd& x);
  // The next step. Throws as StepDifferential does.
  void advance(const Step& step);

  // V as ambient velocities (N × k) at the present point.
  const MatrixXd& images() const { return memory_.images; }
  // No value where it is not defined. Both together cost what one of them costs.
  struct Defects {
    std::optional<double> symplecticity, volume;
  };
  Defects defects() const;
  std::optional<double> symplecticity_defect() const { return defects().symplecticity; }
  std::optional<double> volume_defect() const { return defects().volume; }

  // All that is kept of the steps so far.
  struct Memory {
    VectorXd first, present;  // points
    MatrixXd images;
  };
  const Memory& memory() const { return memory_; }
  // Goes on from there. Throws std::invalid_argument if it is of another system.
  void recall(const Memory& memory);

 private:
  // Velocities at x and the structure there, as a form or a bivector if it is the graph of one: all in
  // the orthonormal basis of T_xM.
  struct Site {
    MatrixXd velocities;
    std::optional<MatrixXd> form = {}, bivector = {};
  };
  Site site(const VectorXd& x, const MatrixXd& velocities) const;
  std::optional<double> symplecticity(const Site& here) const;
  std::optional<double> volume(const Site& here) const;
  MatrixXd start(const VectorXd& x) const;  // V₀
  bool is_whole() const { return conormals_.rows() == 0; }

  std::shared_ptr<const StepDifferential> differential_;
  std::shared_ptr<const Manifold> manifold_;
  MatrixXd conormals_;
  std::shared_ptr<const DiracStructure> structure_;
  Memory memory_;
  Site first_;  // of V₀
};

}  // namespace courant
