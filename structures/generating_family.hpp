// GeneratingFamily: the submanifold 𝓛 ⊂ T*M of a Dirac system, as a Morse family.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {

// E: M × R^k → R, (x, λ) ↦ E(x, λ, t), which generates
//
//   𝓛 = {∂_x E(x, λ) : ∂_λ E(x, λ) = 0} ⊂ T*M
//
// (Section 2.3 of the paper; Morse families: its reference [4]).
//
//   Hamiltonian                       E = H(x), k = 0
//   Lagrangian, singular or not       E(q, p, w) = ⟨p, w⟩ - L(q, w) on M = T*Q (Section 5.1.1)
//   holonomic constraints             E(x, λ) = H(x) + ⟨λ, φ(x)⟩
//   optimal control (Pontryagin)      E(q, p, u) = ⟨p, f(q, u)⟩ - ℓ(q, u)
//
// 𝓛 is a Lagrangian submanifold where the rank of ∂_λ(∂_x E, ∂_λ E) is k on it: the condition of a
// Morse family. Nothing here needs that.
//
// Laws, measured by check_generating_family at points of 𝓛:
//   G1  differential and stationarity are the derivatives of value
//   G2  the rank of ∂_λ(∂_x E, ∂_λ E) is k, if is_morse() claims it
//
// Immutable. To subclass: override do_value.
class GeneratingFamily {
 public:
  virtual ~GeneratingFamily() = default;

  const std::shared_ptr<const Manifold>& manifold() const { return manifold_; }
  Index parameter_size() const { return parameter_size_; }  // k

  // The claim: the rank of ∂_λ(∂_x E, ∂_λ E) is k on 𝓛, which is then a Lagrangian submanifold. No
  // value: unknown.
  virtual std::optional<bool> is_morse() const {
    return parameter_size_ == 0 ? std::optional(true) : std::nullopt;
  }

  // E(x, λ, t); x: N, λ: k.
  Expr value(const ExprVector& x, const ExprVector& lambda, const Expr& t) const;
  // E(x)ᵀ ∂_x E: the covector in the representation of M (size Ñ), for x and λ that are any
  // expressions or constants.
  ExprVector differential(const ExprVector& x, const ExprVector& lambda, const Expr& t) const;
  // ∂_λ E (size k).
  ExprVector stationarity(const ExprVector& x, const ExprVector& lambda, const Expr& t) const;
  // What is conserved along the flow if nothing depends on time: E itself by default.
  Expr energy(const ExprVector& x, const ExprVector& lambda, const Expr& t) const {
    return do_energy(x, lambda, t);
  }
  // Where to start a search for the λ that goes with a tangent vector v at x (size Ñ): the velocity
  // itself for a Lagrangian, 0 where nothing is known. Size k.
  VectorXd parameter_guess(const VectorXd& x, const VectorXd& v) const {
    return do_parameter_guess(x, v);
  }

 protected:
  GeneratingFamily(std::shared_ptr<const Manifold> manifold, Index parameter_size);

 private:
  virtual Expr do_value(const ExprVector& x, const ExprVector& lambda, const Expr& t) const = 0;
  virtual Expr do_energy(const ExprVector& x, const ExprVector& lambda, const Expr& t) const {
    return value(x, lambda, t);
  }
  virtual VectorXd do_parameter_guess(const VectorXd&, const VectorXd&) const {
    return VectorXd::Zero(parameter_size_);
  }
  ExprVector derivative(const ExprVector& x, const ExprVector& lambda, const Expr& t,
                        bool by_lambda) const;

  std::shared_ptr<const Manifold> manifold_;
  Index parameter_size_;
};

// Im dH for a Hamiltonian H: M → R.
class Hamiltonian final : public GeneratingFamily {
 public:
  using Formula = std::function<Expr(const ExprVector& x, const Expr& t)>;
  Hamiltonian(std::shared_ptr<const Manifold> manifold, Formula hamiltonian);

 private:
  Expr do_value(const ExprVector& x, const ExprVector& lambda, const Expr& t) const override;
  Formula hamiltonian_;
};

// 𝓛 = 𝓘_{TQ}⁻¹(Im dL) for a Lagrangian L: TQ → R, regular or singular, by E(q, p, w) = ⟨p, w⟩ -
// L(q, w); k = Ñ_Q. Where n < Ñ there is ⟨w - Π w, μ (w - Π w)⟩/2 besides, with masses μ as those of L, which says
// that w is tangent: without it nothing would determine the rest of w. Its energy is ⟨∂_w L, w⟩ - L, which doesn't
// contain p: for L = ⟨α(q), w⟩ - H(q) it is H(q) on and off M_0.
class Lagrangian final : public GeneratingFamily {
 public:
  using Formula = std::function<Expr(const ExprVector& q, const ExprVector& w, const Expr& t)>;
  Lagrangian(std::shared_ptr<const CotangentBundle> phase_space, Formula lagrangian);
  // ∂_p ∂_w E is the identity.
  std::optional<bool> is_morse() const override { return true; }

 private:
  Expr do_value(const ExprVector& x, const ExprVector& w, const Expr& t) const override;
  Expr do_energy(const ExprVector& x, const ExprVector& w, const Expr& t) const override;
  VectorXd do_parameter_guess(const VectorXd& x, const VectorXd& v) const override;
  VectorXd nominal_masses() const;

  std::shared_ptr<const CotangentBundle> phase_space_;
  Formula lagrangian_;
  VectorXd normal_masses_;  // Ñ, the same for components that Π mixes
};

}  // namespace courant
