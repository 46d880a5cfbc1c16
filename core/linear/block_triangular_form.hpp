// The order in which equations can be solved, block by block.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "courant/core/linear/matching.hpp"

namespace courant {

// A square block on the diagonal: as many rows as columns.
struct DiagonalBlock {
  std::vector<Eigen::Index> rows, columns;
};

// The block triangular form of a square pattern of `size` rows: blocks, each row and column in one of them. The rows of
// a block have entries in its own columns and in those of earlier blocks alone, and no block can be divided so again.
// No value where no matrix of the pattern is regular. (The fine decomposition of Dulmage and Mendelsohn; A. Pothen, C.-J.
// Fan, ACM TOMS 16 (1990) 303.)
std::optional<std::vector<DiagonalBlock>> block_triangular_form(
    Eigen::Index size, std::span<const PatternEntry> entries);

}  // namespace courant
