// Some of the unknowns of a function: those that it contains, and where groups of them end.
#pragma once

#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/linear_solver.hpp"

namespace courant {

// The unknowns that a function contains, and the pattern of its Jacobian by those alone.
struct ContainedUnknowns {
  explicit ContainedUnknowns(const Function& function);

  std::vector<Index> places;  // ascending
  MatrixPattern pattern;
};

// For consecutive groups of these sizes, how many of the ascending places lie before the end of each.
std::vector<Index> group_ends(const std::vector<Index>& sizes, const std::vector<Index>& places);

}  // namespace courant
