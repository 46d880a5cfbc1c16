// What the tangent and the cotangent bundle of a manifold have in common.
#pragma once

#include "courant/manifolds/manifold.hpp"

namespace courant {

// A vector bundle over M, of dimension 2n, whose fibre at x is the range of a projector F(x) of
// R^Ñ: F = Π for TM, F = Πᵀ for T*M.
//
//   point      (x, u) ∈ R^{N+Ñ}     x ∈ M,  u = F(x) u
//   tangent    (v, r) ∈ R^{2Ñ}      v = C(x) ẋ,  r = F(x) u̇
//   covector   (α, β) ∈ (R^{2Ñ})*
//
// Frames: ẋ = E v, u̇ = F r + dF(x; E v) u. Where n = Ñ (vector spaces, Lie groups) simply u̇ = r.
//
// Retraction: R((x, u), (v, r)) = (x⁺, F(x⁺)(u + r)) with x⁺ = R_x(v); where n = Ñ that is
// (x⁺, u + r), geodesic if M is. The inverse undoes the projection by the linear map F⁺F +
// (1-F⁺)(1-F) between projectors (Kato), invertible while ‖F⁺ - F‖ < 1: on spheres up to π/2. So
// the injectivity radius is at most 1/κ, where κ is the rate at which F turns at (x, u) per length
// of v: an estimate from one point, which assumes that F does not turn much faster nearby. Along
// the fibres nothing is limited.
class VectorBundle : public Manifold {
 public:
  const std::shared_ptr<const Manifold>& base() const { return base_; }  // M
  bool has_inverse() const override { return base_->has_inverse(); }
  bool is_geodesic() const override { return is_trivialised() && base_->is_geodesic(); }

  // The parts of a point and of a tangent vector or covector.
  template <class X>
  auto position(const Eigen::MatrixBase<X>& x) const {
    return x.head(base_->ambient_dimension());
  }
  template <class X>
  auto fibre_part(const Eigen::MatrixBase<X>& x) const {
    return x.tail(base_->tangent_dimension());
  }
  template <class V>
  auto horizontal(const Eigen::MatrixBase<V>& v) const {
    return v.head(base_->tangent_dimension());
  }
  template <class V>
  auto vertical(const Eigen::MatrixBase<V>& v) const {
    return v.tail(base_->tangent_dimension());
  }

 protected:
  // `kind` names the bundle: "CotangentBundle". Throws std::invalid_argument if base is null.
  VectorBundle(const std::string& kind, std::shared_ptr<const Manifold> base);

  // Whether n = Ñ, so that F = 1.
  bool is_trivialised() const { return base_->dimension() == base_->tangent_dimension(); }

 private:
  // To subclass, override:
  virtual LinearMap<Expr> fibre_projector(const ExprVector& x) const = 0;  // F, Ñ × Ñ, at x ∈ M

  bool do_has_identity_frame() const override { return base_->has_identity_frame(); }
  ScalingSymmetries do_scaling_symmetries() const override;
  ExprMatrix do_tangent_projector(const ExprVector& x) const override;
  bool do_equals(const Manifold& other) const override {
    return *base_ == *static_cast<const VectorBundle&>(other).base_;
  }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override;
  ExprVector do_constraint(const ExprVector& x) const override;
  double do_point_defect(const VectorXd& x) const override;
  double do_separation(const VectorXd& x, const VectorXd& y) const override;
  double do_injectivity_radius(const VectorXd& x) const override;
  Extent do_extent_at(const VectorXd& x) const override;
  VectorXd do_project(const VectorXd& x) const override;
  VectorXd do_random_point(std::mt19937& generator) const override;

  double turning_rate(const VectorXd& position) const;  // κ
  VectorXd projected(const VectorXd& position, const VectorXd& fibre) const;
  ExprMatrix fibre_motion(const ExprVector& x) const;

  std::shared_ptr<const Manifold> base_;
};

}  // namespace courant
