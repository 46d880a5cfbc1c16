// ConstraintAlgorithm: the sets S_f over M_f of an implicit system, as a certificate.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/certificate/initial_guess.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

class ChartEquations;

using SparseMatrixXd = Eigen::SparseMatrix<double>;

// Near the point, by derivative arrays (DESIGN, section 5):
//
//   S_k = π_{TM} {F^[k] = 0},  M_k = π_M {F^[k] = 0},   until both repeat
//
//   1. A consistent point of F^[k] = 0 for k = 0, 1, …: x itself if there are v, z, … that go with
//   it, else the one that moves x least.
//   2. dim S_k, dim M_k there from the ranks of the Jacobian of F^[k] with and without the columns
//   of (x, v), of x.
//   3. The first k with the dimensions of k+1. A comparison with consistent points nearby tells
//   singular points.
//
// Valid where the ranks are constant around the point (docs/constraint-algorithm.md). Scales of
// equations and unknowns, and their order, do not matter.
class ConstraintAlgorithm {
 public:
  struct Options {
    Index max_level = 12;
    // The metric in which x moves least: N × N, positive semidefinite; empty for the Euclidean one.
    // A zero diagonal entry means that the value was not given.
    SparseMatrixXd metric = SparseMatrixXd();
  };

  ConstraintAlgorithm() = default;
  explicit ConstraintAlgorithm(Options options) : options_(std::move(options)) {}

  // Throws std::invalid_argument on wrong sizes.
  ConstraintLadder run(const std::shared_ptr<const ImplicitSystem>& system,
                       const InitialGuess& guess) const;
  // The same of equations that are traced already, for who asks about several points.
  ConstraintLadder run(const std::shared_ptr<const ChartEquations>& equations,
                       const InitialGuess& guess) const;

 private:
  Options options_;
};

}  // namespace courant
