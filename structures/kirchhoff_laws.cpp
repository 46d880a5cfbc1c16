#include "courant/structures/kirchhoff_laws.hpp"

#include <cmath>

#include "courant/core/numbers/as_size.hpp"

namespace courant {
namespace {

// [A₁ B₂]: columns of A and then of B, by their numbers.
SparseMatrixXd columns(const SparseMatrixXd& A, const std::vector<Index>& of_A,
                       const SparseMatrixXd& B, const std::vector<Index>& of_B) {
  SparseMatrixXd result(A.rows(), static_cast<Index>(of_A.size() + of_B.size()));
  Index column = 0;
  const auto append = [&](const SparseMatrixXd& matrix, const std::vector<Index>& indices) {
    for (const Index j : indices) {
      result.startVec(column);
      for (SparseMatrixXd::InnerIterator it(matrix, j); it; ++it)
        result.insertBack(it.row(), column) = it.value();
      ++column;
    }
  };
  append(A, of_A);
  append(B, of_B);
  result.finalize();
  return result;
}

// Takes a row with a single entry and the column of that entry away, again and again. Returns the
// number of columns that remain: 0 if and only if the matrix is triangular up to permutations,
// hence regular if square.
Index columns_after_peeling(const SparseMatrixXd& matrix) {
  const SparseMatrixXd by_row = matrix.transpose();
  std::vector<Index> entries(as_size(matrix.rows()), 0);
  std::vector<bool> taken(as_size(matrix.cols()), false);
  std::vector<Index> single;
  for (Index row = 0; row < matrix.rows(); ++row) {
    entries[as_size(row)] = by_row.col(row).nonZeros();
    if (entries[as_size(row)] == 1) single.push_back(row);
  }
  Index remaining = matrix.cols();
  while (!single.empty()) {
    const Index row = single.back();
    single.pop_back();
    for (SparseMatrixXd::InnerIterator pivot(by_row, row); pivot; ++pivot) {
      if (taken[as_size(pivot.row())]) continue;
      taken[as_size(pivot.row())] = true;
      --remaining;
      for (SparseMatrixXd::InnerIterator it(matrix, pivot.row()); it; ++it) {
        if (--entries[as_size(it.row())] == 1) single.push_back(it.row());
      }
    }
  }
  return remaining;
}

}  // namespace

double largest_entry(const SparseMatrixXd& matrix) {
  double result = 0.0;
  for (Index j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(matrix, j); it; ++it)
      result = std::max(result, std::abs(it.value()));
  return result;
}

std::vector<LawResult> check_sparse_dirac(const std::string& subject,
                                          const KernelRepresentation<SparseMatrixXd>& kernel,
                                          const HybridRepresentation<SparseMatrixXd>& hybrid) {
  const auto& [F, E] = kernel;
  const auto& [effort_driven, flow_driven, M] = hybrid;
  const auto law = [&](const std::string& name, double defect) {
    return LawResult{subject, name, defect, 0.0, ""};
  };
  const SparseMatrixXd product = F * E.transpose();
  const SparseMatrixXd outputs = columns(F, effort_driven, E, flow_driven);
  const SparseMatrixXd inputs = columns(E, effort_driven, F, flow_driven);
  const bool square = outputs.rows() == outputs.cols();
  const auto remaining =
      static_cast<double>(square ? columns_after_peeling(outputs) : outputs.cols());
  return {law("K1 F Eᵀ + E Fᵀ = 0", largest_entry(product + SparseMatrixXd(product.transpose()))),
          law("K2 rank [F E] = n", remaining),
          law("K3 M + Mᵀ = 0", largest_entry(M + SparseMatrixXd(M.transpose()))),
          law("K4 (f₁, e₂) = M (e₁, f₂) lies in D",
              largest_entry(SparseMatrixXd(outputs * M) + inputs))};
}

std::vector<LawResult> check_kirchhoff(const Kirchhoff& structure) {
  return check_sparse_dirac("Kirchhoff(" + std::to_string(structure.node_count()) + " nodes, " +
                                std::to_string(structure.element_count()) + " elements)",
                            structure.kernel_representation(), structure.hybrid_representation());
}

}  // namespace courant
