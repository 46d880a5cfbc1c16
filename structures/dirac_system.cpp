#include "courant/structures/dirac_system.hpp"

#include <stdexcept>

namespace courant {
namespace {

const DiracStructure& checked(const std::shared_ptr<const DiracStructure>& structure,
                              const std::shared_ptr<const GeneratingFamily>& family) {
  if (!structure || !family)
    throw std::invalid_argument("DiracSystem::DiracSystem: structure or family is null.");
  if (*structure->manifold() != *family->manifold())
    throw std::invalid_argument("DiracSystem::DiracSystem: the structure is on " +
                                structure->manifold()->name() + ", the generating family on " +
                                family->manifold()->name() +
                                "; expected one and the same manifold.");
  return *structure;
}

}  // namespace

DiracSystem::DiracSystem(std::shared_ptr<const DiracStructure> structure,
                         std::shared_ptr<const GeneratingFamily> family, Names names)
    // Braces evaluate from left to right: the check comes first.
    : ImplicitSystem{checked(structure, family).manifold(),
                     family->parameter_size() + structure->port_size(),
                     structure->equation_count() + family->parameter_size(), std::move(names)},
      structure_(std::move(structure)),
      family_(std::move(family)) {}

ExprVector DiracSystem::do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                    const Expr& t) const {
  const ExprVector lambda = z.head(family_->parameter_size());
  const ExprVector u = z.tail(structure_->port_size());
  ExprVector residual(equation_count());
  residual << structure_->membership(x, v, family_->differential(x, lambda, t), u),
      family_->stationarity(x, lambda, t);
  return residual;
}

std::optional<Expr> DiracSystem::do_energy(const ExprVector& x, const ExprVector& z,
                                           const Expr& t) const {
  return family_->energy(x, z.head(family_->parameter_size()), t);
}

VectorXd DiracSystem::do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const {
  VectorXd z = VectorXd::Zero(auxiliary_size());
  z.head(family_->parameter_size()) = family_->parameter_guess(x, v);
  return z;
}

}  // namespace courant
