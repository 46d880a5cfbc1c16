// Projector: how points near M_f are brought to M_f.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {

// P: M → M_f with P(x) = x on M_f (Section 7.2), given by the directions along which it moves
// points:
//
//   P(R_x(B W(x) μ)) = x   for x ∈ M_f and small μ ∈ R^d,   d = dim M - dim M_f
//
// The columns of W(x) (n × d, in coordinates with respect to a basis B of T_xM) span a complement
// of T_xM_f. Immutable. To subclass: override do_directions.
class Projector {
 public:
  virtual ~Projector() = default;

  const std::string& name() const { return name_; }

  // Whether the span of W(x) is the same at every x, in a basis that is the same at every x, for
  // M_f of this codimension d.
  virtual bool has_constant_directions(Index) const { return false; }
  // Whether W(x) spans the conormals themselves.
  virtual bool is_orthogonal() const { return false; }

  // An orthonormal W(x). x: N; basis: Ñ × n, orthonormal; conormals: n × d, an orthonormal basis of
  // the annihilator of T_xM_f in the coordinates of that basis. Throws std::domain_error if the
  // directions are no complement of T_xM_f.
  MatrixXd directions(const VectorXd& x, const MatrixXd& basis, const MatrixXd& conormals) const;

 protected:
  explicit Projector(std::string name) : name_(std::move(name)) {}

 private:
  virtual MatrixXd do_directions(const VectorXd& x, const MatrixXd& basis,
                                 const MatrixXd& conormals) const = 0;

  std::string name_;
};

// The nearest point, in the Euclidean metric of the tangent representation: W is normal to T_xM_f.
// Moves onto any M_f; the default.
class OrthogonalProjector final : public Projector {
 public:
  OrthogonalProjector() : Projector("orthogonal") {}
  bool is_orthogonal() const override { return true; }

 private:
  MatrixXd do_directions(const VectorXd& x, const MatrixXd& basis,
                         const MatrixXd& conormals) const override;
};

// On T*Q: q stays, p moves as little as possible in the metric g^{ij} (Section 8.2; for M_f = Im α,
// Section 6.2, it is p ↦ α(q)). W = {(0, g β) : β ∈ the momentum parts of the conormals}: for
// μ_i^a(q) g^{ij} p_j = 0 it is the span of the μ^a. Position constraints can't be met by moving p:
// std::domain_error.
class MomentumProjector final : public Projector {
 public:
  using Metric = std::function<ExprMatrix(const ExprVector& q)>;  // g_{ij}(q), Ñ_Q × Ñ_Q
  explicit MomentumProjector(std::shared_ptr<const CotangentBundle> phase_space,
                             Metric metric = {});
  // All of T*_qQ if every momentum is determined by q.
  bool has_constant_directions(Index codimension) const override {
    return codimension == phase_space_->base()->dimension();
  }

 private:
  MatrixXd do_directions(const VectorXd& x, const MatrixXd& basis,
                         const MatrixXd& conormals) const override;

  std::shared_ptr<const CotangentBundle> phase_space_;
  Metric metric_;
};

}  // namespace courant
