// ExponentialWatch: whether an iteration has settled what exponentials are of.
#pragma once

#include <vector>

#include "courant/core/expressions/inputs.hpp"
#include "courant/core/solve/exponentials.hpp"

namespace courant {

// For iterations by a matrix that is kept. Holds workspace: one object an iteration.
class ExponentialWatch {
 public:
  explicit ExponentialWatch(const Exponentials& exponentials);

  // The matrix is made at these unknowns.
  void keep(const Inputs& in);
  // Whether the last change, of the unknowns at these places, left the arguments of exponentials where they were, by
  // a matrix that was made near there: one of a point far up an exponential makes steps of any shortness.
  bool is_settled(const Inputs& in, const std::vector<Index>& places, const VectorXd& change);

 private:
  Function of_;  // y; p ↦ arguments
  VectorXd arguments_, before_,
      at_matrix_;  // at y, before the last change, where the matrix was made
  VectorXd y_;     // before the last change
};

}  // namespace courant
