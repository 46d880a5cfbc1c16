#include "courant/integrators/nearest_orthonormal.hpp"

#include <cmath>

#include "courant/core/plain_products.hpp"
#include "courant/core/static_size.hpp"

namespace courant {
namespace {

// Newton and Schulz multiply small singular values by 1.5 in each step.
constexpr int kMostSteps = 24;

// E = 1 - PᵀP of n columns, or (Eigen::Dynamic) as many as E has; the sum of the squares of its entries.
template <int n>
double defect(const MatrixXd& P, Index columns, double* E) {
  if constexpr (n != Eigen::Dynamic) columns = n;
  const Index rows = P.rows();
  const double* const p = P.data();
  double sum = 0.0;
  for (Index a = 0; a < columns; ++a)
    for (Index b = 0; b <= a; ++b) {
      double entry = a == b ? 1.0 : 0.0;
      for (Index i = 0; i < rows; ++i) entry -= p[i + a * rows] * p[i + b * rows];
      E[a + b * columns] = E[b + a * columns] = entry;
      sum += (a == b ? 1.0 : 2.0) * (entry * entry);
    }
  return sum;
}

// root = (1 - E)^{-1/2} by its power series, where `size` is ‖E‖² < 1/4. The powers of E alternate between two places.
template <int n>
void inverse_root(const double* E, double size, Index columns, double* root, double* power,
                  double* next) {
  if constexpr (n != Eigen::Dynamic) columns = n;
  const Index count = columns * columns;
  for (Index k = 0; k < count; ++k) {
    root[k] = 0.5 * E[k];
    power[k] = E[k];
  }
  for (Index k = 0; k < count; k += columns + 1) root[k] += 1.0;
  double coefficient = 0.5;      // of Eʲ
  double of_term = size * size;  // ‖E‖²ʲ
  for (int j = 2; of_term > 1e-32; ++j, of_term *= size) {
    coefficient *= 1.0 - 0.5 / j;
    plain_product<n>(power, columns, E, columns, columns, next);
    std::swap(power, next);
    for (Index k = 0; k < count; ++k) root[k] += coefficient * power[k];
  }
}

}  // namespace

NearestOrthonormal::NearestOrthonormal(Index columns)
    : find_(with_static_size(columns, [](auto n) { return &find<decltype(n)::value>; })) {
  workspace_.fill(MatrixXd(columns, columns));
}

template <int n>
bool NearestOrthonormal::find(const MatrixXd& P, MatrixXd& B, Workspace& workspace) {
  const Index columns = P.cols();
  const auto by = [&](double* E, double* root, double* power, double* next) {
    const double size = defect<n>(P, columns, E);
    if (!(size < 0.25)) return false;
    inverse_root<n>(E, size, columns, root, power, next);
    plain_product<n>(P.data(), P.rows(), root, columns, columns, B.data());
    return true;
  };
  if constexpr (n == Eigen::Dynamic) {
    auto& [E, root, power, next] = workspace;
    return by(E.data(), root.data(), power.data(), next.data());
  } else {
    double E[n * n], root[n * n], power[n * n], next[n * n];
    return by(E, root, power, next);
  }
}

bool NearestOrthonormal::from_afar(MatrixXd P, MatrixXd& B) {
  double square = 0.0;
  for (const double entry : P.reshaped()) square += entry * entry;
  if (!(square > 0.0) || !std::isfinite(square)) return false;
  const double size = std::sqrt(square);
  for (double& entry : P.reshaped()) entry /= size;
  auto& [E, step, power, next] = workspace_;
  const Index columns = P.cols();
  for (int k = 0; k < kMostSteps; ++k) {
    if ((*this)(P, B)) return true;
    defect<Eigen::Dynamic>(P, columns, E.data());
    for (double& entry : E.reshaped()) entry *= 0.5;
    for (Index j = 0; j < columns; ++j) E(j, j) += 1.0;
    multiply_plainly(P, E, B);
    P = B;
  }
  return false;
}

}  // namespace courant
