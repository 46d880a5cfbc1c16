// ProjectorInUnits: a projector as the numbers of other units have it.
#pragma once

#include "courant/integrators/step/projector.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {

// P for a SystemInUnits, where P is a projector of the system itself: the same moves of the same points.
//
//   W̃(x̃, t̃) = W(u x̃, T t̃) / u   for conormals C = C̃ / u
//
// So what units steps are made in is no matter to the method, whatever P measures by.
class ProjectorInUnits final : public Projector {
 public:
  // Throws std::invalid_argument if the projector is null.
  ProjectorInUnits(std::shared_ptr<const Projector> projector, Units units);

  bool has_constant_directions(Index codimension) const override {
    return projector_->has_constant_directions(codimension);
  }
  bool is_always_complement() const override { return projector_->is_always_complement(); }
  VectorXd conormal_sizes() const override;

 private:
  ExprMatrix do_directions(const ExprVector& x, const Expr& t, const LinearMap<Expr>& tangents,
                           const ExprMatrix& conormals) const override;

  std::shared_ptr<const Projector> projector_;
  Units units_;
};

}  // namespace courant
