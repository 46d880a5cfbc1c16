// A submanifold given by equations.
#pragma once

#include <functional>

#include "courant/manifolds/manifold.hpp"

namespace courant {

// S = {x ∈ M : c(x) = 0} for a manifold M and independent equations c: M → R^k, of dimension n - k.
// Points, tangent vectors and covectors are represented as those of M.
//
// With A = dc E (k × Ñ) and W = Π_M Aᵀ, the projector is Π(x) = Π_M - W (A W)⁻¹ A: along W, which
// is orthogonal to S in the tangent representation where Π_M is symmetric. E = E_M Π, C = Π C_M.
//
// Retraction (orthographic): R_x(v) = R^M_x(v + W(x) λ) with the λ ∈ R^k for which c is zero there.
// Its inverse is closed, Π(x) applied to the inverse on M. λ itself is the solution of an equation
// that no formula solves in general: on expressions as on numbers it is what six steps of Newton's
// method from λ = 0 give. M1 and M2 hold exactly. The error of M3 and M4 squares with each step: it is
// about ε^64 where the first guess is off by a fraction ε of the radius of curvature, and below 1e-14
// within the injectivity radius. That is half the radius of curvature of S at x in M, and at most half
// the injectivity radius of M. It is an estimate from one point, right where the curvature does not grow
// much over that distance. Beyond it the result may be off S (point_defect tells) or not a number.
//
// projection(y) is P: M → S on expressions, near S: six Gauss–Newton steps
//
//   y ↦ R^M_y(-W (A W)⁻¹ c(y)).
//
// On S it satisfies P(x) = x and T P = Π. At a distance of a fraction ε of the radius of curvature
// the result is off S by about ε^64.
//
// Reference: Absil, Malick, Projection-like retractions on matrix manifolds (2012).
class ImplicitSubmanifold final : public Manifold {
 public:
  using Equations = std::function<ExprVector(const ExprVector& x)>;

  // c(x) has `count` entries. Throws std::invalid_argument if M is null or c of another size.
  ImplicitSubmanifold(const std::string& name, std::shared_ptr<const Manifold> M,
                      Equations equations, Index count);

  const std::shared_ptr<const Manifold>& surrounding() const { return surrounding_; }  // M
  ExprVector projection(const ExprVector& y) const;  // N ↦ N; std::invalid_argument on other sizes
  bool has_inverse() const override { return surrounding_->has_inverse(); }

 private:
  struct Normal {
    ExprMatrix A, W;  // dc E, k × Ñ, and Π_M Aᵀ
  };

  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override;
  ExprVector do_constraint(const ExprVector& x) const override;
  double do_point_defect(const VectorXd& x) const override;
  double do_separation(const VectorXd& x, const VectorXd& y) const override;
  double do_injectivity_radius(const VectorXd& x) const override;
  VectorXd do_random_point(std::mt19937& generator) const override;

  Normal normal(const ExprVector& x) const;
  ExprMatrix projector(const ExprVector& x) const;

  std::shared_ptr<const Manifold> surrounding_;
  Equations equations_;
  Index count_;
};

}  // namespace courant
