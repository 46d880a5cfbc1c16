// Manifold: what a space has to supply so that integrators can be built on it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/expressions/linear_map.hpp"

namespace courant {

// A smooth manifold M of dimension n with a retraction R: TM → M.
//
// Points x are ambient vectors, x ∈ R^N. Tangent vectors v ∈ R^Ñ and covectors α ∈ (R^Ñ)* use the
// representation that the textbooks use for that manifold: Rⁿ itself, ambient vectors orthogonal to
// x on a sphere, left-trivialised Lie algebra components on a Lie group, pairs on bundles and
// products. n ≤ Ñ; where n < Ñ (spheres) the vectors that are tangent at x are the range of the
// projector Π(x) = C(x) E(x), and covectors satisfy α = Π(x)ᵀ α. Covectors are their own kind:
// nothing identifies T*M with TM.
//
//   E(x) = frame(x): R^Ñ → R^N,  v ↦ ẋ          C(x) = coframe(x): R^N → R^Ñ,  ẋ ↦ v
//
// Laws, measured by check_manifold; r(x) = injectivity_radius(x):
//   M1  R(x, 0) = x                                       for x ∈ M
//   M2  d/ds R(x, s v) = E(x) v at s = 0                  for v ∈ T_xM
//   M3  constraint(R(x, v)) = 0                           for ‖v‖ < r(x)
//   M4  R⁻¹(x, R(x, v)) = v,  R(x, R⁻¹(x, y)) = y         for ‖v‖ < r(x), r(x) > 0
//   M5  C E C = C and E C E = E on M, rank n;             E(x) R^Ñ = ker d constraint(x)
//   M6  every map is smooth at and near v = 0             derivatives are finite and right
//   M7  s ↦ R(x, s v) are geodesics of a connection       where is_geodesic() claims it
//   M8  random_point, project and tangent_basis are on M  tangent_basis orthonormal, of n columns
//   M9  R⁻¹(R(x, v), R(x, w)) is the same at every x      where unit() claims a group
//   M10  velocity_along(x, v, s) = C(y) dy/ds             of the curve y = R(x, s v)
//   M11  R(D x, D v) = D R(x, v)                          for D of scaling_symmetries()
//   M12  R(source(y, v), v) = y                           where has_source() claims it
//
// Every formula is written once, on Expr; given numbers, the same functions return numbers
// (constants fold). Reference: Absil, Mahony, Sepulchre, Optimization Algorithms on Matrix
// Manifolds (2008), Definition 4.1 of the paper (R1, R2).
//
// To subclass: pass the sizes to the constructor, override the pure functions; about 25 lines. See
// docs/tutorial-new-manifold.md.
class Manifold {
 public:
  // Scaling symmetries of M: what may be measured in a unit of its own, since multiplying it changes nothing of M. A
  // position in Rⁿ, each coordinate by itself; no angle, and no point of a sphere.
  struct ScalingSymmetries {
    static constexpr Index none = -1;
    std::vector<Index> point;    // N: the number of the unit of each coordinate, or none
    std::vector<Index> tangent;  // Ñ: those of the components of tangent vectors
    // Ñ: of momenta, the same unit for those components that the maps of M mix. In TM and T*M these are free
    // besides.
    std::vector<Index> fibre;

    // The number after those of a list, and a list at the end of another with its numbers counted from there.
    static Index after(const std::vector<Index>& units);
    static void append(const std::vector<Index>& units, Index first, std::vector<Index>& all);
  };

  virtual ~Manifold() = default;

  const std::string& name() const { return name_; }  // with its parameters: "Sphere(2)"
  Index dimension() const { return dimension_; }     // n
  Index ambient_dimension() const { return ambient_dimension_; }  // N
  Index tangent_dimension() const { return tangent_dimension_; }  // Ñ

  // Whether both are the same set with the same representation and the same maps, so that what is
  // given on one of them may be used on the other. A manifold equals itself; others have to be of
  // one class and say so (do_equals).
  bool operator==(const Manifold& other) const;

  // The maps above, on expressions or on numbers. Wrong sizes throw std::invalid_argument. Points
  // and vectors are not checked for being on the manifold or tangent to it (point_defect and
  // tangent_defect measure that).
  template <class X, class V>
  auto retract(const Eigen::MatrixBase<X>& x, const Eigen::MatrixBase<V>& v) const {
    return on<X>([&] { return checked_retract(x.template cast<Expr>(), v.template cast<Expr>()); });
  }
  // Throws std::logic_error on expressions if !has_inverse(); numbers are then inverted by Newton's
  // method (std::domain_error where that does not converge).
  template <class X, class Y>
  auto inverse_retract(const Eigen::MatrixBase<X>& x, const Eigen::MatrixBase<Y>& y) const {
    if constexpr (!std::is_same_v<typename X::Scalar, Expr>) {
      if (!has_inverse()) return newton_inverse(x, y);
    }
    return on<X>(
        [&] { return checked_inverse_retract(x.template cast<Expr>(), y.template cast<Expr>()); });
  }
  template <class X>
  auto frame(const Eigen::MatrixBase<X>& x) const {  // N × Ñ
    return on<X>([&] { return checked_frame(x.template cast<Expr>()); });
  }
  template <class X>
  auto coframe(const Eigen::MatrixBase<X>& x) const {  // Ñ × N
    return on<X>([&] { return checked_coframe(x.template cast<Expr>()); });
  }
  template <class X>
  auto constraint(const Eigen::MatrixBase<X>& x)
      const {  // equations of the embedding, at least N - n; zero on M
    return on<X>([&] { return checked_constraint(x.template cast<Expr>()); });
  }

  // Whether E(x) and C(x) are the identity at every x, as on Rⁿ: frame and coframe then return it as
  // such (LinearMap), which takes no memory. A claim that check_manifold measures (M2).
  bool has_identity_frame() const { return do_has_identity_frame(); }
  // Which entries of the tangent vectors at x are those of their velocities in R^N, (E(x) v)_i = v_i on T_xM (Ñ): all on Rⁿ
  // and on spheres, some on Heisenberg's group, where N = Ñ too, none where N is not Ñ. Of more than 200 numbers, whose E is
  // a large matrix, all where N = Ñ.
  Eigen::Array<bool, Eigen::Dynamic, 1> velocities_among_components(const VectorXd& x) const;
  // Whether all of them are, at a random point.
  bool has_velocities_as_vectors() const;

  // Π(x) = C(x) E(x), Ñ × Ñ: the identity where n = Ñ, since no vector needs projecting there.
  template <class X>
  auto tangent_projector(const Eigen::MatrixBase<X>& x) const {
    return on<X>([&] { return checked_projector(x.template cast<Expr>()); });
  }
  // The chart at x₀: R_{x₀}(B ξ) for ξ ∈ Rⁿ and a basis B (Ñ × n) of T_{x₀}M.
  template <class X, class B, class Xi>
  auto chart(const Eigen::MatrixBase<X>& x0, const Eigen::MatrixBase<B>& basis,
             const Eigen::MatrixBase<Xi>& xi) const {
    return retract(x0, (basis * xi).eval());
  }
  template <class X, class Scalar, class Xi>
  auto chart(const Eigen::MatrixBase<X>& x0, const LinearMap<Scalar>& basis,
             const Eigen::MatrixBase<Xi>& xi) const {
    return retract(x0, basis * xi);
  }

  // Whether inverse_retract is a closed formula, so that it works on expressions.
  virtual bool has_inverse() const { return true; }
  // Whether s ↦ retract(x, s v) are the geodesics of a connection, so that with m = retract(x, s v)
  // and y = retract(x, v) inverse_retract(m, x) = -s w and inverse_retract(m, y) = (1-s) w for one
  // w ∈ T_mM (exponential maps). A claim that check_manifold measures.
  virtual bool is_geodesic() const { return false; }

  // Whether source is a closed formula, on a group.
  virtual bool has_source() const { return false; }
  // The point x with R(x, v) = y: y τ(v)⁻¹ where R(x, v) = x τ(v). Throws std::logic_error unless has_source().
  template <class Y, class V>
  auto source(const Eigen::MatrixBase<Y>& y, const Eigen::MatrixBase<V>& v) const {
    return on<Y>([&] { return checked_source(y.template cast<Expr>(), v.template cast<Expr>()); });
  }

  // The unit element, where M is a Lie group with left-trivialised vectors and a left-invariant
  // retraction: then formulas in vectors and covectors (torsion, lifts) are the same at every point
  // as there. Empty by default, which is always right; a claim that check_manifold measures (M9).
  std::optional<VectorXd> unit() const { return do_unit(); }

  // Numbered from 0, those of fibre by themselves. By default M has none, and momenta have one unit, which is always
  // right; a claim that check_manifold measures (M11).
  ScalingSymmetries scaling_symmetries() const;

  // C(y) dy/ds of the curve y = R_x(s v), as a tangent vector at y; on expressions.
  ExprVector velocity_along(const ExprVector& x, const ExprVector& v, const Expr& s) const;

  // A number below Ñ for each component of tangent vectors: the same for those that Π mixes somewhere.
  std::vector<Index> mixed_components() const;

  // An orthonormal basis of T_xM in the tangent representation, Ñ × n; the identity where n = Ñ.
  // Constant where that holds.
  LinearMap<double> tangent_basis(const VectorXd& x) const;

  // ‖constraint(x)‖_∞, +∞ outside an open domain: 0 on M.
  double point_defect(const VectorXd& x) const;
  // ‖v - Π(x) v‖_∞: 0 for a tangent vector.
  double tangent_defect(const VectorXd& x, const VectorXd& v) const;
  // A distance between points that can be compared with zero; the ambient distance by default.
  double separation(const VectorXd& x, const VectorXd& y) const;
  // A length (Euclidean norm in the tangent representation) below which retract at x is a
  // diffeomorphism onto its image.
  double injectivity_radius(const VectorXd& x) const;
  // v ↦ how much of the domain of R_x it takes up: R_x is injective on {v ∈ T_xM : extent(v) < 1}.
  // ‖v‖/injectivity_radius(x), but for components that nothing limits, as those along the fibres
  // of bundles.
  using Extent = std::function<double(const VectorXd& v)>;
  Extent extent_at(const VectorXd& x) const;
  // The point of M near x: x itself up to round-off if x ∈ M. Throws std::domain_error if there is
  // none.
  VectorXd project(const VectorXd& x) const;
  VectorXd random_point(std::mt19937& generator) const;
  // A tangent vector at x of length `length`, in a random direction (0 if n = 0).
  VectorXd random_tangent(const VectorXd& x, double length, std::mt19937& generator) const;

 protected:
  // Throws std::invalid_argument unless 0 ≤ n ≤ Ñ and n ≤ N.
  Manifold(std::string name, Index dimension, Index ambient_dimension, Index tangent_dimension);

  // velocity_along by differentiation.
  ExprVector differentiated_velocity(const ExprVector& x, const ExprVector& v, const Expr& s) const;

 private:
  // To subclass, override:
  virtual ExprVector do_retract(const ExprVector& x, const ExprVector& v) const = 0;
  virtual ExprMatrix do_frame(const ExprVector& x) const = 0;
  virtual ExprMatrix do_coframe(const ExprVector& x) const = 0;

 protected:
  // May override; an override can call the default:
  // See has_identity_frame; do_frame and do_coframe are then not asked.
  virtual bool do_has_identity_frame() const { return false; }
  // Whether another object of this class is the same manifold; false by default, which is always
  // safe. Where the name holds all parameters: other.name() == name().
  virtual bool do_equals(const Manifold&) const { return false; }
  virtual ExprVector do_inverse_retract(const ExprVector& x,
                                        const ExprVector& y) const;  // or has_inverse() → false
  virtual ExprVector do_source(const ExprVector& y,
                               const ExprVector& v) const;  // and has_source() → true
  virtual std::optional<VectorXd> do_unit() const { return std::nullopt; }
  virtual ScalingSymmetries do_scaling_symmetries() const;
  // Π, where n < Ñ: C E, or what is equal on M and does not mix more off it.
  virtual ExprMatrix do_tangent_projector(const ExprVector& x) const;
  // Where there is a shorter formula than the one by differentiation:
  virtual ExprVector do_velocity_along(const ExprVector& x, const ExprVector& v,
                                       const Expr& s) const {
    return differentiated_velocity(x, v, s);
  }
  virtual ExprVector do_constraint(
      const ExprVector& x) const;  // must, unless n = N (an open subset of R^N)
  virtual double do_point_defect(
      const VectorXd& x) const;  // must, for an open subset that isn't all of R^N
  virtual double do_separation(
      const VectorXd& x, const VectorXd& y) const;  // where points have several representatives
  virtual double do_injectivity_radius(
      const VectorXd& x) const;  // +∞ by default: must, unless R_x is injective on T_xM
  virtual Extent do_extent_at(const VectorXd& x) const;
  virtual VectorXd do_project(const VectorXd& x) const;  // default: Gauss–Newton on the constraint
  virtual VectorXd do_random_point(
      std::mt19937& generator) const;  // default: a projected normal vector

 private:
  // The value on expressions, or its numbers if the argument X was numbers.
  template <class X, class Formula>
  static auto on(const Formula& formula) {
    if constexpr (std::is_same_v<typename X::Scalar, Expr>)
      return formula();
    else
      return values(formula());
  }
  ExprVector checked_retract(const ExprVector& x, const ExprVector& v) const;
  ExprVector checked_inverse_retract(const ExprVector& x, const ExprVector& y) const;
  ExprVector checked_source(const ExprVector& y, const ExprVector& v) const;
  LinearMap<Expr> checked_frame(const ExprVector& x) const;
  LinearMap<Expr> checked_coframe(const ExprVector& x) const;
  LinearMap<Expr> checked_projector(const ExprVector& x) const;
  ExprVector checked_constraint(const ExprVector& x) const;
  VectorXd newton_inverse(const VectorXd& x, const VectorXd& y) const;
  void check_size(const char* function, const char* argument, Index size, Index expected,
                  const char* meaning) const;

  std::string name_;
  Index dimension_;
  Index ambient_dimension_;
  Index tangent_dimension_;
};

}  // namespace courant
