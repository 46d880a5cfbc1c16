// A E = Q [R W; 0 δ] of a sparse matrix. Not installed API: RankDecision is.
#pragma once

#include <Eigen/SparseCore>

namespace courant {

// The upper trapezoidal factor of a sparse A (m × n) with its columns permuted, that is cut where a
// column is left with at most `tolerance`: R (r × r, triangular), W (r × (n-r)), and the Frobenius
// norm ‖δ‖ of what was dropped.
struct SparseQr {
  Eigen::SparseMatrix<double> R, W;
  double dropped = 0.0;
};

// Written twice: by SuiteSparseQR, which is multifrontal, and GPL; and by Eigen's SparseQR, which
// is slower and MPL. The option COURANT_WITH_SUITESPARSE chooses, and the tests are the same.
// Throws std::runtime_error if the factorisation fails.
SparseQr sparse_qr(const Eigen::SparseMatrix<double>& A, double tolerance);

}  // namespace courant
