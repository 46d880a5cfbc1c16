// DerivativeArray: an implicit system and its time derivatives, as equations on jets.
#pragma once

#include <memory>
#include <optional>

#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/integrators/certificate/prolongation.hpp"
#include "courant/structures/implicit_system.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// F^[k] = (F, dF/dt, …, d^kF/dt^k) in the chart at a point x₀ ∈ M, on Taylor coefficients:
//
//   ξ(s) = Σ ξ_i sⁱ,  z(s) = Σ z_i sⁱ,   x(s) = R_{x₀}(B ξ(s)),  v = C(x) dx/ds,
//   F(x(s), v(s), z(s), t + s) = Σ_i F_i sⁱ,     F^[k](y) = (F_0, …, F_k),   d^iF/dtⁱ = i! F_i
//
// with B a basis of T_{x₀}M (the identity where n = Ñ). Its Jacobian needs the first derivatives of
// F only (G below is F in the chart): along the curve G_ξ, G_ξ', G_z are series themselves, and
//
//   ∂F_i/∂ξ_j = (G_ξ)_{i-j} + j (G_ξ')_{i-j+1},      ∂F_i/∂z_j = (G_z)_{i-j}          (block
//   Toeplitz).
//
// `at` moves the chart. Immutable.
// References: Campbell, Gear, The index of general nonlinear DAEs (1995); Kunkel, Mehrmann,
// Differential-Algebraic Equations (2006), chapter 3.
class DerivativeArray final : public Prolongation {
 public:
  // Throws std::invalid_argument if x0 does not have the size of a point. x0 is not checked for
  // being on M.
  DerivativeArray(std::shared_ptr<const ChartEquations> equations, double t, const VectorXd& x0);
  // Of equations that are traced for it alone.
  DerivativeArray(std::shared_ptr<const ImplicitSystem> system, double t, const VectorXd& x0);
  DerivativeArray at(double t, const VectorXd& x0) const;

  const std::shared_ptr<const ImplicitSystem>& system() const { return equations_->system(); }
  double t() const { return t_; }
  const VectorXd& origin() const { return origin_; }         // x₀
  const LinearMap<double>& basis() const { return basis_; }  // B, Ñ × n
  // |Bᵀ C(x₀) x₀|: what the chart coordinates, which are 0 at x₀, are small next to; 0 where only
  // round-off is left, as of a point of a sphere, which is normal to it.
  VectorXd origin_size() const;

  // The jet of level 0 with ξ_0 = 0 that has the tangent vector v (Ñ) and z (m); empty vectors are
  // zero.
  VectorXd jet(const VectorXd& v, const VectorXd& z) const;
  // F^[k](y) and its Jacobian, computed with 113 bits and rounded, without bounds of errors: t, x₀ and B are the
  // doubles that they are.
  Linearization linearize(const std::vector<Quadruple>& y) const;
  using Prolongation::linearize;
  // y with zeros appended, or cut, to level k.
  VectorXd resized(const VectorXd& y, Index k) const;

  // (t, x, v, z) of the jet y, and d(x, v, z)/d(ξ_0, ξ_1, z_0): (N + Ñ + m) × (2n + m).
  State state(const VectorXd& y) const;
  Linearization state_map(const VectorXd& y) const;

  // y, moved along the curve that it is the jet of, by `later` in time: to first order in what is left
  // out, a jet of at(t() + later, origin()).
  VectorXd carried(const VectorXd& y, double later) const;

  // Whether t stands in F.
  bool depends_on_time() const { return equations_->depends_on_time(); }
  // F is affine in (x, v, z) with constant coefficients.
  bool has_constant_jacobian() const override { return equations_->has_constant_jacobian(); }
  // F contains exp, sinh or cosh, as of a diode: derivatives of any size are near each other.
  bool has_exponentials() const { return equations_->has_exponentials(); }
  // y with ξ_1 and z_0 at which F vanishes at the same ξ_0, found from those of y with limits on
  // exponentials (LimitedNewton). Nothing if F has none, or if they are not found.
  std::optional<VectorXd> beyond_exponentials(const VectorXd& y) const;

 private:
  Linearization do_linearize(const VectorXd& y, const VectorXd& uncertainty,
                             Index k) const override;
  VectorXd do_residual(const VectorXd& y, Index k) const override;
  template <class Number, class Add>
  void each_entry(const std::vector<Number>& coefficients, Index k, const Add& add) const;
  void move_to(double t, const VectorXd& x0);
  VectorXd basis_entries() const;  // column by column; empty where the basis is the identity

  std::shared_ptr<const ChartEquations> equations_;
  double t_ = 0.0;
  VectorXd origin_;
  LinearMap<double> basis_;
};

}  // namespace courant
