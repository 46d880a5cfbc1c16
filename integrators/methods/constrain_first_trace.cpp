#include "courant/integrators/methods/constrain_first_trace.hpp"

#include <algorithm>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"
#include "courant/integrators/step/step_names.hpp"

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

// The derivatives that the equations contain, (ξ', ξ'', …, z, z', …).
struct Derivatives {
  // `jet`: Taylor coefficients as those of Prolongation; 0 for what it does not have.
  Derivatives(const LocalFormulation& local, const ExprVector& equations, const VectorXd& jet,
              const StepNames& called) {
    const auto [tangents, orders] = contained_jets(local, equations);
    const Index n = local.xi[0].size(), m = local.z[0].size();
    has_open_ones = tangents > 2 || orders > 1;
    std::vector<ExprVector> parts(local.xi.begin() + 1, local.xi.begin() + tangents);
    parts.insert(parts.end(), local.z.begin(), local.z.begin() + orders);
    symbols = joined(parts);
    values = VectorXd::Zero(symbols.size());
    const auto add = [&](Index count, Index place, double factorial, JetRole role) {
      if (place + count <= jet.size())
        values.segment(std::ssize(roles), count) = factorial * jet.segment(place, count);
      roles.resize(roles.size() + static_cast<std::size_t>(count), role);
    };
    double factorial = 1.0;
    for (Index k = 1; k < tangents; ++k) {
      factorial *= static_cast<double>(k);
      add(n, n + (k - 1) * (n + m), factorial, k == 1 ? JetRole::asked_for : JetRole::carried);
    }
    factorial = 1.0;
    for (Index k = 1; k < tangents; ++k) append(names, called.tangent("", k));
    for (Index k = 0; k < orders; ++k) {
      append(names, called.auxiliary(k));
      factorial *= static_cast<double>(std::max<Index>(k, 1));
      add(m, 2 * n + k * (n + m), factorial, k == 0 ? JetRole::asked_for : JetRole::may_be_held);
    }
  }

  ExprVector symbols;
  std::vector<std::string> names;
  VectorXd values;
  std::vector<JetRole> roles;
  bool has_open_ones;
};

// Of more derivatives nothing is left out: matrices would be dense. Large systems are flat, and elimination
// sees what is open there.
constexpr Index kManyDerivatives = 200;

std::vector<std::string> chosen_names(const std::vector<std::string>& names,
                                      const std::vector<Index>& places) {
  std::vector<std::string> result;
  for (const Index place : places) result.push_back(names[static_cast<std::size_t>(place)]);
  return result;
}

}  // namespace

// S_f without what is open there.
void ConstrainFirst::Trace::describe(const ConstrainFirst& method, const LocalFormulation& local) {
  const StepNames called(*method.system());
  constraints = local.nonzero_equations();
  constraint_names = called.equations(local);
  const ConstraintLadder& ladder = *method.ladder_;
  const Derivatives y(local, constraints, ladder.jet, called);
  if (method.open_) {
    open = *method.open_;
  } else if (method.gauge_dimension_ == 0 && y.has_open_ones &&
             y.symbols.size() <= kManyDerivatives) {
    const Function F(
        "open derivatives",
        {{"y", y.symbols}, {"xi", local.xi[0]}, {"x0", x0}, {"basis", basis_entries}, {"t", t}},
        constraints, {.differentiate = {"y"}});
    const LinearMap<double> B = method.system()->manifold()->tangent_basis(ladder.point.x);
    open = open_jets(F,
                     {y.values, VectorXd::Zero(local.xi[0].size()), ladder.point.x,
                      B.entries().reshaped(), VectorXd::Constant(1, ladder.point.t)},
                     y.roles);
  }
  std::vector<Index> left;
  for (Index i = 0; i < constraints.size(); ++i)
    if (!std::ranges::binary_search(open.equations, i)) left.push_back(i);
  step.left_out = chosen_names(constraint_names, open.equations);
  step.held = chosen_names(y.names, open.unknowns);
  constraint_names = chosen_names(constraint_names, left);
  constraints = substitute(ExprVector(constraints(left)), y.symbols(open.unknowns),
                           ExprVector::Zero(std::ssize(open.unknowns)));
}

MovingConormals::Formulas ConstrainFirst::Trace::conormals() const {
  return MovingConormals::trace(step.graph, constraints, jets, dimension, codimension,
                                {{"x0", x0}, {"basis", basis_entries}, {"t", t}}, conormal_sizes);
}

ConstrainFirst::Trace::Trace(const ConstrainFirst& method) {
  const ImplicitSystem& S = *method.system();
  const DiscretizationMap& map = *method.map_;
  const Manifold& M = *S.manifold();
  const Index n = dimension = M.dimension(), d = codimension = method.codimension_;
  const Graph& graph = step.graph;
  conormal_sizes = method.projector_->conormal_sizes();
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
  describe(method, local);
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
