// VectorField: S_f as the graph of a vector field.
#pragma once

#include "courant/core/function.hpp"
#include "courant/core/newton.hpp"
#include "courant/integrators/ladder/constraint_ladder.hpp"
#include "courant/integrators/moving_basis.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// x ↦ v with (x, v) ∈ S_f, for a regular ladder: the equations of S_f solved for (v, z, jets) at
// given x.
//
// Off M_f, where the stages of a Runge–Kutta method fall, it is an extension of the field: as many
// independent equations for (v, z, jets) as there are such unknowns are kept, chosen at the
// ladder's point; those that hold x alone, the constraints, are not used.
class VectorField {
 public:
  // Throws std::invalid_argument unless the ladder is regular.
  VectorField(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
              Backend backend);

  const std::shared_ptr<const ImplicitSystem>& system() const { return system_; }
  bool is_native() const { return equations_.is_native(); }

  // Evaluates along a trajectory, each time starting from the last values; not shared between
  // threads.
  class Evaluation {
   public:
    // `field` has to outlive it.
    explicit Evaluation(const VectorField& field);
    // The next evaluation starts from v and z at x, the one after forget() from those at the
    // ladder's point.
    void start(const VectorXd& x, const VectorXd& v, const VectorXd& z);
    void forget();
    // Back to the values that the last keep() found.
    void keep() { kept_ = y_; }
    void discard();
    // ẋ = E(x) v, size N. Throws std::domain_error if (v, z, jets) are not found.
    void operator()(const VectorXd& x, VectorXd& rate, double t);
    const VectorXd& v() const { return v_; }
    const VectorXd& z() const { return z_; }

   private:
    const VectorField& field_;
    Newton newton_;
    VectorXd y_, kept_, out_, v_, z_;
    MovingBasis basis_;
  };

 private:
  std::shared_ptr<const ImplicitSystem> system_;
  Index order_ = 0;     // of the highest jet ξ^(order)
  VectorXd start_;      // (ξ', …, z, …) at the ladder's point
  Function equations_;  // y = (ξ', …, z, …); x, basis, t ↦ the equations kept
  Function rate_;       // the same ↦ ẋ, v, z
  Function basis_;      // of MovingBasis
};

}  // namespace courant
