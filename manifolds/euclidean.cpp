#include "courant/manifolds/euclidean.hpp"

namespace courant {

Euclidean::Euclidean(Index dimension)
    : Manifold("Euclidean(" + std::to_string(dimension) + ")", dimension, dimension, dimension) {}

ExprMatrix Euclidean::do_frame(const ExprVector& x) const {
  return ExprMatrix::Identity(x.size(), x.size());
}

ExprMatrix Euclidean::do_coframe(const ExprVector& x) const {
  return ExprMatrix::Identity(x.size(), x.size());
}

}  // namespace courant
