// FixedTimeProjector: a projector on M where time is a coordinate.
#pragma once

#include "courant/integrators/step/projector.hpp"

namespace courant {

// The projector of a system on M × R, points (x, t), that moves x as a projector on M does and leaves t:
// W(x, t) = (W_M(x), 0), where W_M is that for the constraints at the time t. M_f has to be transverse
// to t = const: no constraint holds time alone.
class FixedTimeProjector final : public Projector {
 public:
  // `projector` on `manifold`, M. Throws std::invalid_argument if one is null.
  FixedTimeProjector(std::shared_ptr<const Projector> projector,
                     std::shared_ptr<const Manifold> manifold);
  bool has_constant_directions(Index codimension) const override {
    return projector_->has_constant_directions(codimension);
  }

 private:
  ExprMatrix do_directions(const ExprVector& x, const Expr& t, const LinearMap<Expr>& tangents,
                           const ExprMatrix& conormals) const override;
  std::string do_advice() const override {
    return "Are there constraints of time alone? Expected constraints of the point at each time.";
  }

  std::shared_ptr<const Projector> projector_;
  std::shared_ptr<const Manifold> manifold_;
};

}  // namespace courant
