// SparseRow: a row of a matrix in the digits of a decision.
#pragma once

#include <vector>

#include "courant/core/numbers/digits.hpp"
#include "courant/core/numbers/vectors.hpp"

namespace courant {

// The entries of a row that are not zero, by column. What shrinks is zero, and goes.
class SparseRow {
 public:
  struct Entry {
    Index column;
    Digits value;
  };

  // An entry after all others; nothing if it shrinks.
  void append(Index column, Digits value);
  // The entry of a column, 0 where there is none.
  const Digits& operator[](Index column) const;

  // *this - factor · pivot, with 0 in a column that is known to cancel. The columns that had no entry and have one now
  // are appended to `filled`.
  void eliminate(Index column, const Digits& factor, const SparseRow& pivot,
                 std::vector<Index>& filled);

  auto begin() const { return entries_.begin(); }
  auto end() const { return entries_.end(); }
  std::size_t size() const { return entries_.size(); }
  bool empty() const { return entries_.empty(); }

 private:
  std::vector<Entry> entries_;  // columns increase
};

}  // namespace courant
