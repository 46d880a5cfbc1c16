#include "courant/integrators/step/nearest_orthonormal.hpp"

#include <cmath>

#include "courant/core/linear/plain_products.hpp"
#include "courant/core/linear/static_size.hpp"

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
  double sum = 0.0;
  for (Index a = 0; a < columns; ++a)
    for (Index b = 0; b <= a; ++b) {
      const double entry = (a == b ? 1.0 : 0.0) - plain_product(p + a * rows, p + b * rows, rows);
      E[a + b * columns] = E[b + a * columns] = entry;
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

// B = P root, for few columns, row by row: P may be B.
template <int n>
void multiply_rows(const MatrixXd& P, const double* root, MatrixXd& B) {
  const Index rows = P.rows();
  const double* const p = P.data();
  double* const b = B.data();
  for (Index i = 0; i < rows; ++i) {
    double row[n];
    for (Index j = 0; j < n; ++j) {
      row[j] = p[i] * root[j * n];
      for (Index k = 1; k < n; ++k) row[j] += p[i + k * rows] * root[k + j * n];
    }
    for (Index j = 0; j < n; ++j) b[i + j * rows] = row[j];
  }
}

}  // namespace

NearestOrthonormal::NearestOrthonormal(Index columns)
    : find_(with_static_size(columns, [](auto n) { return &find<decltype(n)::value>; })) {}

template <int n>
bool NearestOrthonormal::find(const MatrixXd& P, MatrixXd& B, int most_from_afar,
                              Workspace& workspace) {
  const Index columns = P.cols();
  const auto by = [&](double* E, double* square, double* root, const auto& multiply) {
    const MatrixXd* from = &P;
    for (int far = 0;; from = &B) {
      const double size = defect<n>(*from, columns, E);
      if (!(size < kNearlyOrthonormal) && (++far > most_from_afar || !std::isfinite(size)))
        return false;
      inverse_root<n>(E, size, columns, square, root);
      multiply(*from);
      if (size <= kLastStep) return true;
    }
  };
  if constexpr (n == Eigen::Dynamic) {
    MatrixXd &E = workspace.E, &square = workspace.square, &root = workspace.root;
    MatrixXd& last = workspace.last;
    for (MatrixXd* matrix : {&E, &square, &root}) matrix->resize(columns, columns);
    return by(E.data(), square.data(), root.data(), [&](const MatrixXd& from) {
      last = from;
      plain_product(last.data(), last.rows(), root.data(), columns, columns, B.data());
    });
  } else {
    double E[n * n], square[n * n], root[n * n];
    return by(E, square, root, [&](const MatrixXd& from) { multiply_rows<n>(from, root, B); });
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
