#include "courant/integrators/moving_basis.hpp"

#include "courant/core/singular_value_decomposition.hpp"
#include "courant/integrators/ladder/local_formulation.hpp"

namespace courant {
namespace {

// The cosine below which tangent spaces are taken as orthogonal.
constexpr double kRightAngle = 1e-2;

}  // namespace

Function MovingBasis::projection(const Manifold& manifold, Backend backend) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, manifold);
  const ExprVector entries = basis_parameters(basis);
  const ExprVector projected =
      entries.size() == 0
          ? entries
          : ExprVector((manifold.tangent_projector(x) * basis).entries().reshaped());
  return Function("basis", {{"x", x}, {"basis", entries}}, projected, {.backend = backend});
}

MovingBasis::MovingBasis(const Manifold& manifold, Function projection)
    : manifold_(manifold),
      projection_(std::move(projection)),
      basis_(projection_.output_size() == 0
                 ? LinearMap<double>::identity(manifold.dimension())
                 : LinearMap<double>(
                       MatrixXd::Identity(manifold.tangent_dimension(), manifold.dimension()))),
      kept_(basis_),
      projected_(basis_.entries()),
      make_orthonormal_(basis_.cols()) {}

bool MovingBasis::move_to(const VectorXd& x) {
  if (projection_.output_size() == 0) return true;
  if (!is_set_) {
    basis_ = manifold_.tangent_basis(x);
    is_set_ = true;
    ++times_made_;
    return false;
  }
  const double* in[] = {x.data(), data()};
  projection_.value(in, projected_.data());
  if (make_orthonormal_(projected_, basis_.entries())) return true;
  if (projected_.allFinite()) {
    const auto [values, U, V] = singular_value_decomposition(projected_);
    if (values.minCoeff() > kRightAngle * values.maxCoeff()) {
      basis_.entries() = U.leftCols(V.cols()) * V.transpose();
      return true;
    }
  }
  basis_ = manifold_.tangent_basis(x);
  ++times_made_;
  return false;
}

bool MovingBasis::take_over(const MovingBasis& other) {
  if (projection_.output_size() == 0) return true;
  const bool goes_on = times_made_ == other.times_made_;
  basis_ = other.basis_;
  kept_ = other.kept_;
  is_set_ = other.is_set_;
  times_made_ = other.times_made_;
  return goes_on;
}

void MovingBasis::coordinates_of(const VectorXd& v, Eigen::Ref<VectorXd> coordinates) const {
  if (basis_.is_identity())
    coordinates = v;
  else
    coordinates.noalias() = basis_.entries().transpose().operator*(v);
}

}  // namespace courant
