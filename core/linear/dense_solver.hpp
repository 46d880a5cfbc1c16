// DenseSolver: linear systems by a kept inverse, or by factors.
#pragma once

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/linear_solver.hpp"
#include "courant/core/linear/lu_decomposition.hpp"

namespace courant {

// For small systems that are solved many times with one matrix: the inverse is kept (of a matrix that is singular or
// not square the pseudo-inverse), and multiplied with in a loop whose length the compiler knows, for up to 8 unknowns.
// Where each matrix serves one or two right sides, the factors of a regular one are kept instead, a third of the work.
// Regular matrices of up to 63 rows are factorised and inverted without allocation. Whether a matrix is singular does
// not depend on the units of its rows and columns.
class DenseSolver final : public LinearSolver {
 public:
  enum class Keeps { inverse, factors };  // of a regular matrix
  explicit DenseSolver(const MatrixPattern& pattern, Keeps keeps = Keeps::inverse);

 private:
  bool do_factorize(const double* entries) override;
  void do_solve(const double* b, double* x) override;
  bool do_is_determined() const override { return determined_; }
  void do_settle(double* x, const double* x0) override;
  int do_orientation() const override { return orientation_; }
  double* do_inverse() override {
    return determined_ && !has_factors_ && A_.rows() == A_.cols() ? inverse_.data() : nullptr;
  }
  void equilibrate_by_powers();
  bool decompose(const MatrixXd& S, double least_ratio);
  void invert(const VectorXd& row, const VectorXd& column);
  void pseudo_invert(const Equilibration<MatrixXd>& S);

  MatrixPattern pattern_;
  const Keeps keeps_;
  MatrixXd A_;
  MatrixXd scaled_;        // diag(row) A diag(column)
  VectorXd row_, column_;  // powers of two
  VectorXd largest_;       // of each row
  LuDecomposition lu_;
  MatrixXd inverse_;
  MatrixXd open_;  // I - A⁺ A where A leaves unknowns open
  bool determined_ = false;
  bool has_factors_ = false;  // of diag(row) A diag(column), not the inverse of A
  int orientation_ = 0;
  void (*multiply_)(const MatrixXd& A, const double* b, double* x);  // made for the size
};

}  // namespace courant
