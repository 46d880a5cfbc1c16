#include "courant/integrators/methods/staggering.hpp"

#include <vector>

#include "courant/core/expressions/derivative.hpp"

namespace courant {

std::optional<VectorXd> staggering(const VectorFieldFormulas& field) {
  const Manifold& M = *field.system->manifold();
  const Index n = M.dimension();
  if (!field.is_explicit() || !M.has_identity_frame()) return std::nullopt;
  const SparseExprMatrix slopes =
      jacobian(ExprVector(field.rate.head(n)), field.inputs[1].variables);
  std::vector<std::vector<Index>> coupled(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < slopes.row.size(); ++k) {
    coupled[static_cast<std::size_t>(slopes.row[k])].push_back(slopes.col[k]);
    coupled[static_cast<std::size_t>(slopes.col[k])].push_back(slopes.row[k]);
  }
  constexpr double unknown = -1.0;
  VectorXd classes = VectorXd::Constant(n, unknown);
  for (Index first = 0; first < n; ++first) {
    if (classes[first] != unknown) continue;
    classes[first] = 0.0;
    std::vector<Index> reached = {first};
    while (!reached.empty()) {
      const Index i = reached.back();
      reached.pop_back();
      for (const Index j : coupled[static_cast<std::size_t>(i)]) {
        if (classes[j] == classes[i]) return std::nullopt;
        if (classes[j] != unknown) continue;
        classes[j] = 1.0 - classes[i];
        reached.push_back(j);
      }
    }
  }
  return classes;
}

}  // namespace courant
