#include "courant/integrators/constrain_first_trace.hpp"

#include "courant/core/derivative.hpp"
#include "courant/core/expr_vectors.hpp"
#include "courant/integrators/ladder/local_formulation.hpp"
#include "courant/integrators/step_names.hpp"

namespace courant {
namespace {

// How many of ξ, ξ', … (at least two) and of z, z', … (at least one) there are up to the last that
// the equations contain.
std::pair<Index, Index> contained_jets(const LocalFormulation& local, const ExprVector& equations) {
  const auto last = [&](const std::vector<ExprVector>& jets, std::size_t least) {
    std::size_t count = jets.size();
    while (count > least && !depends(equations, jets[count - 1])) --count;
    return static_cast<Index>(count);
  };
  return {last(local.xi, 2), last(local.z, 1)};
}

}  // namespace

ConstrainFirst::Trace::Trace(const ConstrainFirst& method) {
  const ImplicitSystem& S = *method.system();
  const DiscretizationMap& map = *method.map_;
  const Manifold& M = *S.manifold();
  const Index n = M.dimension(), d = method.codimension_;
  const Graph& graph = step.graph;
  x0 = graph.variables("x0", M.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, M);
  basis_entries = basis_parameters(basis);
  t = graph.variables("t", 1);
  const ExprVector h = graph.variables("h", 1);
  const ExprVector directions = graph.variables("W", n * d);
  const ExprVector mu = graph.variables("mu", d);
  const ExprMatrix W = method.fixed_directions_.size() > 0
                           ? constants(method.fixed_directions_)
                           : ExprMatrix(Eigen::Map<const ExprMatrix>(directions.data(), n, d));
  const ExprVector shift = W * mu;
  const LocalFormulation local(graph, S, x0, basis, t[0], method.differentiations_);
  constraints = local.nonzero_equations();
  const auto [tangents, orders] = contained_jets(local, constraints);
  blocks = tangents;
  std::vector<ExprVector> parts(local.xi.begin(), local.xi.begin() + blocks);
  parts.insert(parts.end(), local.z.begin(), local.z.begin() + orders);
  jets = joined(parts);
  auxiliaries = jets.size() - blocks * n;
  const ExprVector y = joined({jets, mu});

  const StepNames names(S);
  std::vector<std::string> unknowns = names.tangent("Δ", 0);
  for (Index k = 1; k < blocks; ++k) append(unknowns, names.tangent("", k));
  for (Index k = 0; k < orders; ++k) append(unknowns, names.auxiliary(k));
  append(unknowns, StepNames::numbered("mu", d));
  const std::vector<std::string> constraint_names = names.equations(local);

  step.name = method.name();
  const auto ends = map.forward(local.x, ExprVector(h[0] * local.v));
  const ExprVector moved = M.chart(x0, basis, shift);
  const ExprVector at_start = M.coframe(x0) * ExprVector(ends.first - moved);
  const ExprVector staged =
      substitute(constraints, t, ExprVector::Constant(1, t[0] + Expr(map.stage_time()) * h[0]));
  step.inputs = {{"y", y},          {"x0", x0}, {"basis", basis_entries},
                 {"W", directions}, {"h", h},   {"t", t}};
  step.input_names = {unknowns,      S.names().coordinates,
                      names.basis(), StepNames::numbered("W", n * d),
                      {"h"},         {"t"}};
  step.equations = joined({ExprVector(basis.transpose() * at_start), staged});
  step.equation_names = names.tangent("start of ", 0);
  append(step.equation_names, constraint_names);
  advanced = joined({ends.second, local.x, local.v});
  // Of what is not determined the solver takes the least change, in all unknowns.
  step.eliminates = method.gauge_dimension_ == 0;
  // ξ and μ are displacements of the state, ξ' its rate; the rest converges with them.
  step.elimination.never_zero = h;
  auto& coarseness = step.elimination.coarseness;
  coarseness.assign(static_cast<std::size_t>(y.size()), 1);
  std::fill_n(coarseness.begin(), 2 * n, 0);
  std::fill_n(coarseness.rbegin(), d, 0);

  projection = step;
  projection.name = method.name() + ", projection";
  near = graph.variables("near", M.ambient_dimension());
  const ExprVector along = M.tangent_projector(local.x) * ExprVector(basis * shift);
  const ExprVector distance = M.coframe(x0) * ExprVector(M.retract(local.x, along) - near);
  projection.inputs[4] = {"near", near};
  projection.input_names[4] = StepNames::each("near ", S.names().coordinates);
  projection.equations = joined({ExprVector(basis.transpose() * distance), constraints});
  projection.equation_names = names.tangent("projection of ", 0);
  append(projection.equation_names, constraint_names);
  projection.elimination.never_zero = {};
  projected = joined({local.x, local.v, local.z[0]});

  s = graph.variables("s", M.tangent_dimension());
  shifted = M.retract(near, ExprVector(M.tangent_projector(near) * s));
  x = graph.variables("x", M.ambient_dimension());
  corrected = M.tangent_projector(near) * s + M.coframe(near) * ExprVector(x - x0);
}

}  // namespace courant
