// UncertainMatrix: a matrix with bounds of the errors of its entries.
#pragma once

#include <Eigen/SparseCore>

namespace courant {

using Eigen::Index;
using SparseMatrixXd = Eigen::SparseMatrix<double>;

// The m × n matrices A with |A - value| ≤ error, entry by entry. An entry that is not above its
// error must not be in `value` (nor a zero): it says nothing about the size of its row and column.
// Its error is in `error`.
struct UncertainMatrix {
  SparseMatrixXd value;
  SparseMatrixXd error;  // ≥ 0, m × n

  Index rows() const { return value.rows(); }
  Index cols() const { return value.cols(); }
  // Of the same matrices.
  UncertainMatrix block(Index row, Index column, Index rows, Index columns) const;
};

}  // namespace courant
