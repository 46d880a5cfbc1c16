#include "courant/structures/generating_family.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/numbers/power_of_two.hpp"

namespace courant {

GeneratingFamily::GeneratingFamily(std::shared_ptr<const Manifold> manifold, Index parameter_size)
    : manifold_(std::move(manifold)), parameter_size_(parameter_size) {
  if (!manifold_)
    throw std::invalid_argument("GeneratingFamily::GeneratingFamily: manifold is null.");
}

Expr GeneratingFamily::value(const ExprVector& x, const ExprVector& lambda, const Expr& t) const {
  if (x.size() != manifold_->ambient_dimension() || lambda.size() != parameter_size_)
    throw std::invalid_argument("GeneratingFamily::value: x and lambda have " +
                                std::to_string(x.size()) + " and " + std::to_string(lambda.size()) +
                                " entries, expected " +
                                std::to_string(manifold_->ambient_dimension()) + " and " +
                                std::to_string(parameter_size_) + ".");
  return do_value(x, lambda, t);
}

// Differentiated at fresh variables, then brought to (x, λ, t), which may be constants or any
// expressions.
ExprVector GeneratingFamily::derivative(const ExprVector& x, const ExprVector& lambda,
                                        const Expr& t, bool by_lambda) const {
  const Graph graph = fresh_graph({x, lambda, ExprVector::Constant(1, t)});
  ExprVector from(x.size() + lambda.size() + 1);
  from << graph.variables("x", x.size()), graph.variables("lambda", lambda.size()),
      graph.variable("t");
  const ExprVector at = from.head(x.size());
  const ExprVector parameters = from.segment(x.size(), lambda.size());
  const ExprVector d =
      gradient(value(at, parameters, from[from.size() - 1]), by_lambda ? parameters : at);
  ExprVector to(from.size());
  to << x, lambda, t;
  return substitute(d, from, to);
}

ExprVector GeneratingFamily::differential(const ExprVector& x, const ExprVector& lambda,
                                          const Expr& t) const {
  return manifold_->frame(x).transpose() * derivative(x, lambda, t, false);
}

ExprVector GeneratingFamily::stationarity(const ExprVector& x, const ExprVector& lambda,
                                          const Expr& t) const {
  return derivative(x, lambda, t, true);
}

Hamiltonian::Hamiltonian(std::shared_ptr<const Manifold> manifold, Formula hamiltonian)
    : GeneratingFamily(std::move(manifold), 0), hamiltonian_(std::move(hamiltonian)) {}

Expr Hamiltonian::do_value(const ExprVector& x, const ExprVector&, const Expr& t) const {
  return hamiltonian_(x, t);
}

Lagrangian::Lagrangian(std::shared_ptr<const CotangentBundle> phase_space, Formula lagrangian)
    : GeneratingFamily(phase_space, phase_space ? phase_space->base()->tangent_dimension() : 0),
      phase_space_(std::move(phase_space)),
      lagrangian_(std::move(lagrangian)),
      normal_masses_(nominal_masses()) {}

// For each component of w the largest |∂_w L| of some vectors w of length 1, over the components that are mixed with
// it; to powers of two, and 1 where that is no number or 0.
VectorXd Lagrangian::nominal_masses() const {
  const Manifold& Q = *phase_space_->base();
  VectorXd masses = VectorXd::Ones(Q.tangent_dimension());
  if (Q.dimension() == Q.tangent_dimension()) return masses;
  const std::vector<Index> mixed = Q.mixed_components();
  VectorXd largest = VectorXd::Zero(masses.size());
  std::mt19937 generator(1);
  for (int sample = 0; sample < 3; ++sample) {
    const VectorXd q = Q.random_point(generator), at = Q.random_tangent(q, 1.0, generator);
    Graph graph;
    const ExprVector w = graph.variables("w", at.size());
    const ExprVector momentum = gradient(lagrangian_(constants(q), w, 0.0), w);
    const VectorXd p = values(substitute(momentum, w, constants(at))).cwiseAbs();
    for (Index i = 0; i < p.size(); ++i)
      if (double& size = largest[mixed[static_cast<std::size_t>(i)]]; std::isfinite(p[i]))
        size = std::max(size, p[i]);
  }
  for (Index i = 0; i < masses.size(); ++i)
    if (const double size = largest[mixed[static_cast<std::size_t>(i)]]; size > 0.0)
      masses[i] = nearest_power_of_two(size);
  return masses;
}

Expr Lagrangian::do_value(const ExprVector& x, const ExprVector& w, const Expr& t) const {
  const ExprVector q = phase_space_->position(x);
  const ExprVector p = phase_space_->momentum(x);
  const Manifold& Q = *phase_space_->base();
  if (Q.dimension() == Q.tangent_dimension()) return p.dot(w) - lagrangian_(q, w, t);
  const ExprVector tangent = Q.tangent_projector(q) * w;
  const ExprVector normal = w - tangent;
  return p.dot(w) - lagrangian_(q, tangent, t) +
         0.5 * normal.dot(normal_masses_.cast<Expr>().cwiseProduct(normal));
}

Expr Lagrangian::do_energy(const ExprVector& x, const ExprVector& w, const Expr& t) const {
  const Graph graph = fresh_graph({x, w, ExprVector::Constant(1, t)});
  ExprVector from(x.size() + w.size() + 1);
  from << graph.variables("x", x.size()), graph.variables("w", w.size()), graph.variable("t");
  const ExprVector q = phase_space_->position(from.head(x.size()));
  const ExprVector velocity = from.segment(x.size(), w.size());
  const Expr lagrangian =
      lagrangian_(q, phase_space_->base()->tangent_projector(q) * velocity, from[from.size() - 1]);
  ExprVector to(from.size());
  to << x, w, t;
  return substitute(gradient(lagrangian, velocity).dot(velocity) - lagrangian, from, to);
}

VectorXd Lagrangian::do_parameter_guess(const VectorXd&, const VectorXd& v) const {
  return phase_space_->horizontal(v);
}

}  // namespace courant
