// Powers of two that make the rows and the columns of a matrix alike.
#pragma once

#include <cstdint>
#include <vector>

#include "courant/integrators/certificate/jet_equations.hpp"

namespace courant {

// Exponents e_i, f_j so that 2^(e_i + f_j) a_ij are about 1: they choose pivots and the directions of a search, and
// decide nothing.
//
// Columns first. An unknown that does not vanish has its own size; one that vanishes has the change that makes as
// much of some row as the largest term of the others makes of it. Then each row by its largest entry.
struct BinaryScales {
  std::vector<std::int64_t> row, column;
  std::vector<bool> is_known;  // columns: whether something said a size

  BinaryScales(const JetEquations& equations, Index k)
      : row(static_cast<std::size_t>(equations.row_count(k)), 0),
        column(static_cast<std::size_t>(equations.unknown_count(k) + 1), 0),
        is_known(column.size(), false) {}

  // Sizes of the columns that have none, from a jet and the entries of the Jacobian there; rows anew. Those of a
  // search stay from where it began, so that round-off that it leaves in an unknown is no size.
  void update(const std::vector<JetEquations::Entry>& places, const std::vector<Digits>& entries,
              const Jet& jet);
  // Rows anew by their largest entry in the columns that are not held: those that a step may change.
  void scale_rows(const std::vector<JetEquations::Entry>& places,
                  const std::vector<Digits>& entries, const std::vector<bool>& is_held);
  // Columns and rows from the entries alone.
  void update(const std::vector<JetEquations::Entry>& places, const std::vector<Digits>& entries);
};

// The unknowns of a jet that are not zero, and below 2⁻⁵⁰ of other terms in every equation in which they stand, or of 1 in
// what a sine or another function of numbers is of: what is left of a zero that was typed or computed as a double.
std::vector<Index> rounded_unknowns(const JetEquations& equations, const Jet& jet);

}  // namespace courant
