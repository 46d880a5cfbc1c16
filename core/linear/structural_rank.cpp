#include "courant/core/linear/structural_rank.hpp"

#include <algorithm>
#include <vector>

#include "courant/core/linear/matching.hpp"

namespace courant {

Index structural_rank(const SparseMatrixXd& A) {
  std::vector<PatternEntry> entries;
  for (Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(A, j); it; ++it)
      if (it.value() != 0.0) entries.push_back({it.row(), j});
  const std::vector<Index> column_of = largest_matching(A.rows(), A.cols(), entries);
  return A.rows() - std::ranges::count(column_of, Index(-1));
}

}  // namespace courant
