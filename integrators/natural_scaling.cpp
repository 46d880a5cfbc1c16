#include "courant/integrators/natural_scaling.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace courant {
namespace {

// The components of the bipartite graph of rows and columns, by merging.
class Components {
 public:
  explicit Components(Index size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  Index root(Index i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      Index& up = parent_[static_cast<std::size_t>(i)];
      up = parent_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }
  void join(Index i, Index j) { parent_[static_cast<std::size_t>(root(i))] = root(j); }

 private:
  std::vector<Index> parent_;
};

}  // namespace

NaturalScaling::NaturalScaling(const Linearization& at, const VectorXd& reach) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  Equilibration<SparseMatrixXd> equilibrated = equilibrate(at.jacobian, 64 * eps);
  scaled = std::move(equilibrated.scaled);
  row_scale = std::move(equilibrated.row_scale);
  column_scale = std::move(equilibrated.column_scale);

  const Index m = scaled.rows(), n = scaled.cols();
  Components components(m + n);
  for (Index j = 0; j < n; ++j)
    for (SparseMatrixXd::InnerIterator it(scaled, j); it; ++it) components.join(it.row(), m + j);
  std::vector<Index> number(static_cast<std::size_t>(m + n), -1);
  const auto component_of = [&](Index vertex) {
    Index& index = number[static_cast<std::size_t>(components.root(vertex))];
    if (index < 0) index = component_count++;
    return index;
  };
  for (Index i = 0; i < m; ++i) row_component.push_back(component_of(i));
  std::vector<Index> column_component;
  for (Index j = 0; j < n; ++j) column_component.push_back(component_of(m + j));

  VectorXd size = VectorXd::Zero(component_count),
           inverse_residual = VectorXd::Zero(component_count);
  for (Index j = 0; j < n; ++j) {
    double& s = size[column_component[static_cast<std::size_t>(j)]];
    s = std::max(s, reach[j] / column_scale[j]);
  }
  for (Index i = 0; i < m; ++i) {
    double& s = inverse_residual[row_component[static_cast<std::size_t>(i)]];
    s = std::max(s, std::abs(at.value[i]) * row_scale[i]);
  }
  const auto factor = [&](Index component) {
    if (size[component] > 0.0) return size[component];
    return inverse_residual[component] > 0.0 ? inverse_residual[component] : 1.0;
  };
  for (Index i = 0; i < m; ++i) row_scale[i] /= factor(row_component[static_cast<std::size_t>(i)]);
  for (Index j = 0; j < n; ++j)
    column_scale[j] *= factor(column_component[static_cast<std::size_t>(j)]);
}

double NaturalScaling::defect(const VectorXd& value, const VectorXd& reach) const {
  const VectorXd residual = row_scale.cwiseProduct(value).cwiseAbs();
  const VectorXd made_of = scaled.cwiseAbs() * reach.cwiseQuotient(column_scale);
  VectorXd largest = VectorXd::Zero(component_count), scale = VectorXd::Zero(component_count);
  for (Index i = 0; i < residual.size(); ++i) {
    const Index component = row_component[static_cast<std::size_t>(i)];
    largest[component] = std::max(largest[component], residual[i]);
    scale[component] = std::max(scale[component], made_of[i]);
  }
  double worst = 0.0;
  for (Index c = 0; c < component_count; ++c)
    if (largest[c] > 0.0) worst = std::max(worst, scale[c] > 0.0 ? largest[c] / scale[c] : 1.0);
  return worst;
}

GenericScaling::GenericScaling(const Prolongation& array, const VectorXd& y) {
  const SparseMatrixXd jacobian = array.linearize(y).jacobian;
  SparseMatrixXd magnitude = jacobian.cwiseAbs();
  if (!array.has_constant_jacobian()) {
    std::mt19937 generator(20250613);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    for (int sample = 0; sample < 2; ++sample) {
      const VectorXd nearby =
          y.unaryExpr([&](double value) { return value * (1.0 + uniform(generator)); });
      const SparseMatrixXd there = array.linearize(nearby).jacobian.cwiseAbs();
      bool finite = true;
      for (Index k = 0; k < there.nonZeros(); ++k)
        finite = finite && std::isfinite(there.valuePtr()[k]);
      if (!finite) continue;
      const SparseMatrixXd larger = magnitude.cwiseMax(there);
      magnitude = larger;
    }
  }
  Equilibration<SparseMatrixXd> equilibrated = equilibrate(magnitude, 0.0);
  row_scale = std::move(equilibrated.row_scale);
  column_scale = std::move(equilibrated.column_scale);
  scaled = row_scale.asDiagonal() * jacobian * column_scale.asDiagonal();
}

}  // namespace courant
