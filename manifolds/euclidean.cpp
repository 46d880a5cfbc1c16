#include "courant/manifolds/euclidean.hpp"

#include <numeric>

namespace courant {

Euclidean::Euclidean(Index dimension)
    : Manifold("Euclidean(" + std::to_string(dimension) + ")", dimension, dimension, dimension) {}

ExprMatrix Euclidean::do_frame(const ExprVector& x) const {
  return ExprMatrix::Identity(x.size(), x.size());
}

ExprMatrix Euclidean::do_coframe(const ExprVector& x) const {
  return ExprMatrix::Identity(x.size(), x.size());
}

Manifold::ScalingSymmetries Euclidean::do_scaling_symmetries() const {
  std::vector<Index> each(static_cast<std::size_t>(dimension()));
  std::iota(each.begin(), each.end(), Index{0});
  return {.point = each, .tangent = each, .fibre = each};
}

}  // namespace courant
