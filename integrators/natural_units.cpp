#include "courant/integrators/natural_units.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "courant/core/complete_orthogonal_decomposition.hpp"
#include "courant/integrators/ladder/derivative_array.hpp"
#include "courant/integrators/ladder/natural_scaling.hpp"

namespace courant {
namespace {

// A number for each of the Ñ entries: the same for entries that the projector mixes somewhere.
std::vector<Index> blocks(const Manifold& M) {
  std::vector<Index> block(static_cast<std::size_t>(M.tangent_dimension()));
  std::iota(block.begin(), block.end(), Index{0});
  if (M.dimension() == M.tangent_dimension()) return block;
  std::mt19937 generator(1);
  const MatrixXd projector = M.tangent_projector(M.random_point(generator));
  for (Index i = 0; i < projector.rows(); ++i)
    for (Index j = 0; j < i; ++j) {
      if (std::abs(projector(i, j)) < 1e-12) continue;
      const Index from = block[static_cast<std::size_t>(i)],
                  to = block[static_cast<std::size_t>(j)];
      for (Index& b : block)
        if (b == from) b = to;
    }
  return block;
}

// Beyond so many rows and columns scales are powers of two: the linear system would take long.
constexpr Index kExact = 500;
// Sizes below this, in the scales of least squares, are round-off of zeros: no units.
constexpr double kLeast = 1e-10;

// The scales c of the columns that minimise Σ (log r_i + log |a_ij| + log c_j)² over the entries,
// near scales that do so up to powers of two; entries that are noise in those are left out. In each
// connected component the largest size |y_j| / c_j is 1: that is what the minimum leaves open.
VectorXd column_scales(const SparseMatrixXd& magnitude, const VectorXd& row_scale,
                       const VectorXd& column_scale, const VectorXd& reach) {
  const Index m = magnitude.rows(), n = magnitude.cols();
  MatrixXd A = MatrixXd::Zero(m + n, m + n);
  VectorXd b = VectorXd::Zero(m + n);
  std::vector<Index> component(static_cast<std::size_t>(m + n));
  std::iota(component.begin(), component.end(), Index{0});
  for (Index j = 0; j < n; ++j)
    for (SparseMatrixXd::InnerIterator it(magnitude, j); it; ++it) {
      const Index i = it.row();
      const double size = row_scale[i] * it.value() * column_scale[j];
      if (size < 1e-9) continue;
      const double logarithm = std::log(size);
      A(i, i) += 1.0, A(m + j, m + j) += 1.0, A(i, m + j) += 1.0, A(m + j, i) += 1.0;
      b[i] -= logarithm, b[m + j] -= logarithm;
      const Index from = component[static_cast<std::size_t>(i)];
      for (Index& c : component)
        if (c == from) c = component[static_cast<std::size_t>(m + j)];
    }
  const VectorXd logarithms = CompleteOrthogonalDecomposition(A, 1e-13).solve(b);
  VectorXd result = column_scale.cwiseProduct(logarithms.tail(n).array().exp().matrix());
  VectorXd largest = VectorXd::Zero(m + n);
  const auto size_of = [&](Index j) -> double& {
    return largest[component[static_cast<std::size_t>(m + j)]];
  };
  for (Index j = 0; j < n; ++j) size_of(j) = std::max(size_of(j), reach[j] / result[j]);
  for (Index j = 0; j < n; ++j)
    if (size_of(j) > kLeast) result[j] *= size_of(j);
  return result;
}

}  // namespace

VectorXd natural_units(const std::shared_ptr<const ImplicitSystem>& system,
                       const ConstraintLadder& ladder) {
  const Manifold& M = *system->manifold();
  const Index n = M.dimension(), size = M.tangent_dimension();
  if (ladder.point.x.size() == 0 || n == 0) return VectorXd::Ones(size);
  const DerivativeArray array(system, ladder.point.t, ladder.point.x);
  // The equations themselves: higher derivatives are not all determined, and what an iteration made
  // of those that are not has no units of its own.
  const VectorXd y = array.jet(ladder.point.v, ladder.point.z);
  VectorXd reach = y.cwiseAbs();
  reach.head(n) = array.origin_size();  // the chart's own coordinates are 0
  const GenericScaling generic(array, y, reach);
  const NaturalScaling natural({VectorXd::Zero(generic.scaled.rows()), generic.magnitude}, reach,
                               0.0, 1e-10);
  const VectorXd units = generic.scaled.rows() + generic.scaled.cols() > kExact
                             ? VectorXd(natural.column_scale.head(n))
                             : VectorXd(column_scales(generic.magnitude, natural.row_scale,
                                                      natural.column_scale, ladder.jet)
                                            .head(n));
  if (n == size) return units;
  // The geometric mean over a block, weighted with what each basis vector has in it.
  const std::vector<Index> block = blocks(M);
  VectorXd weight = VectorXd::Zero(size), logarithm = weight, result(size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < n; ++j) {
      const double share = std::pow(array.basis()(i, j), 2);
      weight[block[static_cast<std::size_t>(i)]] += share;
      logarithm[block[static_cast<std::size_t>(i)]] += share * std::log(units[j]);
    }
  for (Index i = 0; i < size; ++i) {
    const Index b = block[static_cast<std::size_t>(i)];
    result[i] = weight[b] > 0.0 ? std::exp(logarithm[b] / weight[b]) : 1.0;
  }
  return result;
}

}  // namespace courant
