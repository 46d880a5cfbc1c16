// EnergySystem: an implicit system that is driven by the differential of its energy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/structures/implicit_system.hpp"

namespace courant {

// What enters or leaves by one port.
struct PortPower {
  std::string port;
  Expr power;
};

// S = {(x, v) : ∃ z, F(x, v, z, t) = 0} where the equations are known for any covector α in the
// place of d_xE, and E is the energy H(x, t) where its constraints hold:
//
//   F(x, v, z, t) = G(x, v, α, z, t; x, t)   with α = d_xE(x, z, t)
//
// (x, v, α) are the point, flow and effort of Section 7. The last two arguments (y, s) of G are where
// constraints ∂E/∂z = 0 are asked for: with an E that is affine in multipliers, E = H + Σ λ_b φ_b,
// these are φ_b(y, s) = 0. A step that has another α than d_xE, a discrete gradient, is made of G.
//
// Along solutions of G, whatever α is,
//
//   ⟨α, v⟩ = Σ supplied - Σ dissipated
//
// and what dissipates takes power where R ⪰ 0. To subclass: as ImplicitSystem, with the functions
// below in the place of do_residual.
class EnergySystem : public ImplicitSystem {
 public:
  // Whether E is affine in the z that it contains and is the energy where ∂E/∂z = 0. Not so for a
  // Lagrangian, whose E(x, w) = ⟨p, w⟩ - L(q, w) has velocities in the place of multipliers.
  bool has_explicit_energy() const { return do_has_explicit_energy(); }

  // E(x, z, t) and d_xE in the representation of M (size Ñ).
  Expr generator(const ExprVector& x, const ExprVector& z, const Expr& t) const {
    return do_generator(x, z, t);
  }
  ExprVector effort(const ExprVector& x, const ExprVector& z, const Expr& t) const {
    return do_effort(x, z, t);
  }
  // G, size equation_count().
  ExprVector equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                       const ExprVector& z, const Expr& t, const ExprVector& y,
                       const Expr& s) const {
    return do_equations(x, v, alpha, z, t, y, s);
  }

  struct Powers {
    std::vector<PortPower> supplied, dissipated;
  };
  // What is supplied and what is dissipated, port by port; none for a closed system without losses.
  Powers powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                const ExprVector& z, const Expr& t) const {
    return do_powers(x, v, alpha, z, t);
  }

 protected:
  using ImplicitSystem::ImplicitSystem;

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const final {
    return do_equations(x, v, do_effort(x, z, t), z, t, x, t);
  }

  // To subclass, override:
  virtual Expr do_generator(const ExprVector& x, const ExprVector& z, const Expr& t) const = 0;
  virtual ExprVector do_effort(const ExprVector& x, const ExprVector& z, const Expr& t) const = 0;
  virtual ExprVector do_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                  const ExprVector& z, const Expr& t, const ExprVector& y,
                                  const Expr& s) const = 0;
  virtual Powers do_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& z, const Expr& t) const = 0;
  // May override:
  virtual bool do_has_explicit_energy() const { return true; }
  // Where the energy is not E itself.
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override {
    return do_generator(x, z, t);
  }
};

}  // namespace courant
