// DiracStructure: D ⊂ TM ⊕ T*M.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/manifolds/manifold.hpp"
#include "courant/structures/linear_dirac.hpp"

namespace courant {

// A vector subbundle D ⊂ TM ⊕ T*M, given at each x by equations that are linear in (v, α, u):
//
//   (v, α) ∈ D_x  ⟺  ∃ u ∈ R^m : membership(x, v, α, u) = 0
//
// v: tangent vector (Ñ), α: covector (Ñ), both in the representation of M; u: port variables or
// multipliers that the description needs (m).
//
// Laws, measured by check_structure:
//   S1  dim D_x = n (at least n if it is only coisotropic)
//   S2  ⟨α₁, v₂⟩ + ⟨α₂, v₁⟩ = 0 on D_x: isotropic (Definition 2.1), if it claims to be Dirac
//   S3  D_x^⊥ ⊂ D_x: coisotropic
//   S4  membership is linear in (v, α, u)
//   S5  membership vanishes on D_x for some u, and for no u off D_x
//   S6  the ranks behind D_x are the same at every point: D is a smooth bundle
//   S7  the leading tangent_blocks() blocks of the residual are tangent vectors or covectors at x
// Open port-Hamiltonian structures are coisotropic only (Proposition 7.1): is_dirac() says what a
// structure claims. Signs: ω♭(u)(v) = ω(u, v); ⟨β, ♯α⟩ = Λ(β, α) (Example 2.2). Integrability
// (Remark 2.6) is not part of the definition.
//
// Immutable. To subclass: pass the sizes to the constructor and override do_membership; about 20
// lines.
class DiracStructure {
 public:
  virtual ~DiracStructure() = default;

  const std::string& name() const { return name_; }
  const std::shared_ptr<const Manifold>& manifold() const { return manifold_; }
  Index port_size() const { return port_size_; }            // m
  Index equation_count() const { return equation_count_; }  // r
  // Names of the port variables, for reports; default u[0] …
  const std::vector<std::string>& port_names() const { return port_names_; }

  // The claim: a Dirac structure, or (false) a subbundle that is only coisotropic.
  virtual bool is_dirac() const { return true; }
  // The claim: the graph of ω_Q, on M = T*Q.
  virtual bool is_canonical() const { return false; }
  // How many leading blocks of Ñ equations are tangent vectors or covectors at x by construction,
  // so that where n < Ñ only n combinations of a block say something. 0 is always right; more makes
  // what is built on the structure see no equations that repeat others.
  virtual Index tangent_blocks() const { return 0; }

  // The residual of the equations, size r. Throws std::invalid_argument on wrong sizes.
  ExprVector membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                        const ExprVector& u) const;

  // membership = F v + E α + P u at x, by its exact derivatives, in the orthonormal basis
  // B = tangent_basis(x) of T_xM: (w, a) ∈ Rⁿ ⊕ Rⁿ stands for v = B w and the α with a = Bᵀ α. A
  // tangent block s of the residual stands in it as Bᵀ s.
  struct Matrices {
    MatrixXd F, E, P;  // r × n, r × n, r × m
  };
  Matrices matrices(const VectorXd& x) const;
  // D_x in that basis. Throws std::domain_error where the membership is not a finite number.
  PairedSubspace fibre(const VectorXd& x) const;
  // The same as a Dirac structure: throws std::domain_error where it is not one.
  LinearDirac linear(const VectorXd& x) const { return LinearDirac(fibre(x)); }

  // How much rounding the entries of `matrices` may have, next to the largest of their row and
  // column.
  static constexpr RankOptions rounding{.data_error = 1e-12};

 protected:
  DiracStructure(std::string name, std::shared_ptr<const Manifold> manifold, Index port_size,
                 Index equation_count, std::vector<std::string> port_names = {});

 private:
  virtual ExprVector do_membership(const ExprVector& x, const ExprVector& v,
                                   const ExprVector& alpha, const ExprVector& u) const = 0;

  std::string name_;
  std::shared_ptr<const Manifold> manifold_;
  Index port_size_;
  Index equation_count_;
  std::vector<std::string> port_names_;
};

}  // namespace courant
