#include "courant/structures/dirac_system.hpp"

#include <stdexcept>

#include "courant/core/derivative.hpp"

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
    : DiracSystem(std::move(structure), std::move(family), Exterior{}, std::move(names)) {}

DiracSystem::DiracSystem(std::shared_ptr<const DiracStructure> structure,
                         std::shared_ptr<const GeneratingFamily> family, Exterior exterior,
                         Names names)
    // Braces evaluate from left to right: the check comes first.
    : ImplicitSystem{checked(structure, family).manifold(),
                     family->parameter_size() + exterior.constraint_count + structure->port_size(),
                     structure->equation_count() + family->parameter_size() +
                         exterior.constraint_count,
                     std::move(names)},
      structure_(std::move(structure)),
      family_(std::move(family)),
      exterior_(std::move(exterior)) {
  if (!exterior_.constraint != (exterior_.constraint_count == 0))
    throw std::invalid_argument("DiracSystem::DiracSystem: the exterior has constraint_count = " +
                                std::to_string(exterior_.constraint_count) + " and " +
                                (exterior_.constraint ? "a constraint" : "no constraint") +
                                "; expected a constraint if and only if the count is positive.");
}

ExprVector DiracSystem::constraint(const ExprVector& x, const ExprVector& v,
                                   const ExprVector& alpha, const Expr& t) const {
  ExprVector g = exterior_.constraint(x, v, alpha, t);
  if (g.size() != exterior_.constraint_count)
    throw std::invalid_argument("DiracSystem: the constraint has " + std::to_string(g.size()) +
                                " entries; expected constraint_count = " +
                                std::to_string(exterior_.constraint_count) + ".");
  return g;
}

// Σ_a κ_a (∂g_a/∂α, ∂g_a/∂v), differentiated at fresh variables.
ExprVector DiracSystem::reaction(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                 const ExprVector& kappa, const Expr& t) const {
  const Index N = x.size(), n = v.size();
  Graph graph;
  ExprVector from(N + 2 * n + 1);
  from << graph.variables("x", N), graph.variables("pair", 2 * n), graph.variable("t");
  const ExprVector pair = from.segment(N, 2 * n);
  const ExprMatrix derivative =
      jacobian(constraint(from.head(N), pair.head(n), pair.tail(n), from[N + 2 * n]), pair).dense();
  ExprVector to(from.size());
  to << x, v, alpha, t;
  ExprVector result = ExprVector::Zero(2 * n);
  for (Index a = 0; a < kappa.size(); ++a) {
    const ExprVector gradient = substitute(ExprVector(derivative.row(a)), from, to);
    result.head(n) += kappa[a] * gradient.tail(n);
    result.tail(n) += kappa[a] * gradient.head(n);
  }
  return result;
}

ExprVector DiracSystem::do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                    const Expr& t) const {
  const Index n = v.size(), m = exterior_.constraint_count;
  const ExprVector lambda = z.head(family_->parameter_size()), u = z.tail(structure_->port_size());
  const ExprVector kappa = z.segment(family_->parameter_size(), m);
  const ExprVector alpha = family_->differential(x, lambda, t);
  ExprVector pair(2 * n);
  pair << v, alpha;
  if (exterior_.source) {
    const ExprVector source = exterior_.source(x, v, alpha, t);
    if (source.size() != 2 * n)
      throw std::invalid_argument("DiracSystem: the source has " + std::to_string(source.size()) +
                                  " entries; expected a tangent vector and a covector, " +
                                  std::to_string(2 * n) + ".");
    pair -= source;
  }
  if (m > 0) pair -= reaction(x, v, alpha, kappa, t);
  ExprVector residual(equation_count());
  residual.head(equation_count() - m) << structure_->membership(x, pair.head(n), pair.tail(n), u),
      family_->stationarity(x, lambda, t);
  if (m > 0) residual.tail(m) = constraint(x, v, alpha, t);
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
