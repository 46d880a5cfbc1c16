#include "courant/core/expressions/matrix_numbers.hpp"

#include <algorithm>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/subgraph.hpp"

namespace courant {

MatrixNumbers::MatrixNumbers(const ExprVector& F, const ExprVector& entries,
                             const std::vector<ExprVector>& groups) {
  if (!is_affine(F, groups[0])) return;
  std::vector<Index> places = contained_groups(entries, groups);
  if (!std::ranges::all_of(places, [&](Index g) { return groups[as_size(g)].size() == 1; })) return;
  kept_.resize(places.size());
  groups_ = std::move(places);
}

void MatrixNumbers::keep(const Inputs& in) {
  for (std::size_t k = 0; k < kept_.size(); ++k) kept_[k] = *in[(*groups_)[k]];
}

bool MatrixNumbers::agree(const Inputs& in) const {
  for (std::size_t k = 0; k < kept_.size(); ++k)
    if (*in[(*groups_)[k]] != kept_[k]) return false;
  return true;
}

}  // namespace courant
