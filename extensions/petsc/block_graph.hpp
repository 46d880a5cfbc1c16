// BlockGraph: what is divided among processes, and what of it reads what.
#pragma once

#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/linear/matching.hpp"

namespace courant {

// The unknowns of a square system, each with the equation that it is matched with, in blocks: unknowns that the same
// equations contain stay together, up to twelve, as the three coordinates of a body do that forces act on. Two blocks
// are neighbours where an equation of one contains an unknown of the other.
//
// An equation of many unknowns, as one that contains an energy of all of them, makes no neighbours: all processes
// read these whatever the partition.
struct BlockGraph {
  // `pattern`: which equation contains which unknown, rows ascending. Throws std::invalid_argument, with `name`, for
  // a system that has not as many equations as unknowns that they contain, or whose matrix is singular for all numbers.
  BlockGraph(const std::string& name, Index equations, const std::vector<PatternEntry>& pattern);

  std::vector<Index> contained;  // unknowns that the equations contain, ascending
  std::vector<Index> equation;   // of each of these, that which it is matched with
  std::vector<Index> block;      // of each of these
  std::vector<Index> weights;    // of each block, how many unknowns it has
  // Neighbours of block b: neighbours[begins[b]] up to neighbours[begins[b + 1]], without b.
  std::vector<Index> begins, neighbours;
};

}  // namespace courant
