#include "courant/integrators/fixed_time_projector.hpp"

#include <stdexcept>

#include "courant/core/qr_decomposition.hpp"

namespace courant {
namespace {

// Constraints of which this part of a unit covector is left at fixed t hold time alone: known to half
// of the digits it would be round-off.
constexpr double kLeastPart = 1e-8;

}  // namespace

FixedTimeProjector::FixedTimeProjector(std::shared_ptr<const Projector> projector,
                                       std::shared_ptr<const Manifold> manifold)
    : Projector(projector ? projector->name()
                          : throw std::invalid_argument(
                                "FixedTimeProjector::FixedTimeProjector: the projector is null.")),
      projector_(std::move(projector)),
      manifold_(std::move(manifold)) {
  if (!manifold_)
    throw std::invalid_argument("FixedTimeProjector::FixedTimeProjector: the manifold is null.");
}

MatrixXd FixedTimeProjector::do_directions(const VectorXd& x, const LinearMap<double>& basis,
                                           const MatrixXd& conormals) const {
  const VectorXd point = x.head(manifold_->ambient_dimension());
  const LinearMap<double> own = manifold_->tangent_basis(point);
  const Index size = manifold_->tangent_dimension(), d = conormals.cols();
  const MatrixXd covectors = (basis * conormals).topRows(size);
  const auto qr = QrDecomposition::pivoted(own.transpose() * covectors);
  const VectorXd pivots = qr.diagonal().cwiseAbs();
  if (pivots.size() < d || (d > 0 && !(pivots[d - 1] > kLeastPart)))
    throw std::domain_error(
        "FixedTimeProjector::directions: a constraint holds time alone; expected constraints of "
        "the "
        "point at each time.");
  MatrixXd moves = MatrixXd::Zero(basis.rows(), d);
  moves.topRows(size) = own * projector_->directions(point, own, qr.Q(d));
  return basis.transpose() * moves;
}

}  // namespace courant
