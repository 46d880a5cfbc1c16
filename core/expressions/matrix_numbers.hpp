// MatrixNumbers: what the matrix of affine equations is made of.
#pragma once

#include <optional>
#include <vector>

#include "courant/core/expressions/inputs.hpp"

namespace courant {

// Whether equations F(y; p) = 0, solved again with other parameters, have the matrix ∂F/∂y that they had. It is known of
// equations that are affine in y and whose matrix is made of parameters that are one number each, as h is: these are
// compared. Points and bases change with each step.
class MatrixNumbers {
 public:
  MatrixNumbers() = default;  // nothing is known
  // groups: y, then those of p. entries: those of ∂F/∂y.
  MatrixNumbers(const ExprVector& F, const ExprVector& entries,
                const std::vector<ExprVector>& groups);

  // The places of these groups, ascending; without a value: nothing is known.
  const std::optional<std::vector<Index>>& groups() const { return groups_; }

  // The matrix is made with these parameters.
  void keep(const Inputs& in);
  // Whether it would be the same with these. False where nothing is known.
  bool are_kept(const Inputs& in) const { return groups_ && agree(in); }

 private:
  bool agree(const Inputs& in) const;

  std::optional<std::vector<Index>> groups_;
  std::vector<double> kept_;
};

}  // namespace courant
