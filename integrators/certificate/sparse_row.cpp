#include "courant/integrators/certificate/sparse_row.hpp"

#include <algorithm>

namespace courant {

void SparseRow::append(Index column, Digits value) {
  if (!value.settle().is_zero()) entries_.push_back({column, value});
}

const Digits& SparseRow::operator[](Index column) const {
  static const Digits zero;
  const auto found = std::lower_bound(entries_.begin(), entries_.end(), column,
                                      [](const Entry& entry, Index j) { return entry.column < j; });
  return found != entries_.end() && found->column == column ? found->value : zero;
}

void SparseRow::eliminate(Index column, const Digits& factor, const SparseRow& pivot,
                          std::vector<Index>& filled) {
  std::vector<Entry> result;
  result.reserve(entries_.size() + pivot.size());
  auto own = entries_.begin();
  for (const Entry& other : pivot.entries_) {
    for (; own != entries_.end() && own->column < other.column; ++own) result.push_back(*own);
    const bool is_there = own != entries_.end() && own->column == other.column;
    if (other.column == column) {
      if (is_there) ++own;
      continue;
    }
    Entry entry = is_there ? *own++ : Entry{other.column, Digits()};
    subtract_multiple(&entry.value, factor, &other.value, 1);
    if (entry.value.is_zero()) continue;
    if (!is_there) filled.push_back(other.column);
    result.push_back(entry);
  }
  result.insert(result.end(), own, entries_.end());
  entries_ = std::move(result);
}

}  // namespace courant
