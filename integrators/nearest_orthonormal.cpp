#include "courant/integrators/nearest_orthonormal.hpp"

#include "courant/core/static_size.hpp"

namespace courant {
namespace {

// root = (1 - E)^{-1/2} by its power series, with the workspace `power` and `next`. False if E is
// too large for that.
template <class Square>
bool inverse_root(const Square& E, Square& root, Square& power, Square& next) {
  const double defect = E.squaredNorm();
  if (!(defect < 0.25)) return false;
  root.setIdentity(E.rows(), E.cols());
  root += 0.5 * E;
  power = E;
  double coefficient = 0.5;       // of Eʲ
  double size = defect * defect;  // ‖E‖²ʲ
  for (int j = 2; size > 1e-32; ++j, size *= defect) {
    coefficient *= 1.0 - 0.5 / j;
    next.noalias() = power.operator*(E);
    power.swap(next);
    root += coefficient * power;
  }
  return true;
}

}  // namespace

NearestOrthonormal::NearestOrthonormal(Index columns)
    : find_(with_static_size(columns, [](auto n) { return &find<decltype(n)::value>; })) {}

template <int n>
bool NearestOrthonormal::find(const MatrixXd& P, MatrixXd& B, Workspace& workspace) {
  if constexpr (n == Eigen::Dynamic) {
    auto& [E, root, power, next] = workspace;
    E.setIdentity(P.cols(), P.cols());
    E.noalias() -= P.transpose().operator*(P);
    if (!inverse_root(E, root, power, next)) return false;
    B.noalias() = P.operator*(root);
  } else {
    using Row = Eigen::Matrix<double, 1, n>;
    Eigen::Matrix<double, n, n> E, root, power, next;
    E.setIdentity();
    for (Index i = 0; i < P.rows(); ++i) {
      const Row row = P.row(i);
      E -= row.transpose().lazyProduct(row);
    }
    if (!inverse_root(E, root, power, next)) return false;
    for (Index i = 0; i < P.rows(); ++i) {
      const Row row = P.row(i);
      B.row(i) = row.lazyProduct(root);
    }
  }
  return true;
}

}  // namespace courant
