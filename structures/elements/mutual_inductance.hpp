// The energy of inductors that mutual inductances couple.
#pragma once

#include "courant/core/numbers/vectors.hpp"

namespace courant::elements {

// ½ φᵀ 𝓛⁻¹ φ, 𝓛_ii = L_i, 𝓛_ij = M_ij: of n inductors. Numbers are kept as couplings M_ij/√(L_i L_j), so that
// inductances may differ by powers of ten.
class MutualInductance {
 public:
  // L (n), in H, positive.
  explicit MutualInductance(const VectorXd& inductances = VectorXd());

  Index count() const { return root_.size(); }
  // One more, coupled to none. Returns its number.
  Index add(double inductance);

  // Adds a coupling between -1 and 1 of two different inductors; false, and nothing is done, where both together would
  // be coupled wholly or more.
  bool add(Index i, Index j, double coupling);
  // Whether 𝓛 is positive definite: each pair may be coupled so, and all together not.
  bool is_definite() const;
  // 𝓛⁻¹ (n × n), of a definite 𝓛.
  MatrixXd inverse() const;

 private:
  VectorXd root_;       // √L
  MatrixXd couplings_;  // with 1 on the diagonal
};

}  // namespace courant::elements
