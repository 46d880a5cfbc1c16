// A largest matching of the rows and columns of a pattern.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace courant {

// A place of a matrix that is not identically zero.
struct PatternEntry {
  Eigen::Index row, column;
};

// Of each row the column that it is matched with, -1 if with none. Rows and columns are matched where the
// pattern has an entry, each at most once, and as many as can be.
std::vector<Eigen::Index> largest_matching(Eigen::Index rows, Eigen::Index columns,
                                           std::span<const PatternEntry> entries);

}  // namespace courant
