// Orderings of long, thin matrices that begin at both ends. Not installed API: SparseSolver is.
#pragma once

#include <span>
#include <vector>

namespace courant {

// The order in which the unknowns of a sparse matrix (n × n) are eliminated, where its graph is long and thin, as that
// of a chain, a ladder or a ring:
//
//   a line of 7:   0 6 1 5 2 4 3
//
// The graph is cut in its middle, at a few nodes that come last; each half is ordered for little fill (constrained
// minimum degree, CAMD), and the two take turns. So what is eliminated, and solved for, seldom waits for what was just
// before: a solution with the factors of a chain of 10⁴ unknowns takes half the time that it takes from one end to the
// other, with as much fill.
//
// `offsets` (n + 1) and `rows` are those of the columns, as in compressed matrices; the pattern of A + Aᵀ counts. Empty
// where the graph is in several parts, or as wide as it is long: other orderings have independent parts enough.
std::vector<int> two_ended_ordering(std::span<const int> offsets, std::span<const int> rows);

}  // namespace courant
