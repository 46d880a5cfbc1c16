#include "courant/integrators/moving_basis.hpp"

#include <Eigen/SVD>

#include "courant/core/static_size.hpp"
#include "courant/integrators/local_formulation.hpp"

namespace courant {
namespace {

// The cosine below which tangent spaces are taken as orthogonal.
constexpr double kRightAngle = 1e-2;

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
    next.noalias() = power * E;
    power.swap(next);
    root += coefficient * power;
  }
  return true;
}

// B = P (1 - E)^{-1/2} with E = 1 - PᵀP, the orthonormal matrix nearest to P, for n columns or
// (Eigen::Dynamic) any. False, and B as it was, if P is not nearly orthonormal.
template <int n>
bool make_orthonormal(const MatrixXd& P, MatrixXd& B, std::array<MatrixXd, 4>& workspace) {
  if constexpr (n == Eigen::Dynamic) {
    auto& [E, root, power, next] = workspace;
    E.setIdentity(P.cols(), P.cols());
    E.noalias() -= P.transpose() * P;
    if (!inverse_root(E, root, power, next)) return false;
    B.noalias() = P * root;
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

}  // namespace

Function MovingBasis::projection(const Manifold& manifold, Backend backend) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  const ExprMatrix basis = basis_variables(graph, manifold);
  const ExprVector entries = basis_parameters(manifold, basis);
  const ExprVector projected = entries.size() == 0
                                   ? entries
                                   : ExprVector((manifold.tangent_projector(x) * basis).reshaped());
  return Function("basis", {{"x", x}, {"basis", entries}}, projected, {.backend = backend});
}

MovingBasis::MovingBasis(const Manifold& manifold, Function projection, const VectorXd& x)
    : manifold_(manifold),
      projection_(std::move(projection)),
      basis_(manifold.tangent_basis(x)),
      projected_(basis_),
      make_orthonormal_(with_static_size(
          basis_.cols(), [](auto n) { return &make_orthonormal<decltype(n)::value>; })) {}

bool MovingBasis::move_to(const VectorXd& x) {
  if (projection_.output_size() == 0) return true;
  const double* in[] = {x.data(), basis_.data()};
  projection_.value(in, projected_.data());
  if (make_orthonormal_(projected_, basis_, workspace_)) return true;
  if (projected_.allFinite()) {
    const Eigen::JacobiSVD<MatrixXd> svd(projected_, Eigen::ComputeThinU | Eigen::ComputeThinV);
    if (svd.singularValues().minCoeff() > kRightAngle * svd.singularValues().maxCoeff()) {
      basis_ = svd.matrixU() * svd.matrixV().transpose();
      return true;
    }
  }
  basis_ = manifold_.tangent_basis(x);
  return false;
}

}  // namespace courant
