// FieldProjector: points are brought to M_f along given vector fields.
#pragma once

#include "courant/integrators/step/projector.hpp"

namespace courant {

// W(x) is the span of vector fields V_1(x), …, V_d(x) of one's own, d = dim M - dim M_f. They have to be
// tangent to M and a complement of T_xM_f, and need be neither orthogonal nor of length 1. With (0, μ^a)
// for the one-forms μ^a of nonholonomic constraints it is the momentum projector of Section 8.2.
//
// Fails where the fields meet T_xM_f, and for an M_f of another codimension.
class FieldProjector final : public Projector {
 public:
  // `fields`: x ↦ Ñ × count, a column each, in the tangent representation. `units` as of Projector.
  // Throws std::invalid_argument if the matrix has another size.
  FieldProjector(const Manifold& manifold, Index count, const MatrixFormula& fields,
                 VectorXd units = {});

  // Where no field depends on x.
  bool has_constant_directions(Index codimension) const override {
    return is_constant_ && codimension == count_;
  }

 private:
  ExprMatrix do_directions(const ExprVector& x, const Expr& t, const LinearMap<Expr>& tangents,
                           const ExprMatrix& conormals) const override;

  Index count_;
  bool is_constant_ = false;
  MatrixFormula fields_;
};

}  // namespace courant
