// ImplicitSystem: an implicit differential equation, S ⊂ TM.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/manifolds/manifold.hpp"

namespace courant {

class DiracStructure;

// S = {(x, v) ∈ TM : ∃ z ∈ R^m, F(x, v, z, t) = 0}: a system of r equations on a manifold M
// (Section 3 of the paper).
//
// x is a point (size N), v a tangent vector at x (size Ñ, the representation of M), z auxiliary
// unknowns without derivative: multipliers, port variables, velocities of a Morse family (size m).
// r may be smaller, equal or larger than n + m, and equations may repeat each other: what the
// system determines is for the constraint algorithm to find out. Time may appear explicitly.
//
// Equations and unknowns have names, so that findings can be reported in the words of whoever wrote
// the system. Immutable. To subclass: pass manifold and sizes to the constructor and override
// do_residual.
class ImplicitSystem {
 public:
  struct Names {
    std::vector<std::string> coordinates = {};  // N; default x[0] …
    std::vector<std::string> auxiliary = {};    // m; default z[0] …
    std::vector<std::string> equations = {};    // r; default equation[0] …

    // The coordinate that is the momentum of this one by its name, p_x of x. Nothing where there is none.
    std::optional<Index> momentum_of(Index coordinate) const;
  };

  virtual ~ImplicitSystem() = default;

  const std::shared_ptr<const Manifold>& manifold() const { return manifold_; }
  Index auxiliary_size() const { return auxiliary_size_; }  // m
  Index equation_count() const { return equation_count_; }  // r
  const Names& names() const { return names_; }

  // How many leading blocks of Ñ equations are tangent vectors or covectors at x, as in
  // DiracStructure.
  virtual Index tangent_blocks() const { return 0; }

  // D, where the system is S = {v : (v, α) ∈ D, α ∈ 𝓛}; null where none is known.
  virtual std::shared_ptr<const DiracStructure> structure() const { return nullptr; }
  // The claim: on M = T*Q, S is a Lagrangian submanifold of (TT*Q, d_Tω_Q), at any time: what
  // Hamiltonian and Lagrangian systems are, and what a symplectic map makes symplectic steps of. No
  // value: unknown.
  virtual std::optional<bool> is_lagrangian() const { return std::nullopt; }

  // F(x, v, z, t), size r; x: N, v: Ñ, z: m. Throws std::invalid_argument on wrong sizes.
  ExprVector residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                      const Expr& t) const;
  VectorXd residual(const VectorXd& x, const VectorXd& v, const VectorXd& z, double t) const;

  // Where to start a search for the z that goes with (x, v): what is known of it without solving
  // anything, 0 for the rest. v may be empty: unknown. Size m.
  VectorXd auxiliary_guess(const VectorXd& x, const VectorXd& v) const;

  // The energy at (x, z, t), for systems that have one.
  std::optional<Expr> energy(const ExprVector& x, const ExprVector& z, const Expr& t) const {
    return do_energy(x, z, t);
  }

 protected:
  // Empty lists of names get the defaults; wrong sizes throw std::invalid_argument.
  ImplicitSystem(std::shared_ptr<const Manifold> manifold, Index auxiliary_size,
                 Index equation_count, Names names);

 private:
  virtual ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                 const Expr& t) const = 0;
  virtual std::optional<Expr> do_energy(const ExprVector&, const ExprVector&, const Expr&) const {
    return std::nullopt;
  }
  // May override, where z repeats something of v: v has size Ñ. The default is 0.
  virtual VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const;

  std::shared_ptr<const Manifold> manifold_;
  Index auxiliary_size_;
  Index equation_count_;
  Names names_;
};

}  // namespace courant
