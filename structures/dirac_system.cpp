#include "courant/structures/dirac_system.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/graph_parameters.hpp"

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
                                Index parameter_count) {
  const auto parameters = static_cast<std::size_t>(parameter_count);
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

// A law of the exterior; 0 without one.
ExprVector source_of(const DiracSystem::Law& law, const ExprVector& x, const ExprVector& v,
                     const ExprVector& alpha, const Expr& t) {
  const Index expected = 2 * v.size();
  if (!law) return ExprVector::Zero(expected);
  ExprVector e = law(x, v, alpha, t);
  if (e.size() != expected)
    throw std::invalid_argument("DiracSystem: the source has " + std::to_string(e.size()) +
                                " entries; expected a tangent vector and a covector, " +
                                std::to_string(expected) + ".");
  return e;
}

}  // namespace

DiracSystem::DiracSystem(std::shared_ptr<const DiracStructure> structure,
                         std::shared_ptr<const GeneratingFamily> family, Names names)
    : DiracSystem(std::move(structure), std::move(family), Exterior{}, std::move(names)) {}

DiracSystem::DiracSystem(std::shared_ptr<const DiracStructure> structure,
                         std::shared_ptr<const GeneratingFamily> family, Exterior exterior,
                         Names names)
    // Braces evaluate from left to right: the check comes first.
    : EnergySystem{checked(structure, family).manifold(),
                   family->parameter_size() + exterior.constraint_count + structure->port_size(),
                   structure->equation_count() + family->parameter_size() +
                       exterior.constraint_count,
                   completed(std::move(names), *structure,
                             family->parameter_size() + exterior.constraint_count)},
      structure_(std::move(structure)),
      family_(std::move(family)),
      exterior_(std::move(exterior)) {
  if (!exterior_.constraint != (exterior_.constraint_count == 0))
    throw std::invalid_argument("DiracSystem::DiracSystem: the exterior has constraint_count = " +
                                std::to_string(exterior_.constraint_count) + " and " +
                                (exterior_.constraint ? "a constraint" : "no constraint") +
                                "; expected a constraint if and only if the count is positive.");
}

ExprVector DiracSystem::sources(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                const Expr& t) const {
  const ExprVector e = source_of(exterior_.source, x, v, alpha, t);
  return exterior_.damping ? ExprVector(e + source_of(exterior_.damping, x, v, alpha, t)) : e;
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
  const Graph graph = fresh_graph({x, v, alpha, ExprVector::Constant(1, t)});
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

Expr DiracSystem::do_generator(const ExprVector& x, const ExprVector& z, const Expr& t) const {
  return family_->value(x, z.head(family_->parameter_size()), t);
}

ExprVector DiracSystem::do_effort(const ExprVector& x, const ExprVector& z, const Expr& t) const {
  return family_->differential(x, z.head(family_->parameter_size()), t);
}

ExprVector DiracSystem::do_equations(const ExprVector& x, const ExprVector& v,
                                     const ExprVector& alpha, const ExprVector& z, const Expr& t,
                                     const ExprVector& y, const Expr& s) const {
  const Index n = v.size(), m = exterior_.constraint_count;
  const ExprVector lambda = z.head(family_->parameter_size()), u = z.tail(structure_->port_size());
  ExprVector pair(2 * n);
  pair << v, alpha;
  if (exterior_.has_sources()) pair -= sources(x, v, alpha, t);
  if (m > 0) pair -= reaction(x, v, alpha, z.segment(family_->parameter_size(), m), t);
  ExprVector equations(equation_count());
  equations.head(equation_count() - m) << structure_->membership(x, pair.head(n), pair.tail(n), u),
      family_->stationarity(y, lambda, s);
  if (m > 0) equations.tail(m) = constraint(x, v, alpha, t);
  return equations;
}

// ⟨α - a, v - b⟩ = 0 with (b, a) what sources and reactions are together.
EnergySystem::Powers DiracSystem::do_powers(const ExprVector& x, const ExprVector& v,
                                            const ExprVector& alpha, const ExprVector& z,
                                            const Expr& t) const {
  const Index n = v.size(), m = exterior_.constraint_count;
  const auto pairing = [n](const ExprVector& a, const ExprVector& b) {
    return a.tail(n).cwiseProduct(b.head(n)).sum() + b.tail(n).cwiseProduct(a.head(n)).sum();
  };
  const auto work = [n](const ExprVector& a) { return a.tail(n).cwiseProduct(a.head(n)).sum(); };
  ExprVector pair(2 * n);
  pair << v, alpha;
  Powers powers;
  const ExprVector given = source_of(exterior_.source, x, v, alpha, t),
                   damping = source_of(exterior_.damping, x, v, alpha, t), e = given + damping;
  if (exterior_.source) powers.supplied.push_back({"forces", pairing(given, pair) - work(given)});
  // What is left of ⟪e, (v, α)⟫ - ⟨e⟩.
  if (exterior_.damping)
    powers.dissipated.push_back(
        {"damping", work(damping) + pairing(damping, given) - pairing(damping, pair)});
  ExprVector rest = pair - e;
  if (m > 0) {
    const ExprVector r = reaction(x, v, alpha, z.segment(family_->parameter_size(), m), t);
    powers.supplied.push_back({"constraints", pairing(r, pair) - pairing(r, e) - work(r)});
    rest -= r;
  }
  if (!structure_->is_dirac()) powers.supplied.push_back({"ports", work(rest)});
  return powers;
}

// E is affine in λ, and the energy where ∂E/∂λ = 0 at any λ: at λ = 0, say.
bool DiracSystem::do_has_explicit_energy() const {
  const Index k = family_->parameter_size();
  if (k == 0) return true;
  Graph graph;
  const ExprVector x = graph.variables("x", manifold()->ambient_dimension());
  const ExprVector lambda = graph.variables("lambda", k);
  const Expr t = graph.variable("t");
  ExprVector rates(k + 1);
  rates << family_->stationarity(x, lambda, t), family_->energy(x, lambda, t);
  return !depends(rates, lambda);
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
