// EquationSystem: equations that a solver meets again and again, without the unknowns that they give
// explicitly.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/core/algebra/elimination.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/solve/equation_engine.hpp"
#include "courant/core/solve/exponentials.hpp"

namespace courant {

// F(y; p) = 0 for y, compiled as G(u; p) = 0 and y = Y(u; p), see Elimination. Immutable and cheap to
// copy.
class EquationSystem {
 public:
  struct Options {
    Backend backend = Backend::interpreter;
    bool eliminates = true;
    Elimination::Options elimination = {};
    std::shared_ptr<const EquationEngine> engine = nullptr;  // that is to solve them
  };

  EquationSystem() = default;
  // `inputs`: y first, then the groups of p. Throws as Function and Elimination do.
  EquationSystem(const std::string& name, const std::vector<Function::Input>& inputs,
                 const ExprVector& equations, const Options& options);
  // All unknowns are kept. Throws std::invalid_argument if the Jacobian is not by group 0.
  EquationSystem(Function equations);  // NOLINT: a function is a system of equations

  const std::string& name() const { return name_; }
  Index size() const { return size_; }  // of y
  bool is_native() const { return by_engine_ ? by_engine_->is_native() : left_.is_native(); }
  bool is_reduced() const { return !pivots_.empty(); }

  // u; p ↦ G, with the Jacobian by u; what p alone determines can be held. Empty where an engine has them.
  const Function& left() const { return left_; }
  // G = 0 in the hands of an engine, or null.
  const std::shared_ptr<const EngineEquations>& by_engine() const { return by_engine_; }
  // u; p ↦ y, all of it; nothing unless is_reduced().
  const Function& unknowns() const { return unknowns_; }
  // Those of G; none of a system that was made of a function.
  const Exponentials& exponentials() const { return exponentials_; }
  const std::vector<Index>& kept() const { return kept_; }
  // How, in the order of elimination.
  const std::vector<Elimination::Pivot>& pivots() const { return pivots_; }

 private:
  std::string name_;
  Index size_ = 0;
  Function left_, unknowns_;
  std::shared_ptr<const EngineEquations> by_engine_;
  Exponentials exponentials_;
  std::vector<Index> kept_;
  std::vector<Elimination::Pivot> pivots_;
};

}  // namespace courant
