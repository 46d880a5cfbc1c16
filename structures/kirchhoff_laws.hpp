// Laws of sparse Dirac structures, by nothing but sparse products and counting.
#pragma once

#include <string>
#include <vector>

#include "courant/manifolds/law_result.hpp"
#include "courant/structures/kirchhoff.hpp"

namespace courant {

// The largest absolute value of an entry; 0 of a matrix without any.
double largest_entry(const SparseMatrixXd& matrix);

// Whether D = {(f, e) : F f + E e = 0} is a Dirac structure, and has this hybrid representation:
//
//   K1  F Eᵀ + E Fᵀ = 0
//   K2  [F E] has rank n: its columns F₁, E₂ of the outputs of the hybrid representation are a
//       square matrix that permutations of rows and columns make triangular. The defect is the
//       number of columns left when no row has a single entry any more.
//   K3  M + Mᵀ = 0
//   K4  (f₁, e₂) = M (e₁, f₂) lies in D for all (e₁, f₂)
//
// Defects of K1, K3, K4 are the largest entries. The numbers of Kirchhoff's matrices are ±1, so all
// bounds are 0: no rounding, no tolerance.
std::vector<LawResult> check_sparse_dirac(const std::string& subject,
                                          const KernelRepresentation<SparseMatrixXd>& kernel,
                                          const HybridRepresentation<SparseMatrixXd>& hybrid);

std::vector<LawResult> check_kirchhoff(const Kirchhoff& structure);

}  // namespace courant
