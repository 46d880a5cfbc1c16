#include "courant/core/linear/range_basis.hpp"

#include <cmath>

#include "courant/core/linear/plain_products.hpp"

namespace courant {
namespace {

constexpr double kLeastEntry = 1e-15;

}  // namespace

Eigen::MatrixXd range_basis(Eigen::MatrixXd projector, Eigen::Index n) {
  const Eigen::Index m = projector.rows();
  Eigen::MatrixXd basis(m, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto [longest, square] = longest_column(projector.data(), m, projector.cols());
    // Of the two signs, that with a first number that is not positive, as reflections make it.
    const double length = projector(0, longest) > 0.0 ? -std::sqrt(square) : std::sqrt(square);
    double* const direction = basis.data() + k * m;
    for (Eigen::Index i = 0; i < m; ++i) direction[i] = projector(i, longest) / length;
    for (Eigen::Index j = 0; j < projector.cols(); ++j) {
      double* const column = projector.data() + j * m;
      const double part = plain_product(direction, column, m);
      for (Eigen::Index i = 0; i < m; ++i) column[i] -= part * direction[i];
    }
  }
  for (double& entry : basis.reshaped())
    if (std::fabs(entry) < kLeastEntry) entry = 0.0;
  return basis;
}

}  // namespace courant
