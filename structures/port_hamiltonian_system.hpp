// PortHamiltonianSystem: a Hamiltonian with dissipation and ports.
#pragma once

#include <functional>
#include <optional>

#include "courant/structures/generating_family.hpp"
#include "courant/structures/matrix_field.hpp"
#include "courant/structures/port_system.hpp"

namespace courant {

// S = {(x, v)} of equations (20), (24) and (26), with resistive ports R(x) ⪰ 0 closed by
// themselves:
//
//   open     v = (J(x) - R(x)) dH + B(x) u,   y = B(x)ᵀ dH + D(x) u,   u = input(t, y)
//   closed   v = (J(x) - R(x)) dH + B(x) u,   y = B(x)ᵀ dH + D(x) u,   0 = y
//
// Auxiliary unknowns z = u ∈ R^m. Along solutions dH/dt = ⟨y, u⟩ - dHᵀ R dH - uᵀ D u (and ⟨y, u⟩ = 0 if closed): each
// port supplies y_a u_a, "resistance" and "feedthrough" dissipate. J: Ñ × Ñ, skew, with range in T_xM; R: Ñ × Ñ,
// symmetric, likewise; B: Ñ × m; D, the feedthrough, m × m, in which the ports are passive where D + Dᵀ ⪰ 0. The Dirac
// structure behind it, without R, is ClosedPortHamiltonian(J, B), or OpenPortHamiltonian(J, B).
class PortHamiltonianSystem final : public PortSystem {
 public:
  // u for the time and the outputs y (m).
  using Input = std::function<ExprVector(const Expr& t, const ExprVector& y)>;
  struct Matrices {
    MatrixField J, R, B;  // R may be empty: none
    Index m = 0;
    MatrixField D = {};  // may be empty: none
  };
  // `energy` has no parameters. Without an input the ports are closed. Throws
  // std::invalid_argument if the energy has parameters or a matrix is missing.
  PortHamiltonianSystem(Matrices matrices, std::shared_ptr<const GeneratingFamily> energy,
                        std::optional<Input> input, Names names = {});

  Index tangent_blocks() const override { return 1; }
  const Matrices& matrices() const { return matrices_; }

 private:
  Expr do_generator(const ExprVector& x, const ExprVector& u, const Expr& t) const override;
  ExprVector do_effort(const ExprVector& x, const ExprVector& u, const Expr& t) const override;
  bool do_is_free(Index port) const override;
  ExprVector do_output(const ExprVector& x, const ExprVector& alpha,
                       const ExprVector& u) const override;
  ExprVector do_inner_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                const ExprVector& u, const Expr& t) const override;
  ExprVector do_port_equations(const Expr& t, const ExprVector& u,
                               const ExprVector& y) const override;
  Powers do_inner_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                         const ExprVector& u, const Expr& t) const override;

  Matrices matrices_;
  std::shared_ptr<const GeneratingFamily> energy_;
  std::optional<Input> input_;
};

}  // namespace courant
