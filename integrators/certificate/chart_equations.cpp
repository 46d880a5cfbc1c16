#include "courant/integrators/certificate/chart_equations.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"

namespace courant {

ChartEquations::ChartEquations(std::shared_ptr<const ImplicitSystem> system)
    : system_(std::move(system)) {
  if (!system_) throw std::invalid_argument("ChartEquations::ChartEquations: system is null.");
  const Manifold& M = *system_->manifold();
  Graph graph;
  const ExprVector origin = graph.variables("x0", M.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, M);
  const ExprVector time = ExprVector::Constant(1, graph.variable("t"));
  const LocalFormulation local(
      graph, *system_, origin, basis, time[0],
      std::vector<int>(static_cast<std::size_t>(system_->equation_count()), 0));
  const std::vector<Function::Input> inputs = {{"xi", local.xi[0]},
                                               {"xi'", local.xi[1]},
                                               {"z", local.z[0]},
                                               {"x0", origin},
                                               {"basis", basis_parameters(basis)},
                                               {"t", time}};
  equations_ = Function("F", inputs, local.equations, {.differentiate = {"xi", "xi'", "z"}});
  state_ = Function("state", inputs, joined(local.x, local.v), {.differentiate = {"xi", "xi'"}});

  const SparseExprMatrix d_equations =
      jacobian(local.equations, joined(local.xi[0], local.xi[1], local.z[0]));
  constant_jacobian_ = std::all_of(d_equations.values.begin(), d_equations.values.end(),
                                   [](const Expr& entry) { return entry.is_constant(); });
  const Subgraph formulas(local.equations);
  exponentials_ =
      std::any_of(formulas.nodes().begin(), formulas.nodes().end(), [&](std::uint32_t index) {
        const Op op = formulas.graph().node(index).op;
        return op == Op::exp || op == Op::sinh || op == Op::cosh;
      });
  if (exponentials_)
    of_rates_ = Exponentials("F",
                             {{"rates", joined(local.xi[1], local.z[0])},
                              {"xi", local.xi[0]},
                              {"x0", origin},
                              {"basis", basis_parameters(basis)},
                              {"t", time}},
                             local.equations);
  depends_on_time_ = depends(local.equations, time);
}

}  // namespace courant
