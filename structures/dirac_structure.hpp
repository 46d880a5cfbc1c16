// DiracStructure: D ⊂ TM ⊕ T*M.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/manifolds/manifold.hpp"

namespace courant {

// A vector subbundle D ⊂ TM ⊕ T*M, given at each x by equations that are linear in (v, α, u):
//
//   (v, α) ∈ D_x  ⟺  ∃ u ∈ R^m : membership(x, v, α, u) = 0
//
// v: tangent vector (Ñ), α: covector (Ñ), both in the representation of M; u: port variables or
// multipliers that the description needs (m).
//
// Laws, measured by check_structure:
//   S1  dim D_x = n                                             (Dirac: maximally isotropic,
//   Definition 2.1) S2  ⟨α₁, v₂⟩ + ⟨α₂, v₁⟩ = 0 on D_x                           (isotropy) S3
//   membership vanishes on D_x and does not off D_x; it is linear in (v, α, u)
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

  // The residual of the equations, size r. Throws std::invalid_argument on wrong sizes.
  ExprVector membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                        const ExprVector& u) const;

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
