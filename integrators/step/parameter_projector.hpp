// ParameterProjector: a projector on M × Rᵖ where parameters are coordinates.
#pragma once

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/structures/parameter_extension.hpp"

namespace courant {

// The projector of an extended system (ParameterExtension), which moves x as the projector of the system itself does
// at these parameters, and leaves the parameters: W(x, θ) = (W_θ(x), 0).
class ParameterProjector final : public Projector {
 public:
  // `projector` of the system. Throws std::invalid_argument if it is null.
  ParameterProjector(std::shared_ptr<const Projector> projector,
                     const ParameterExtension& extension);
  bool has_constant_directions(Index codimension) const override {
    return projector_->has_constant_directions(codimension);
  }

 private:
  ExprMatrix do_directions(const ExprVector& x, const Expr& t, const LinearMap<Expr>& tangents,
                           const ExprMatrix& conormals) const override;

  std::shared_ptr<const Projector> projector_;
  std::shared_ptr<const Manifold> manifold_;
  Index count_;
  AtParameters at_;
};

// The ladder of an extended system where a state of the system itself is, with all derivatives of θ' = 0 that jets of
// the parameters are in: what multiplies these in other equations may vanish on M_f, and be round-off there.
ConstraintLadder extended_ladder(const ParameterExtension& extension, const State& point);

}  // namespace courant
