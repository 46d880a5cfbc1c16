// Projector: how points near M_f are brought to M_f.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// P: M → M_f with P(x) = x on M_f (Section 7.2), given by the directions along which it moves
// points:
//
//   P(R_x(B W(x) μ)) = x   for x ∈ M_f and small μ ∈ R^d,   d = dim M - dim M_f
//
// The columns of W(x) (n × d, in coordinates with respect to a basis B of T_xM) span a complement
// of T_xM_f.
//
// Laws, measured by check_projector at points x of M_f:
//   J1  W(x) has d orthonormal columns, a complement of T_xM_f
//   J2  the span of W(x) does not depend on the bases of T_xM and of the conormals
//   J3  the claims is_orthogonal() and has_constant_directions() hold
//
// Immutable. To subclass: override do_directions, formulas of the point, of the time and of the conormals there.
class Projector {
 public:
  // A matrix of formulas of the point. A projector keeps those that it is made of.
  using MatrixFormula = std::function<ExprMatrix(const ExprVector& x)>;

  virtual ~Projector() = default;

  const std::string& name() const { return name_; }

  // Whether the span of W(x) is the same at every x, in a basis that is the same at every x, for
  // M_f of this codimension d.
  virtual bool has_constant_directions(Index) const { return false; }
  // Whether W(x) spans the conormals themselves.
  virtual bool is_orthogonal() const { return false; }
  // Whether W(x) is a complement of T_xM_f for any M_f, as seen in the units.
  virtual bool is_always_complement() const { return is_orthogonal(); }

  // Vectors that span W(x), n × d, neither orthonormal nor asked whether they are a complement: Bᵀ V for the V of
  // do_directions, on expressions. x: N; basis: B, Ñ × n, orthonormal; conormals: C, n × d, independent and in the
  // coordinates of that basis. Throws std::invalid_argument if V has another size.
  ExprMatrix span(const ExprVector& x, const Expr& t, const LinearMap<Expr>& basis,
                  const ExprMatrix& conormals) const;
  // Sizes s of the components of conormals, where n = Ñ, next to which they are kept and made orthonormal along a
  // trajectory; empty: 1. They matter to round-off alone.
  virtual VectorXd conormal_sizes() const { return {}; }
  // The same projector, with vectors V that are of one size next to these sizes of the Ñ components of tangent vectors;
  // nothing where V is as good as it is. It matters to round-off alone.
  virtual std::shared_ptr<const Projector> balanced(const VectorXd& /*sizes*/) const {
    return nullptr;
  }
  // (x, B, C, t) ↦ these vectors, column by column, for conormals s C. Nothing where W is C.
  Function::Formulas span_formulas(const Manifold& manifold, Index codimension) const;

  // An orthonormal W(x) with the span of V, which is what span() gives for this basis and these conormals, an
  // orthonormal basis of the annihilator of T_xM_f. Throws std::domain_error if it is no complement of T_xM_f, as seen
  // in the units.
  MatrixXd orthonormal_directions(const MatrixXd& V, const LinearMap<double>& basis,
                                  const MatrixXd& conormals) const;
  // The same at the point x and the time t.
  MatrixXd directions(const VectorXd& x, const LinearMap<double>& basis, const MatrixXd& conormals,
                      double t = 0.0) const;

 protected:
  // `units`: nominal sizes of the Ñ numbers of a tangent vector, all positive, or empty for 1.
  // Throws std::invalid_argument where one is not.
  explicit Projector(std::string name, VectorXd units = {});
  const VectorXd& units() const { return units_; }

 private:
  // Tangent vectors at x (Ñ × d) that span the directions. tangents: Π, the orthogonal projector onto T_xM, the
  // identity where n = Ñ; conormals: d covectors at x (Ñ × d), independent, with C = Πᵀ C.
  virtual ExprMatrix do_directions(const ExprVector& x, const Expr& t,
                                   const LinearMap<Expr>& tangents,
                                   const ExprMatrix& conormals) const = 0;
  // May override: what to do where the directions meet T_xM_f.
  virtual std::string do_advice() const { return "Use the orthogonal projector."; }

  std::string name_;
  VectorXd units_;
};

// The nearest point in a metric G on T_xM, in the tangent representation (Ñ × Ñ): W is G-orthogonal
// to T_xM_f, Πᵀ G W = C for conormals C. Moves onto any M_f.
//
// G is the Euclidean one; or diag(1/u²) for units u of one's own; or given by formulas.
class OrthogonalProjector final : public Projector {
 public:
  OrthogonalProjector() : OrthogonalProjector(VectorXd()) {}
  explicit OrthogonalProjector(VectorXd units) : Projector("orthogonal", std::move(units)) {}
  // G by formulas; symmetric and positive definite on T_xM.
  OrthogonalProjector(const Manifold& manifold, const MatrixFormula& metric);
  bool is_orthogonal() const override { return !metric_ && units().size() == 0; }
  bool is_always_complement() const override { return !metric_; }

 private:
  ExprMatrix do_directions(const ExprVector& x, const Expr& t, const LinearMap<Expr>& tangents,
                           const ExprMatrix& conormals) const override;

  MatrixFormula metric_;  // x ↦ G, or empty
};

// For points (q, p): q stays, p moves as little as possible in the metric g^{ij} (Section 8.2; for
// M_f = Im α, Section 6.2, it is p ↦ α(q)). W = {(0, g β) : β ∈ the momentum parts of the
// conormals}: for μ_i^a(q) g^{ij} p_j = 0 it is the span of the μ^a. Position constraints can't be
// met by moving p: std::domain_error.
class MomentumProjector final : public Projector {
 public:
  // `metric`: g_{ij} (Ñ_Q × Ñ_Q); without one diag(u²) of the momenta's units u.
  explicit MomentumProjector(const std::shared_ptr<const CotangentBundle>& phase_space,
                             const MatrixFormula& metric = {}, VectorXd units = {});
  // Any manifold: `momenta` are the entries of a tangent vector that may move, `metric` is k × k
  // for k of them. Throws std::invalid_argument if an index is out of range.
  MomentumProjector(const Manifold& manifold, std::vector<Index> momenta,
                    const MatrixFormula& metric = {}, VectorXd units = {});

  // Half of the tangent representation: the momenta of a cotangent bundle.
  static std::vector<Index> momenta_of(const CotangentBundle& phase_space);

  // All of T*_qQ if every momentum is determined by q.
  bool has_constant_directions(Index codimension) const override {
    return codimension == momentum_dimension_;
  }

 private:
  ExprMatrix do_directions(const ExprVector& x, const Expr& t, const LinearMap<Expr>& tangents,
                           const ExprMatrix& conormals) const override;

  std::vector<Index> momenta_;
  Index momentum_dimension_;
  MatrixFormula metric_;  // x ↦ g, or empty
};

}  // namespace courant
