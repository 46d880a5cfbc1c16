// DiscretizationMap: R_d: TM → M × M.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "courant/manifolds/manifold.hpp"

namespace courant {

// A smooth map R_d = (R⁻, R⁺): TM → M × M (Definition 4.5). With it one step of S ⊂ TM is
//
//   (1/h) R_d⁻¹(x₀, x₁) ∈ S.
//
// Laws, measured by check_discretization_map:
//   D1  R_d(0_x) = (x, x)
//   D2  d/ds (R⁺ - R⁻)(s v) = v at s = 0, in the frame of M
//   D3  inverse(forward(x, v)) = (x, v) for ‖v‖ < domain_radius(), and
//       forward(inverse(x₀, x₁)) = (x₀, x₁) near the diagonal (Proposition 4.6)
//   D4  the claims order(), is_symmetric() and is_symplectic() hold
//   D5  forward(x̄, v) = (x₀, x₁) for (x̄, v, x₁) = from_start(x₀, w), near w = 0, if has_start()
//   D6  stage_time() is an eigenvalue of K, R⁻(s v) = x - s K v + O(s²): time takes part as a
//       coordinate would
//   D7  R_d(g x, v) = g R_d(x, v), if is_left_invariant() claims it
//
// x, x₀, x₁: points (N); v: tangent vector (Ñ). Immutable. To subclass: override do_forward and the
// claims.
class DiscretizationMap {
 public:
  template <class Scalar>
  struct PointPair {
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> first, second;  // x⁻, x⁺
  };
  template <class Scalar>
  struct TangentVector {
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x, v;
  };

  struct Displacement {
    ExprVector x, v, end;
  };

  virtual ~DiscretizationMap() = default;

  const std::string& name() const { return name_; }
  const std::shared_ptr<const Manifold>& manifold() const { return manifold_; }

  // (x⁻, x⁺), on expressions or on numbers. Throws std::invalid_argument on wrong sizes.
  template <class X, class V>
  auto forward(const Eigen::MatrixBase<X>& x, const Eigen::MatrixBase<V>& v) const {
    if constexpr (std::is_same_v<typename X::Scalar, Expr>)
      return checked_forward(x, v);
    else
      return numeric_forward(x, v);
  }

  // (x, v). On expressions throws std::logic_error if !has_inverse(); numbers are then inverted by
  // Newton's method, std::domain_error where that does not converge.
  template <class X, class Y>
  auto inverse(const Eigen::MatrixBase<X>& x0, const Eigen::MatrixBase<Y>& x1) const {
    if constexpr (std::is_same_v<typename X::Scalar, Expr>)
      return checked_inverse(x0, x1);
    else
      return numeric_inverse(x0, x1);
  }

  // The pairs that begin at x₀, by tangent vectors w at x₀: (x̄, v, x₁) with R_d(x̄, v) = (x₀, x₁)
  // and v = w to first order. A step has w as unknown, which for most maps is a shorter formula
  // than R_d⁻¹(x₀, R_{x₀}(w)). Throws std::logic_error if !has_start().
  Displacement from_start(const ExprVector& x0, const ExprVector& w) const;

  // ‖v‖ below which forward is defined and injective, where that is less than the injectivity
  // radius of the manifold.
  virtual double domain_radius() const { return std::numeric_limits<double>::infinity(); }
  // Whether inverse is a closed formula.
  virtual bool has_inverse() const { return true; }
  // Whether from_start is one.
  virtual bool has_start() const { return has_inverse(); }
  // The order of the one-step method that the map gives on an ordinary differential equation.
  virtual int order() const = 0;
  // Where between t and t + h the system is evaluated if it depends on time: t + stage_time() h.
  virtual double stage_time() const { return 0.5; }
  // R⁺(v) = R⁻(-v): the method is its own adjoint.
  virtual bool is_symmetric() const = 0;
  // On a group (Manifold::unit): R_d(g x, v) = g R_d(x, v). False where that is unknown.
  virtual bool is_left_invariant() const { return false; }
  // On T*Q: whether R_d pulls pr₂*ω_Q - pr₁*ω_Q back to d_Tω_Q (Corollary 4.12). No value: unknown,
  // or M isn't a cotangent bundle.
  virtual std::optional<bool> is_symplectic() const { return std::nullopt; }

 protected:
  DiscretizationMap(std::string name, std::shared_ptr<const Manifold> manifold);
  // from_start by inverse at retract(x0, w).
  Displacement from_start_by_inverse(const ExprVector& x0, const ExprVector& w) const;

 private:
  // To subclass, override:
  virtual PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const = 0;

 protected:
  // May override, and call the default (or has_inverse() → false, and numbers are inverted by Newton's method):
  virtual TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const;
  virtual Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const {
    return from_start_by_inverse(x0, w);
  }

 private:
  PointPair<Expr> checked_forward(const ExprVector& x, const ExprVector& v) const;
  PointPair<double> numeric_forward(const VectorXd& x, const VectorXd& v) const;
  TangentVector<Expr> checked_inverse(const ExprVector& x0, const ExprVector& x1) const;
  TangentVector<double> numeric_inverse(const VectorXd& x0, const VectorXd& x1) const;

  std::string name_;
  std::shared_ptr<const Manifold> manifold_;
};

}  // namespace courant
