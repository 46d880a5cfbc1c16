// SparseSolver: linear systems by a kept sparse factorisation.
#pragma once

#include <memory>
#include <vector>

#include "courant/core/linear/dense_solver.hpp"
#include "courant/core/linear/linear_solver.hpp"
#include "courant/core/linear/sparse_lu.hpp"

namespace courant {

// For large systems whose equations contain few unknowns each: networks, chains, grids. Time and memory
// grow with the entries of the factors, which for chains and trees are as many as those of the matrix.
// A matrix that is singular or not square is left to DenseSolver. What is singular is judged as there,
// in units in which the entries are comparable.
class SparseSolver final : public LinearSolver {
 public:
  explicit SparseSolver(const MatrixPattern& pattern);
  ~SparseSolver() override;

 private:
  bool do_factorize(const double* entries) override;
  void do_forget() override {
    if (lu_) lu_->forget();
  }
  void do_solve(const double* b, double* x) override;
  bool do_is_determined() const override {
    return is_sparse_ || (dense_ && dense_->is_determined());
  }
  void do_settle(double* x, const double* x0) override;
  int do_orientation() const override;
  bool is_regular(double least_ratio);

  MatrixPattern pattern_;
  SparseMatrixXd A_;                   // (m × n)
  SparseMatrixXd scaled_;              // diag(r) A diag(c), with the pattern of A
  std::vector<Index> place_;           // among the entries of A, of each entry of the pattern
  VectorXd row_scale_, column_scale_;  // r (m), c (n)
  VectorXd largest_;
  std::unique_ptr<SparseLu> lu_;  // of square matrices
  std::unique_ptr<DenseSolver> dense_;
  bool is_sparse_ = false;  // the last matrix is solved with lu_
  bool has_units_ = false;  // other than 1, of rows or columns
};

}  // namespace courant
