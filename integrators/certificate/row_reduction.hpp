// Row reduction of a sparse matrix that remembers what it did.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "courant/core/linear/uncertain_matrix.hpp"

namespace courant {

// A vector by its entries that are not zero, in the order of their indices.
using SparseEntries = std::vector<std::pair<Index, double>>;

// The reduction of A to echelon form, where columns are eliminated in the order of their group (0
// first), and within a group with rows of low level first: a row of level i is changed by rows of
// level ≤ i only.
//
//   row = multipliersᵀ A,    zero in all columns of lower groups and in the pivot columns of the
//   rows before it
//
// So the rows of level ≤ k are the reduction of these rows of A alone, and the rows whose pivot is
// in group g or later are a basis of the combinations of the rows of A that are free of all columns
// of groups < g: left null vectors of that part of A. Sparse rows are preferred as pivots
// (Markowitz), with an entry of at least a tenth of the largest that the row has in the group; or the
// largest entry of all that are clearly above their bounds, which fills in more and makes the least errors.
//
// Entries carry bounds of their errors through the elimination, and those within them count as zero;
// bounds beyond 10⁻⁶ of the largest number that went into a row say nothing. A should have comparable
// rows and columns, and this being elimination its ranks are less certain than a RankDecision.
// Compare with one.
class RowReduction {
 public:
  struct Row {
    Index level;
    Index pivot;  // column, or -1: the row is zero, its multipliers are a dependence among the rows
                  // of A
    SparseEntries entries;      // of the row, pivot included
    SparseEntries errors;       // bounds of theirs, and of entries that are zero within them
    SparseEntries multipliers;  // by row of A
  };

  enum class Pivots { sparse, largest };

  RowReduction(const UncertainMatrix& A, const std::vector<Index>& row_level,
               const std::vector<Index>& column_group, Pivots pivots = Pivots::sparse);

  // The rows with a pivot in this group, in the order in which they were found.
  const std::vector<Row>& group(Index g) const { return groups_[static_cast<std::size_t>(g)]; }
  const std::vector<Row>& zero_rows() const { return zero_rows_; }

  // The same rows with the pivot columns of the other rows of the group eliminated too, each with 1
  // in its pivot: reduced echelon form within the group. Without multipliers.
  const std::vector<Row>& reduced_group(Index g) const {
    return reduced_groups_[static_cast<std::size_t>(g)];
  }

 private:
  std::vector<std::vector<Row>> groups_, reduced_groups_;
  std::vector<Row> zero_rows_;
};

}  // namespace courant
