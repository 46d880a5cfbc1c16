#include "courant/integrators/natural_units.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

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
// Entries below this, where rows and columns are levelled, are no units.
constexpr double kLeastEntry = 1e-9;

// Numbers that are zero come out of the search for a consistent point as what it leaves of the others:
// those below this part of the largest of their kind, as they are and in units, say nothing about a
// size.
constexpr double kZero = 1e-9;

VectorXd without_zeros(const VectorXd& sizes) {
  if (sizes.size() == 0) return sizes;
  const double least = kZero * sizes.maxCoeff();
  return (sizes.array() > least).select(sizes, 0.0);
}

// The sizes of the unknowns of level 0 at the jet y, 0 where they are zero but for round-off: of the
// coordinates, since those of the chart are 0, and of the rates next to each other; of an auxiliary
// unknown next to the coordinates, rates and constants that it meets in an equation.
VectorXd known_sizes(const DerivativeArray& array, const VectorXd& y) {
  const Index n = array.base_size();
  VectorXd sizes = VectorXd::Zero(y.size());
  sizes.head(n) = without_zeros(array.origin_size());
  sizes.segment(n, n) = without_zeros(y.segment(n, n).cwiseAbs());
  const VectorXd without_unknowns = (sizes.array() > 0.0).select(y, 0.0);
  // Equations that divide by an unknown are not finite here, and say nothing.
  const Linearization known = array.linearize(without_unknowns);
  const SparseMatrixXd terms = known.jacobian.cwiseAbs();
  const VectorXd least = kZero * (known.value.cwiseAbs() + terms * sizes);
  const VectorXd unknowns = without_zeros(y.tail(y.size() - 2 * n).cwiseAbs());
  for (Index j = 2 * n; j < y.size(); ++j)
    for (SparseMatrixXd::InnerIterator it(terms, j); it; ++it)
      if (least[it.row()] > 0.0 && it.value() * unknowns[j - 2 * n] > least[it.row()])
        sizes[j] = unknowns[j - 2 * n];
  return sizes;
}

// The units c of the columns (ξ, ξ', z), where those of ξ' are those of ξ divided by a unit of time T,
// and r of the rows that minimise
//
//   Σ (log r_i + log |a_ij| + log c_j)²
//
// over the entries. Of what that leaves open, which is T where no equation says it, it is
//
//   Σ (log c_j - log |y_j|)²
//
// that is least, over what is known to differ from zero: reach[j] > 0. A common factor of the units of
// what the equations connect stays open; it is no matter.
VectorXd column_units(const SparseMatrixXd& magnitude, const VectorXd& row_scale,
                      const VectorXd& column_scale, Index n, const VectorXd& reach) {
  const Index m = magnitude.rows(), columns = magnitude.cols(), unknowns = m + columns - n + 1;
  // log c = C s for the unknowns s: rows, ξ, z, T.
  MatrixXd C = MatrixXd::Zero(columns, unknowns);
  for (Index j = 0; j < columns; ++j) {
    C(j, m + (j < n ? j : j - n)) = 1.0;
    if (j >= n && j < 2 * n) C(j, unknowns - 1) = -1.0;
  }
  MatrixXd A = MatrixXd::Zero(unknowns, unknowns);
  VectorXd b = VectorXd::Zero(unknowns);
  for (Index j = 0; j < columns; ++j)
    for (SparseMatrixXd::InnerIterator it(magnitude, j); it; ++it) {
      if (row_scale[it.row()] * it.value() * column_scale[j] < kLeastEntry) continue;
      VectorXd term = C.row(j);
      term[it.row()] = 1.0;
      A += term * term.transpose();
      b -= std::log(it.value()) * term;
    }
  const CompleteOrthogonalDecomposition normal(A, 1e-12);
  VectorXd s = normal.solve(b);
  const MatrixXd open = normal.Q().rightCols(unknowns - normal.rank());
  std::vector<Index> known;
  for (Index j = 0; j < columns; ++j)
    if (reach[j] > 0.0) known.push_back(j);
  if (open.cols() > 0 && !known.empty()) {
    const VectorXd size = reach(known).array().log();
    const MatrixXd K = C(known, Eigen::all);
    s += open * CompleteOrthogonalDecomposition(K * open, 1e-12).solve(size - K * s);
  }
  return (C * s).array().exp();
}

// The largest |∂F_i/∂y_j| at y and at points that are up to these moves away, or to a tenth of them.
SparseMatrixXd magnitude_near(const DerivativeArray& array, const VectorXd& y,
                              const VectorXd& moves) {
  SparseMatrixXd magnitude = array.linearize(y).jacobian.cwiseAbs();
  if (array.has_constant_jacobian()) return magnitude;
  std::mt19937 generator(20250613);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int sample = 0; sample < 4; ++sample) {
    const double part = sample < 2 ? 1.0 : 0.1;
    const VectorXd nearby =
        y + moves.unaryExpr([&](double move) { return part * move * uniform(generator); });
    const SparseMatrixXd there = array.linearize(nearby).jacobian.cwiseAbs();
    const Eigen::Map<const VectorXd> entries(there.valuePtr(), there.nonZeros());
    if (entries.allFinite()) magnitude = SparseMatrixXd(magnitude.cwiseMax(there));
  }
  return magnitude;
}

// Units of all unknowns of level 0, near the jet y. `reach`: their sizes, 0 where they are zero but for
// round-off. What vanishes at y is as large as it is nearby: numbers differ by parts of their sizes,
// and zeros by parts of their units, which is why there are several rounds.
VectorXd units_near(const DerivativeArray& array, const VectorXd& y, const VectorXd& reach) {
  constexpr int rounds = 4;
  const VectorXd at = (reach.array() > 0.0).select(y, 0.0);
  VectorXd moves = 0.1 * reach, units;
  for (int round = 0; round < rounds; ++round) {
    const SparseMatrixXd magnitude = magnitude_near(array, at, moves);
    const NaturalScaling natural({VectorXd::Zero(magnitude.rows()), magnitude}, reach, kLeastEntry,
                                 1e-10);
    units = magnitude.rows() + magnitude.cols() > kExact
                ? natural.column_scale
                : column_units(magnitude, natural.row_scale, natural.column_scale,
                               array.base_size(), reach);
    if (array.has_constant_jacobian()) break;
    moves = (reach.array() > 0.0).select(0.1 * reach, units);
  }
  return units;
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
  const VectorXd reach = known_sizes(array, y);
  VectorXd units = units_near(array, y, reach);
  const VectorXd seen = without_zeros(reach.cwiseQuotient(units)).cwiseProduct(units);
  if ((seen.array() > 0.0).count() < (reach.array() > 0.0).count())
    units = units_near(array, y, (seen.array() > 0.0).select(reach, 0.0));
  units = units.head(n).eval();
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
