// BranchSystem: a part of an implicit system, by more equations.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/structures/implicit_system.hpp"

namespace courant {

// A branch of S, where its equations, or what follows from them, have a product f g = 0 among them: the closure of
// S ∩ {f = 0, g ≠ 0}.
//
//   left out    equations of S that vanish with f: x y = 0 has the branch x = 0, and no equation twice
//   rewritten   those in which a multiplier λ stands with the other factor g where f = 0: the unknown is λ g there, so
//               that the force λ d(f g) = (λ g) df does not vanish where branches meet
//
// Names and energy stay; the equations f = 0 come last. Whether a branch is Lagrangian is not known.
class BranchSystem final : public ImplicitSystem {
 public:
  // Expressions of variables.
  struct Equations {
    ExprVector functions;  // f
    ExprVector x, v, z;    // variables (N, Ñ, m)
    Expr t;
    std::vector<std::string> names;    // of the f
    std::vector<Index> left_out = {};  // of the equations of the whole
    std::vector<std::pair<Index, Expr>> rewritten =
        {};  // those of the whole that have these in their place
  };
  // Throws std::invalid_argument on wrong sizes, and where an equation that is left out is not there or is a component
  // of a tangent vector or a covector.
  BranchSystem(std::shared_ptr<const ImplicitSystem> whole, Equations equations);

  const std::shared_ptr<const ImplicitSystem>& whole() const { return whole_; }

  Index tangent_blocks() const override { return whole_->tangent_blocks(); }

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override;
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override;
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override;

  std::shared_ptr<const ImplicitSystem> whole_;
  Equations equations_;
  std::vector<Index> kept_;  // of the equations of the whole
  ExprVector own_;           // those that are rewritten, then the f
  ExprVector variables_;
};

}  // namespace courant
