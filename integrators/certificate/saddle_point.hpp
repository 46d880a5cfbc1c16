// Quadratic functions and linear constraints at once.
#pragma once

#include <Eigen/SparseCholesky>
#include <optional>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/lu_decomposition.hpp"

namespace courant {

// Whether dense factorisations of a matrix of this size are cheaper than sparse ones.
bool is_factored_dense(const SparseMatrixXd& S);

// diag(d), all entries stored.
SparseMatrixXd sparse_diagonal(const VectorXd& d);

// The solution of [P Sᵀ; S -γ] (δ, y) = (a, b), with P ⪰ 0 diagonally strengthened to be definite:
// quasi-definite, so that LDLᵀ exists for every ordering. Entries far below those of S cost digits,
// which two steps of refinement bring back.
class SaddlePoint {
 public:
  SaddlePoint(const SparseMatrixXd& P, const SparseMatrixXd& S, double gamma);

  Index columns() const { return columns_; }

  // δ; empty if the factorisation broke down.
  VectorXd solve(const VectorXd& a, const VectorXd& b) const;

 private:
  Index columns_;
  SparseMatrixXd matrix_;
  Eigen::SimplicialLDLT<SparseMatrixXd, Eigen::Lower> factors_;
  std::optional<LuDecomposition> pivoted_;
};

}  // namespace courant
