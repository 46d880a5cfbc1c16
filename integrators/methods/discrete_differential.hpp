// DiscreteDifferential: covectors that give the difference of a function exactly.
#pragma once

#include <string>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// The difference E(x₁) - E(x₀) of a function between the ends of a discretization map at x̄, where
// (x₀, x₁) = R_d(x̄, v), seen from T_x̄M:
//
//   end(w) = E(R_d⁺(x̄, w)),   start(w) = E(R_d⁻(x̄, w)),   Ê = end - start
//
// so that Ê(0) = 0, dÊ(0) = dE(x̄) by (D2), and Ê(v) = E(x₁) - E(x₀).
struct EnergyDifference {
  ExprVector w;     // variables, Ñ
  Expr end, start;  // expressions of w
  ExprVector v;     // Ñ
  // R_d⁺(x̄, w) = R_d⁻(x̄, -w): Ê is odd, and the points x₀ = R_d⁺(x̄, -v), x₁ = R_d⁺(x̄, v) are the ends of
  // one curve.
  bool is_symmetric = false;
};

// A discrete differential α(x̄, v) ∈ T*_x̄M of E: on every manifold, with any discretization map,
//
//   C1  ⟨α, v⟩ = E(x₁) - E(x₀)
//   C2  α = dE(x̄) at v = 0
//
// (discrete gradients; on manifolds Celledoni, Eidnes, Owren, Ringholm, 2018). Neither divides by v
// or by its components: α is smooth at v = 0 and where components of v are 0, and known to round-off
// of dE however short v is, since differences of E are taken by divided_difference.
//
// Immutable. To subclass: override name, order, is_symmetric and do_value.
class DiscreteDifferential {
 public:
  virtual ~DiscreteDifferential() = default;

  virtual std::string name() const = 0;
  // Of the one-step method with a symmetric map, which has order 2 itself.
  virtual int order() const = 0;
  // α(x̄, -v) = α(x̄, v) with a symmetric map: the method is its own adjoint.
  virtual bool is_symmetric() const = 0;

  // α, size Ñ; `units`: nominal sizes of the components of v, which a correction along v is measured
  // by.
  ExprVector operator()(const EnergyDifference& difference, const VectorXd& units) const {
    return do_value(difference, units);
  }

 private:
  // To subclass, override:
  virtual ExprVector do_value(const EnergyDifference& difference, const VectorXd& units) const = 0;
};

// α = dE(x̄) + c G v with the one c that C1 asks for, and G = diag(units)⁻² (Gonzalez, 1996).
class GonzalezDifferential final : public DiscreteDifferential {
 public:
  std::string name() const override { return "gonzalez"; }
  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }

 private:
  ExprVector do_value(const EnergyDifference& difference, const VectorXd& units) const override;
};

// α = ∫₀¹ dÊ(s v) ds, the averaged vector field method (Quispel, McLaren, 2008), by Gauss's rule with
// four points: exact for polynomials of degree eight. What the rule leaves of C1 is taken out along
// v as in GonzalezDifferential.
class AveragedDifferential final : public DiscreteDifferential {
 public:
  std::string name() const override { return "averaged-vector-field"; }
  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }

 private:
  ExprVector do_value(const EnergyDifference& difference, const VectorXd& units) const override;
};

// α_i = the difference of E over the i-th of Ñ parts of a way from x₀ to x₁, on which one component of v
// after the other changes, divided by v_i (Itoh, Abe, 1988). With a symmetric map the ends of part i
// are R_d⁺(x̄, (v₁ … v_i, -v_{i+1} …)); otherwise Ê at (v₁ … v_i, 0 …), which is the same for theta =
// 0. It needs no derivative of E, and depends on the order of the coordinates.
class ItohAbeDifferential final : public DiscreteDifferential {
 public:
  std::string name() const override { return "itoh-abe"; }
  int order() const override { return 1; }
  bool is_symmetric() const override { return false; }

 private:
  ExprVector do_value(const EnergyDifference& difference, const VectorXd& units) const override;
};

}  // namespace courant
