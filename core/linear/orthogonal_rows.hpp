// OrthogonalRows: solutions of least norm, in 106 bits, of equations that may depend on each other.
#pragma once

#include <cstddef>
#include <vector>

#include "courant/core/numbers/double_double.hpp"

namespace courant {

// The rows of a matrix, made orthogonal one after the other (Gram and Schmidt, modified), the one with the largest
// entry first. Rows of which no entry exceeds `negligible` are dependent on the others: entries are to be about 1.
//
// Step by step of an iteration this divides by what double takes for round-off: by pivots down to some 10⁻²⁰ of the
// largest.
class OrthogonalRows {
 public:
  using Rows = std::vector<std::vector<DoubleDouble>>;

  // Rows of equal lengths, which may be 0.
  OrthogonalRows(Rows rows, double negligible);

  std::size_t rank() const { return pivots_.size(); }

  struct Solution {
    std::vector<DoubleDouble> x;  // of least norm that solves the independent rows
    double left = 0.0;            // the largest of what it leaves of the dependent ones
  };
  // `right`: one number for each row.
  Solution solve(std::vector<DoubleDouble> right) const;

 private:
  struct Pivot {
    std::size_t row;
    DoubleDouble square;  // its length, squared
    std::vector<DoubleDouble>
        factors;  // by row: how often it was taken from that; 0 from those that were pivots before
  };
  Rows rows_;
  std::vector<Pivot> pivots_;
  std::vector<bool> is_pivot_;  // by row
};

}  // namespace courant
