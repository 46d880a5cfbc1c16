// Exponentials: what the exponentials in some equations are of.
#pragma once

#include <string>
#include <vector>

#include "courant/core/expressions/function.hpp"

namespace courant {

// The arguments of exp, sinh and cosh in the equations that change with some unknowns, each once.
ExprVector exponential_arguments(const ExprVector& equations, const ExprVector& unknowns);

// Equations F(y; p) = 0 that contain exp, sinh or cosh of arguments a(y; p), one entry each. With a number
// ā_k of its own in the place of every a_k, F is F̂(y, ā; p), and
//
//   L(y; p, ā) = F̂(y, ā; p) + ∂F̂/∂ā (a(y; p) - ā)
//
// is F with its exponentials linearised at ā. Where a and what else F consists of are linear, as in a
// circuit with diodes, L is linear. Arguments have no unit: a change of 1 is a large one. Immutable and
// cheap to copy.
class Exponentials {
 public:
  // None; or those of the equations, which the unknowns inputs[0] have a part in. Throws as Function.
  Exponentials() = default;
  Exponentials(const std::string& name, const std::vector<Function::Input>& inputs,
               const ExprVector& equations);

  Index count() const { return arguments_.output_size(); }
  const Function& arguments() const { return arguments_; }  // y; p ↦ a
  const Function& linearized() const { return linearized_; }  // y; p, ā ↦ L, with the Jacobian by y

  // ā ← where to linearise after an iteration that led to these arguments: there, but where an exponential
  // grows the argument grows by the logarithm of that alone, as L says how much F has to grow and not by
  // which argument. Source: L. W. Nagel, SPICE2, ERL-M520 (1975), PNJLIM; without its critical voltage.
  void move(VectorXd& held, const VectorXd& arguments) const;

 private:
  Function arguments_, linearized_;
  std::vector<bool> grows_both_ways_;  // of each argument: sinh or cosh is of it
};

}  // namespace courant
