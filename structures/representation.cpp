#include "courant/structures/representation.hpp"

#include <utility>

namespace courant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// ρ W + W ρᵀ for matrices with W_ji = sign W_ij, by their entries above the diagonal, or from it on.
Representation on_matrices(const Representation& rho, double sign) {
  Representation result;
  for (const MatrixXd& r : rho) {
    std::vector<std::pair<Index, Index>> places;
    for (Index i = 0; i < r.rows(); ++i)
      for (Index j = sign > 0.0 ? i : i + 1; j < r.rows(); ++j) places.emplace_back(i, j);
    MatrixXd action(std::ssize(places), std::ssize(places));
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto [i, j] = places[k];
      MatrixXd W = MatrixXd::Zero(r.rows(), r.rows());
      W(j, i) = sign;
      W(i, j) = 1.0;
      const MatrixXd moved = r * W + W * r.transpose();
      for (std::size_t l = 0; l < places.size(); ++l)
        action(static_cast<Index>(l), static_cast<Index>(k)) =
            moved(places[l].first, places[l].second);
    }
    result.push_back(std::move(action));
  }
  return result;
}

}  // namespace

Representation adjoint_representation(const LieAlgebra& g) {
  Representation result;
  for (Index i = 0; i < g.dimension(); ++i) {
    MatrixXd ad(g.dimension(), g.dimension());
    for (Index k = 0; k < g.dimension(); ++k)
      ad.row(k) = g.constants()[static_cast<std::size_t>(k)].row(i);
    result.push_back(std::move(ad));
  }
  return result;
}

Representation dual(const Representation& rho) {
  Representation result;
  for (const MatrixXd& r : rho) result.push_back(-r.transpose());
  return result;
}

Representation symmetric_square(const Representation& rho) { return on_matrices(rho, 1.0); }

Representation exterior_square(const Representation& rho) { return on_matrices(rho, -1.0); }

}  // namespace courant
