#include "courant/integrators/step/transported_frame.hpp"

#include <algorithm>

#include "courant/core/linear/plain_products.hpp"
#include "courant/core/linear/range_basis.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"

namespace courant {

Function::Formulas TransportedFrame::formulas(const Manifold& manifold) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, manifold);
  const ExprVector entries = basis_parameters(basis);
  Function::Formulas result{.inputs = {{"x", x}, {"basis", entries}}};
  if (entries.size() > 0)
    result.outputs = (manifold.tangent_projector(x) * basis).entries().reshaped();
  return result;
}

Function TransportedFrame::projection(const Manifold& manifold, Backend backend) {
  return Function("basis", formulas(manifold), {.backend = backend});
}

LinearMap<double> TransportedFrame::at(const Manifold& manifold, const VectorXd& x) {
  TransportedFrame basis(manifold, projection(manifold, Backend::interpreter));
  basis.move_to(x);
  return basis.basis_;
}

TransportedFrame::TransportedFrame(const Manifold& manifold, Function projection)
    : projection_(std::move(projection)),
      basis_(projection_.output_size() == 0
                 ? LinearMap<double>::identity(manifold.dimension())
                 : LinearMap<double>(
                       MatrixXd::Identity(manifold.tangent_dimension(), manifold.dimension()))),
      kept_(basis_),
      projected_(basis_.entries()),
      make_orthonormal_(basis_.cols()) {}

bool TransportedFrame::move_to(const VectorXd& x) {
  if (projection_.output_size() == 0) return true;
  if (is_set_) {
    const double* in[] = {x.data(), data()};
    projection_.value(in, projected_.data());
    if (make_orthonormal_(projected_, basis_.entries())) return true;
    if (make_orthonormal_.from_afar(projected_, basis_.entries())) return true;
  }
  make_afresh(x);
  is_set_ = true;
  ++times_made_;
  return false;
}

// From Π(x), as many of its columns at once as B has.
void TransportedFrame::make_afresh(const VectorXd& x) {
  MatrixXd& B = basis_.entries();
  const Index size = B.rows(), n = B.cols();
  MatrixXd projector(size, size);
  const double* in[] = {x.data(), data()};
  for (Index first = 0; first < size; first += n) {
    const Index count = std::min(n, size - first);
    B.setZero();
    for (Index j = 0; j < count; ++j) B(first + j, j) = 1.0;
    projection_.value(in, projected_.data());
    projector.middleCols(first, count) = projected_.leftCols(count);
  }
  B = range_basis(std::move(projector), n);
}

bool TransportedFrame::take_over(const TransportedFrame& other) {
  if (projection_.output_size() == 0) return true;
  const bool goes_on = times_made_ == other.times_made_;
  basis_ = other.basis_;
  kept_ = other.kept_;
  is_set_ = other.is_set_;
  times_made_ = other.times_made_;
  return goes_on;
}

void TransportedFrame::coordinates_of(const VectorXd& v, Eigen::Ref<VectorXd> coordinates) const {
  if (basis_.is_identity()) {
    coordinates = v;
    return;
  }
  const MatrixXd& B = basis_.entries();
  for (Index j = 0; j < B.cols(); ++j)
    coordinates[j] = plain_product(B.data() + j * B.rows(), v.data(), B.rows());
}

}  // namespace courant
