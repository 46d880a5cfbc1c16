// The product of manifolds.
#pragma once

#include <vector>

#include "courant/manifolds/manifold.hpp"

namespace courant {

// M₁ × … × M_k, k ≥ 0, with the retraction of each factor. Points, tangent vectors and covectors
// are those of the factors, one after the other; E and C are block diagonal. Geodesic if every
// factor is; the injectivity radius is the least one.
class Product final : public Manifold {
 public:
  // Throws std::invalid_argument if a factor is null.
  explicit Product(std::vector<std::shared_ptr<const Manifold>> factors);

  const std::vector<std::shared_ptr<const Manifold>>& factors() const { return factors_; }
  bool has_inverse() const override;
  bool is_geodesic() const override;

  // The part of a point, or of a tangent vector or covector, that belongs to factor i.
  template <class X>
  auto point_part(X&& x, std::size_t i) const {
    return x.segment(point_offset_[i], factors_[i]->ambient_dimension());
  }
  template <class V>
  auto tangent_part(V&& v, std::size_t i) const {
    return v.segment(tangent_offset_[i], factors_[i]->tangent_dimension());
  }

 private:
  bool do_equals(const Manifold& other) const override;
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  bool do_has_identity_frame() const override;
  std::optional<VectorXd> do_unit() const override;
  ScalingSymmetries do_scaling_symmetries() const override;
  ExprMatrix do_tangent_projector(const ExprVector& x) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override;
  ExprVector do_constraint(const ExprVector& x) const override;
  double do_point_defect(const VectorXd& x) const override;
  double do_separation(const VectorXd& x, const VectorXd& y) const override;
  double do_injectivity_radius(const VectorXd& x) const override;
  Extent do_extent_at(const VectorXd& x) const override;
  VectorXd do_project(const VectorXd& x) const override;
  VectorXd do_random_point(std::mt19937& generator) const override;

  std::vector<std::shared_ptr<const Manifold>> factors_;
  std::vector<Index> point_offset_;  // where each factor's entries begin, and past the end
  std::vector<Index> tangent_offset_;
};

}  // namespace courant
