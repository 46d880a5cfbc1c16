#include "courant/integrators/nearest_orthonormal.hpp"

#include <cmath>

#include "courant/core/plain_products.hpp"
#include "courant/core/static_size.hpp"

namespace courant {
namespace {

// Steps from afar multiply small singular values by 15/8.
constexpr int kMostFromAfar = 16;

// ‖E‖² that one step brings below round-off.
constexpr double kLastStep = 3e-11;
// That E/2 alone does.
constexpr double kLinear = 1e-16;
constexpr double kNearlyOrthonormal = 0.25;

// E = 1 - PᵀP of n columns, or (Eigen::Dynamic) as many as E has; the sum of the squares of its entries.
template <int n>
double defect(const MatrixXd& P, Index columns, double* E) {
  if constexpr (n != Eigen::Dynamic) columns = n;
  const Index rows = P.rows();
  const double* const p = P.data();
  for (Index a = 0; a < columns; ++a)
    for (Index b = 0; b <= a; ++b) E[a + b * columns] = a == b ? 1.0 : 0.0;
  for (Index i = 0; i < rows; ++i)
    for (Index a = 0; a < columns; ++a)
      for (Index b = 0; b <= a; ++b) E[a + b * columns] -= p[i + a * rows] * p[i + b * rows];
  double sum = 0.0;
  for (Index a = 0; a < columns; ++a)
    for (Index b = 0; b <= a; ++b) {
      const double entry = E[b + a * columns] = E[a + b * columns];
      sum += (a == b ? 1.0 : 2.0) * (entry * entry);
    }
  return sum;
}

// root = 1 + E/2 + 3/8 E², where `size` is ‖E‖².
template <int n>
void inverse_root(const double* E, double size, Index columns, double* square, double* root) {
  if constexpr (n != Eigen::Dynamic) columns = n;
  for (Index k = 0; k < columns * columns; ++k) root[k] = 0.5 * E[k];
  if (size > kLinear) {
    plain_product<n>(E, columns, E, columns, columns, square);
    for (Index k = 0; k < columns * columns; ++k) root[k] += 0.375 * square[k];
  }
  for (Index k = 0; k < columns * columns; k += columns + 1) root[k] += 1.0;
}

// B = P root, row by row: P may be B.
template <int n>
void multiply_rows(const MatrixXd& P, const double* root, Index columns, double* row, MatrixXd& B) {
  if constexpr (n != Eigen::Dynamic) columns = n;
  const Index rows = P.rows();
  const double* const p = P.data();
  double* const b = B.data();
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      row[j] = p[i] * root[j * columns];
      for (Index k = 1; k < columns; ++k) row[j] += p[i + k * rows] * root[k + j * columns];
    }
    for (Index j = 0; j < columns; ++j) b[i + j * rows] = row[j];
  }
}

}  // namespace

NearestOrthonormal::NearestOrthonormal(Index columns)
    : find_(with_static_size(columns, [](auto n) { return &find<decltype(n)::value>; })) {}

template <int n>
bool NearestOrthonormal::find(const MatrixXd& P, MatrixXd& B, int most_from_afar,
                              Workspace& workspace) {
  const Index columns = P.cols();
  const auto by = [&](double* E, double* square, double* root, double* row) {
    const MatrixXd* from = &P;
    for (int far = 0;; from = &B) {
      const double size = defect<n>(*from, columns, E);
      if (!(size < kNearlyOrthonormal) && (++far > most_from_afar || !std::isfinite(size)))
        return false;
      inverse_root<n>(E, size, columns, square, root);
      multiply_rows<n>(*from, root, columns, row, B);
      if (size <= kLastStep) return true;
    }
  };
  if constexpr (n == Eigen::Dynamic) {
    auto& [E, square, root, row] = workspace;
    for (MatrixXd* matrix : {&E, &square, &root}) matrix->resize(columns, columns);
    row.resize(columns);
    return by(E.data(), square.data(), root.data(), row.data());
  } else {
    double E[n * n], square[n * n], root[n * n], row[n];
    return by(E, square, root, row);
  }
}

bool NearestOrthonormal::from_afar(MatrixXd P, MatrixXd& B) {
  double square = 0.0;
  for (const double entry : P.reshaped()) square += entry * entry;
  if (!(square > 0.0) || !std::isfinite(square)) return false;
  const double size = std::sqrt(square);
  for (double& entry : P.reshaped()) entry /= size;
  return find_(P, B, kMostFromAfar, workspace_);
}

}  // namespace courant
