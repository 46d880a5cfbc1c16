#include "courant/integrators/certificate/local_formulation.hpp"

#include <algorithm>

#include "courant/core/expressions/derivative.hpp"
#include "courant/structures/blocks.hpp"

namespace courant {

namespace {

// F with each tangent block r replaced by Bᵀr and then `zeros` (per equation that is lost).
ExprVector with_reduced_blocks(const ImplicitSystem& system, const LinearMap<Expr>& basis,
                               const ExprVector& F, bool zeros) {
  if (basis.rows() == basis.cols()) return F;
  return with_blocks_in_basis(F, basis.entries(), system.tangent_blocks(),
                              zeros ? basis.rows() : basis.cols());
}

// Which combination of a tangent block stands in which of its equations is up to the basis or, away from
// its origin, to the chart: on curved spaces each is differentiated as often as any of the block.
std::vector<int> without_basis(const ImplicitSystem& system, const LinearMap<Expr>& basis,
                               std::vector<int> differentiations) {
  const Manifold& M = *system.manifold();
  if (M.dimension() == M.ambient_dimension() || differentiations.empty()) return differentiations;
  for (Index b = 0; b < system.tangent_blocks(); ++b) {
    const auto first = differentiations.begin() + b * basis.rows();
    const auto last = first + basis.rows();
    std::fill(first, last, *std::max_element(first, last));
  }
  return differentiations;
}

}  // namespace

ExprVector reduced_equations(const ImplicitSystem& system, const LinearMap<Expr>& basis,
                             const ExprVector& F) {
  return with_reduced_blocks(system, basis, F, false);
}

LocalFormulation::LocalFormulation(const Graph& graph, const ImplicitSystem& system,
                                   const ExprVector& x0, const LinearMap<Expr>& basis,
                                   const Expr& t, const std::vector<int>& differentiations) {
  const Manifold& M = *system.manifold();
  const std::vector<int> counts = without_basis(system, basis, differentiations);
  const int order = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  for (int j = 0; j <= order + 1; ++j)
    xi.push_back(
        graph.variables("xi" + std::string(static_cast<std::size_t>(j), '\''), M.dimension()));
  for (int j = 0; j <= order; ++j)
    z.push_back(graph.variables("z" + std::string(static_cast<std::size_t>(j), '\''),
                                system.auxiliary_size()));
  x = M.chart(x0, basis, xi[0]);
  v = M.coframe(x) * tangent(x, xi[0], xi[1]);

  const ExprVector F = with_reduced_blocks(system, basis, system.residual(x, v, z[0], t), true);
  std::vector<Expr> collected(F.begin(), F.end());
  for (Index i = 0; i < F.size(); ++i) source.push_back(i);
  ExprVector derivative = F;
  for (int j = 1; j <= order; ++j) {
    // d/dt along the jets: every variable of order below j moves with the next one.
    std::vector<Expr> variables, rates;
    const auto moves = [&](const ExprVector& from, const ExprVector& to) {
      variables.insert(variables.end(), from.begin(), from.end());
      rates.insert(rates.end(), to.begin(), to.end());
    };
    for (int k = 0; k <= j; ++k)
      moves(xi[static_cast<std::size_t>(k)], xi[static_cast<std::size_t>(k) + 1]);
    for (int k = 0; k < j; ++k)
      moves(z[static_cast<std::size_t>(k)], z[static_cast<std::size_t>(k) + 1]);
    if (!t.is_constant()) {
      variables.push_back(t);
      rates.push_back(1.0);
    }
    const auto size = static_cast<Index>(variables.size());
    derivative = tangent(derivative, Eigen::Map<ExprVector>(variables.data(), size),
                         Eigen::Map<ExprVector>(rates.data(), size));
    for (Index i = 0; i < F.size(); ++i) {
      if (counts[static_cast<std::size_t>(i)] < j) continue;
      collected.push_back(derivative[i]);
      source.push_back(i);
    }
  }
  equations = Eigen::Map<ExprVector>(collected.data(), static_cast<Index>(collected.size()));
}

ExprVector LocalFormulation::nonzero_equations() const {
  std::vector<Expr> kept;
  for (const Expr& equation : equations)
    if (!equation.is_constant() || equation.value() != 0.0) kept.push_back(equation);
  return Eigen::Map<ExprVector>(kept.data(), static_cast<Index>(kept.size()));
}

LinearMap<Expr> basis_variables(const Graph& graph, const Manifold& manifold) {
  const Index rows = manifold.tangent_dimension();
  const Index cols = manifold.dimension();
  if (rows == cols) return LinearMap<Expr>::identity(rows);
  const ExprVector entries = graph.variables("basis", rows * cols);
  return ExprMatrix(Eigen::Map<const ExprMatrix>(entries.data(), rows, cols));
}

ExprVector basis_parameters(const LinearMap<Expr>& basis) { return basis.entries().reshaped(); }

}  // namespace courant
