#include "courant/structures/dirac_system.hpp"

#include <algorithm>
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

// Of multipliers and equations that nobody named: lambda, and the velocity that an equation is that
// of.
ImplicitSystem::Names completed(ImplicitSystem::Names names, const DiracStructure& structure,
                                const GeneratingFamily& family) {
  const auto parameters = static_cast<std::size_t>(family.parameter_size());
  if (names.auxiliary.empty()) {
    std::vector<std::string> multipliers(parameters, "lambda");
    for (const std::string& port : structure.port_names())
      multipliers.push_back(port.starts_with("u[") && structure.is_dirac() ? "lambda" : port);
    const auto count = std::ranges::count(multipliers, "lambda");
    std::size_t number = 0;
    for (std::string& name : multipliers)
      if (name == "lambda" && count > 1) name += "[" + std::to_string(number++) + "]";
    const bool is_taken = std::ranges::any_of(multipliers, [&](const std::string& name) {
      return std::ranges::count(names.coordinates, name) > 0;
    });
    if (!is_taken) names.auxiliary = std::move(multipliers);
  }
  const auto size = static_cast<std::size_t>(structure.manifold()->tangent_dimension());
  if (names.equations.empty() && structure.tangent_blocks() > 0 &&
      names.coordinates.size() == size) {
    for (const std::string& name : names.coordinates)
      names.equations.push_back("equation of " + name + "'");
    const std::size_t all = static_cast<std::size_t>(structure.equation_count()) + parameters;
    for (std::size_t i = size; i < all; ++i)
      names.equations.push_back("equation " + std::to_string(i + 1));
  }
  return names;
}

}  // namespace

DiracSystem::DiracSystem(std::shared_ptr<const DiracStructure> structure,
                         std::shared_ptr<const GeneratingFamily> family, Names names)
    // Braces evaluate from left to right: the check comes first.
    : ImplicitSystem{checked(structure, family).manifold(),
                     family->parameter_size() + structure->port_size(),
                     structure->equation_count() + family->parameter_size(),
                     completed(std::move(names), *structure, *family)},
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
