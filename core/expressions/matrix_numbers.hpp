// MatrixNumbers: whether the Jacobian of equations is the one that was made with earlier parameters.
#pragma once

#include <optional>
#include <vector>

#include "courant/core/expressions/inputs.hpp"

namespace courant {

// Equations F(y; p) = 0 are solved again and again, with other parameters p each time. This class tells whether their
// matrix ∂F/∂y is still the one that was made before, so that its factors can be used again.
//
// It knows this of equations that are affine in y and whose matrix contains no parameters but single numbers, such as
// the step h. These numbers are compared. A matrix that contains points or bases changes with each step, so nothing is
// kept of it.
class MatrixNumbers {
 public:
  MatrixNumbers() = default;  // nothing is known
  // `groups`: the unknowns y, then the groups of parameters. `entries`: those of ∂F/∂y.
  MatrixNumbers(const ExprVector& F, const ExprVector& entries,
                const std::vector<ExprVector>& groups);

  // Which of the groups the matrix contains, ascending. No value: the equations are not of that kind.
  const std::optional<std::vector<Index>>& groups() const { return groups_; }

  // Remembers the parameters with which the matrix is made now.
  void keep(const Inputs& in);
  // Whether the matrix would be the same with these parameters. False where that is not known.
  bool are_kept(const Inputs& in) const { return groups_ && agree(in); }

 private:
  bool agree(const Inputs& in) const;

  std::optional<std::vector<Index>> groups_;
  std::vector<double> kept_;
};

}  // namespace courant
