#include "courant/integrators/maps/discrete_dirac_structure.hpp"

#include <stdexcept>

#include "courant/core/words/message.hpp"

namespace courant {

DiscreteDiracStructure::DiscreteDiracStructure(std::shared_ptr<const DiracStructure> structure,
                                               std::shared_ptr<const DiscretizationMap> map)
    : structure_(std::move(structure)), map_(std::move(map)) {
  if (!structure_ || !map_ || *structure_->manifold() != *map_->manifold())
    throw std::invalid_argument(
        "DiscreteDiracStructure: structure and map are missing or not on the same manifold; "
        "expected one manifold for both.");
}

ExprVector DiscreteDiracStructure::membership(const ExprVector& x0, const ExprVector& x1,
                                              const ExprVector& alpha, const ExprVector& u,
                                              const Expr& h) const {
  const auto [x, v] = map_->inverse(x0, x1);
  return structure_->membership(x, v / h, alpha, u);
}

VectorXd DiscreteDiracStructure::base_point(const VectorXd& x0, const VectorXd& x1) const {
  return map_->inverse(x0, x1).x;
}

double DiscreteDiracStructure::distance(const VectorXd& x0, const VectorXd& x1,
                                        const VectorXd& alpha, double h) const {
  const auto [x, v] = map_->inverse(x0, x1);
  const MatrixXd basis = structure_->manifold()->tangent_basis(x);
  return structure_->fibre(x).distance(basis.transpose() * v / h, basis.transpose() * alpha);
}

double DiscreteDiracStructure::pairing(const VectorXd& x0, const VectorXd& x1,
                                       const VectorXd& alpha, const VectorXd& y0,
                                       const VectorXd& y1, const VectorXd& beta) const {
  const auto [x, v] = map_->inverse(x0, x1);
  const auto [y, w] = map_->inverse(y0, y1);
  const double apart = structure_->manifold()->separation(x, y);
  if (!(apart <= 1e-9))
    throw std::domain_error(
        "DiscreteDiracStructure::pairing: the pairs of points are over base points that are " +
        number_text(apart) + " apart; expected one base point, up to 1e-09.");
  return courant::pairing(v, alpha, w, beta);
}

std::vector<DiscreteDiracStructure::Element> DiscreteDiracStructure::elements(const VectorXd& x,
                                                                              double s) const {
  const Manifold& M = *structure_->manifold();
  const PairedSubspace fibre = structure_->fibre(x);
  const MatrixXd basis = M.tangent_basis(x);
  const MatrixXd vectors = basis * fibre.vectors();
  const MatrixXd covectors = M.tangent_projector(x).transpose() * (basis * fibre.covectors());
  std::vector<Element> result;
  for (Index k = 0; k < fibre.dimension(); ++k) {
    const auto [x0, x1] = map_->forward(x, (s * vectors.col(k)).eval());
    result.push_back({x0, x1, s * covectors.col(k)});
  }
  return result;
}

}  // namespace courant
