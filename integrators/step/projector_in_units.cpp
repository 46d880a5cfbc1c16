#include "courant/integrators/step/projector_in_units.hpp"

#include <stdexcept>
#include <utility>

namespace courant {

ProjectorInUnits::ProjectorInUnits(std::shared_ptr<const Projector> projector, Units units)
    : Projector(projector ? projector->name()
                          : throw std::invalid_argument(
                                "ProjectorInUnits::ProjectorInUnits: the projector is null.")),
      projector_(std::move(projector)),
      units_(std::move(units)) {
  if (auto balanced = projector_->balanced(units_.tangent)) projector_ = std::move(balanced);
}

VectorXd ProjectorInUnits::conormal_sizes() const {
  const VectorXd sizes = projector_->conormal_sizes();
  return sizes.size() == 0 ? sizes : VectorXd(sizes.cwiseProduct(units_.tangent));
}

ExprMatrix ProjectorInUnits::do_directions(const ExprVector& x, const Expr& t,
                                           const LinearMap<Expr>& tangents,
                                           const ExprMatrix& conormals) const {
  const VectorXd inverse = units_.tangent.cwiseInverse();
  const ExprVector at = x.cwiseProduct(constants(units_.coordinates));
  const ExprMatrix own = constants(inverse).asDiagonal() * conormals;
  return constants(inverse).asDiagonal() * projector_->span(at, units_.time * t, tangents, own);
}

}  // namespace courant
