#include "courant/structures/euler_poincare.hpp"

#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/structures/morse_family.hpp"

namespace courant {
namespace {

// E(μ, a, ξ) = ⟨μ, ξ⟩ - ℓ(ξ, a, t), whose energy is ⟨∂ℓ/∂ξ, ξ⟩ - ℓ.
std::shared_ptr<const GeneratingFamily> reduced_lagrangian(
    const std::shared_ptr<const Manifold>& M, Index n, Index d,
    const EulerPoincare::Function& lagrangian) {
  return std::make_shared<MorseFamily>(
      M, n,
      [lagrangian, n, d](const ExprVector& x, const ExprVector& xi, const Expr& t) {
        return x.head(n).dot(xi) - lagrangian(xi, x.segment(n, d), t);
      },
      [lagrangian, n, d](const ExprVector& x, const ExprVector& xi, const Expr& t) {
        const Graph graph = fresh_graph({x, xi, ExprVector::Constant(1, t)});
        const ExprVector from = graph.variables("from", n + d + 1);
        const ExprVector velocity = from.head(n);
        const Expr l = lagrangian(velocity, from.segment(n, d), from[n + d]);
        ExprVector to(n + d + 1);
        to << xi, x.segment(n, d), t;
        return substitute(gradient(l, velocity).dot(velocity) - l, from, to);
      });
}

}  // namespace

std::shared_ptr<const DiracSystem> euler_poincare_system(const EulerPoincare& problem,
                                                         const EulerPoincareNames& names) {
  if (!problem.lagrangian == !problem.hamiltonian)
    throw std::invalid_argument(
        "euler_poincare_system: there are both a Lagrangian and a Hamiltonian, or none; expected "
        "one of the two.");
  const Index n = problem.algebra.dimension();
  const auto structure = std::make_shared<LiePoisson>(problem.algebra, problem.representation,
                                                      problem.sign, problem.group);
  const auto& M = structure->manifold();
  const Index d = structure->algebra().dimension() - n, size = M->tangent_dimension();
  const std::shared_ptr<const GeneratingFamily> family =
      problem.lagrangian ? reduced_lagrangian(M, n, d, problem.lagrangian)
                         : std::make_shared<MorseFamily>(
                               M, 0,
                               [h = problem.hamiltonian, n, d](const ExprVector& x,
                                                               const ExprVector&, const Expr& t) {
                                 return h(x.head(n), x.segment(n, d), t);
                               });
  DiracSystem::Exterior exterior;
  if (problem.input)
    exterior.source = [input = problem.input, n, d, size](const ExprVector& x, const ExprVector&,
                                                          const ExprVector& alpha, const Expr& t) {
      ExprVector source = ExprVector::Zero(2 * size);
      source.head(n) = input(x.head(n), x.segment(n, d), alpha.head(n), t);
      return source;
    };
  if (problem.constraint) {
    exterior.constraint_count = static_cast<Index>(problem.constraint_names.size());
    exterior.constraint = [g = problem.constraint, n, d](const ExprVector& x, const ExprVector&,
                                                         const ExprVector& alpha, const Expr& t) {
      return g(x.segment(n, d), alpha.head(n), t);
    };
  }

  ImplicitSystem::Names words{names.coordinates, {}, {}};
  for (Index i = 0; i < size; ++i) words.equations.push_back("equation[" + std::to_string(i) + "]");
  for (Index i = 0; i < family->parameter_size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    const std::string xi =
        place < names.velocities.size() ? names.velocities[place] : "xi[" + std::to_string(i) + "]";
    words.auxiliary.push_back(xi);
    words.equations.push_back("dE/d" + xi);
  }
  const Index m = exterior.constraint_count;
  for (Index a = 0; a < m; ++a) {
    words.auxiliary.push_back(m == 1 ? "lambda" : "lambda[" + std::to_string(a) + "]");
    words.equations.push_back(problem.constraint_names[static_cast<std::size_t>(a)]);
  }
  return std::make_shared<DiracSystem>(structure, family, std::move(exterior), std::move(words));
}

}  // namespace courant
