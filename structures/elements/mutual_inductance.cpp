#include "courant/structures/elements/mutual_inductance.hpp"

#include <cmath>

#include "courant/core/linear/cholesky_decomposition.hpp"
#include "courant/core/linear/lu_decomposition.hpp"

namespace courant::elements {

MutualInductance::MutualInductance(const VectorXd& inductances)
    : root_(inductances.cwiseSqrt()),
      couplings_(MatrixXd::Identity(inductances.size(), inductances.size())) {}

Index MutualInductance::add(double inductance) {
  const Index i = count();
  root_.conservativeResize(i + 1);
  root_[i] = std::sqrt(inductance);
  couplings_.conservativeResize(i + 1, i + 1);
  couplings_.row(i).setZero();
  couplings_.col(i).setZero();
  couplings_(i, i) = 1.0;
  return i;
}

bool MutualInductance::add(Index i, Index j, double coupling) {
  const double whole = couplings_(i, j) + coupling;
  if (!(std::abs(whole) < 1.0)) return false;
  couplings_(i, j) = couplings_(j, i) = whole;
  return true;
}

bool MutualInductance::is_definite() const {
  constexpr double round_off = 1e-14;
  return couplings_.rows() == 0 || (CholeskyDecomposition(couplings_).is_positive_definite() &&
                                    LuDecomposition(couplings_).pivot_ratio() > round_off);
}

MatrixXd MutualInductance::inverse() const {
  const Index n = couplings_.rows();
  if (n == 0) return {};
  const MatrixXd half = CholeskyDecomposition(couplings_).solve_lower(MatrixXd::Identity(n, n)) *
                        root_.cwiseInverse().asDiagonal();
  return half.transpose() * half;
}

}  // namespace courant::elements
