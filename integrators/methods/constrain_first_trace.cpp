#include "courant/integrators/methods/constrain_first_trace.hpp"

#include <algorithm>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"
#include "courant/integrators/step/redundant_equations.hpp"
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
  // `jet`: Taylor coefficients as those of Prolongation; 0 for what it does not have. `of_z`: the role of z.
  Derivatives(const LocalFormulation& local, const ExprVector& equations, const VectorXd& jet,
              const StepNames& called, JetRole of_z) {
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
      add(m, 2 * n + k * (n + m), factorial, k == 0 ? of_z : JetRole::may_be_held);
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
// Of more, ranks of all equations of S_f take seconds.
constexpr Index kManyUnknowns = 500;

// Numbers from 0 to count that are not in a list, which ascends.
std::vector<Index> complement(const std::vector<Index>& list, Index count) {
  std::vector<Index> result;
  for (Index i = 0; i < count; ++i)
    if (!std::ranges::binary_search(list, i)) result.push_back(i);
  return result;
}

// The equation of the system that each of the equations comes from which are not the constant 0.
std::vector<Index> nonzero_sources(const LocalFormulation& local) {
  std::vector<Index> result;
  for (Index i = 0; i < local.equations.size(); ++i)
    if (!local.equations[i].is_constant(0.0))
      result.push_back(local.source[static_cast<std::size_t>(i)]);
  return result;
}

// The equations of a system that its ladder found in a dependence, but for those of the structure, which give
// velocities.
std::vector<Index> equations_in_dependences(const ImplicitSystem& system,
                                            const ConstraintLadder& ladder) {
  const Index of_structure = system.tangent_blocks() * system.manifold()->tangent_dimension();
  std::vector<Index> result;
  for (const Combination& dependence : ladder.redundancies)
    for (const Combination::Term& term : dependence.terms)
      if (term.equation >= of_structure) result.push_back(term.equation);
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<std::string> chosen_names(const std::vector<std::string>& names,
                                      const std::vector<Index>& places) {
  std::vector<std::string> result;
  for (const Index place : places) result.push_back(names[static_cast<std::size_t>(place)]);
  return result;
}

}  // namespace

// What steps can do without.
ConstrainFirstScheme::Omissions ConstrainFirstTrace::omissions(
    const ConstrainFirstScheme& scheme, const LocalFormulation& local) const {
  const ImplicitSystem& S = *scheme.system;
  const ConstraintLadder& ladder = *scheme.ladder;
  Omissions result;
  if (scheme.gauge_dimension() > 0) return result;
  const StepNames called(S);
  const LinearMap<double> B = S.manifold()->tangent_basis(ladder.point.x);
  const std::vector<VectorXd> at_point = {ladder.point.x, B.entries().reshaped(),
                                          VectorXd::Constant(1, ladder.point.t)};
  const std::vector<Function::Input> of_point = {{"x0", x0}, {"basis", basis_entries}, {"t", t}};
  const auto together = [](auto first, const auto& rest) {
    first.insert(first.end(), rest.begin(), rest.end());
    return first;
  };

  const ExprVector& xi = local.xi[0];
  const VectorXd origin = VectorXd::Zero(xi.size());
  const Derivatives all(local, constraints, ladder.jet, called, JetRole::asked_for);
  const std::vector<Index> named = equations_in_dependences(S, ladder);
  if (!scheme.keeps_all_equations && !named.empty() &&
      xi.size() + all.symbols.size() <= kManyUnknowns) {
    const Function F(
        "dependences",
        together(std::vector<Function::Input>{{"y", joined(xi, all.symbols)}}, of_point),
        constraints, {.differentiate = {"y"}});
    VectorXd y(xi.size() + all.values.size());
    y << origin, all.values;
    const MatrixXd J = F.jacobian(together(std::vector<VectorXd>{y}, at_point));
    if (J.allFinite()) result.redundant = redundant_rows(J, nonzero_sources(local), named);
  }

  const ExprVector kept = constraints(complement(result.redundant, constraints.size()));
  // Where a constraint is left out, a multiplier is open.
  const Derivatives y(local, kept, ladder.jet, called,
                      result.redundant.empty() ? JetRole::asked_for : JetRole::held_where_open);
  if ((y.has_open_ones || !result.redundant.empty()) && y.symbols.size() <= kManyDerivatives) {
    const Function F("open derivatives",
                     together(std::vector<Function::Input>{{"y", y.symbols}, {"xi", xi}}, of_point),
                     kept, {.differentiate = {"y"}});
    result.open =
        open_jets(F, together(std::vector<VectorXd>{y.values, origin}, at_point), y.roles);
  }
  result.held = VectorXd::Zero(std::ssize(result.open.unknowns));
  for (Index i = 0; i < result.held.size(); ++i) {
    const Index place = result.open.unknowns[static_cast<std::size_t>(i)];
    if (y.roles[static_cast<std::size_t>(place)] == JetRole::held_where_open)
      result.held[i] = y.values[place];
  }
  return result;
}

// S_f without what follows from the rest, or is open there.
void ConstrainFirstTrace::describe(const ConstrainFirstScheme& scheme,
                                   const LocalFormulation& local,
                                   const std::optional<Omissions>& known) {
  const StepNames called(*scheme.system);
  constraints = local.nonzero_equations();
  constraint_names = called.equations(local);
  omitted = known ? *known : omissions(scheme, local);
  step.redundant = chosen_names(constraint_names, omitted.redundant);
  redundant = constraints(omitted.redundant);
  const std::vector<Index> kept = complement(omitted.redundant, constraints.size());
  constraint_names = chosen_names(constraint_names, kept);
  constraints = constraints(kept).eval();

  const Derivatives y(local, constraints, scheme.ladder->jet, called, JetRole::asked_for);
  const std::vector<Index> left = complement(omitted.open.equations, constraints.size());
  step.left_out = chosen_names(constraint_names, omitted.open.equations);
  constraint_names = chosen_names(constraint_names, left);
  step.held = chosen_names(y.names, omitted.open.unknowns);
  step.held_values.assign(omitted.held.begin(), omitted.held.end());
  open = y.symbols(omitted.open.unknowns);
  const auto with_held = [&](const ExprVector& of) {
    return substitute(of, open, constants(omitted.held));
  };
  const ExprVector tried = with_held(redundant);
  constraints = with_held(constraints(left));
  z = with_held(local.z[0]);
  // Where z is held, its place among the unknowns.
  held_z = {};
  for (Index i = 0; i < z.size(); ++i)
    if (z[i].is_constant()) held_z.push_back({i, z[i].value()});

  // What an unknown decides that no equation is left for cannot be tried.
  const Subgraph sought(constraints);
  std::vector<Expr> unknown;
  for (const ExprVector& jet : {y.symbols, z})
    for (const Expr& entry : jet)
      if (!entry.is_constant() && !sought.contains(entry)) unknown.push_back(entry);
  const std::vector<bool> is_open =
      each_depends(tried, Eigen::Map<const ExprVector>(unknown.data(), std::ssize(unknown)));
  std::vector<Index> tests;
  for (Index i = 0; i < tried.size(); ++i)
    if (!is_open[static_cast<std::size_t>(i)]) tests.push_back(i);
  redundant = tried(tests);
}

TransportedConormals::Formulas ConstrainFirstTrace::conormals() const {
  return TransportedConormals::trace(step.graph, constraints, jets, dimension, codimension,
                                     {{"x0", x0}, {"basis", basis_entries}, {"t", t}},
                                     conormal_sizes);
}

ConstrainFirstTrace::ConstrainFirstTrace(const ConstrainFirstScheme& scheme,
                                         const std::optional<Omissions>& known) {
  const ImplicitSystem& S = *scheme.system;
  const DiscretizationMap& map = *scheme.map;
  const Manifold& M = *S.manifold();
  const Index n = dimension = M.dimension(), d = codimension = scheme.codimension();
  const Graph& graph = step.graph;
  conormal_sizes = scheme.projector->conormal_sizes();
  x0 = graph.variables("x0", M.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, M);
  basis_entries = basis_parameters(basis);
  t = graph.variables("t", 1);
  const ExprVector h = graph.variables("h", 1);
  const ExprVector directions = graph.variables("W", n * d);
  const ExprVector mu = graph.variables("mu", d);
  const ExprMatrix W = scheme.fixed_directions.size() > 0
                           ? constants(scheme.fixed_directions)
                           : ExprMatrix(Eigen::Map<const ExprMatrix>(directions.data(), n, d));
  const ExprVector shift = W * mu;
  const LocalFormulation local(graph, S, x0, basis, t[0], scheme.ladder->differentiations);
  describe(scheme, local, known);
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

  step.name = scheme.name();
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
  step.eliminates = scheme.gauge_dimension() == 0;
  // ξ and μ are displacements of the state, ξ' its rate; the rest converges with them.
  step.elimination.never_zero = h;
  auto& coarseness = step.elimination.coarseness;
  coarseness.assign(static_cast<std::size_t>(y.size()), 1);
  std::fill_n(coarseness.begin(), 2 * n, 0);
  std::fill_n(coarseness.rbegin(), d, 0);

  projection = step;
  projection.name = scheme.name() + ", projection";
  near = graph.variables("near", M.ambient_dimension());
  const ExprVector along = M.tangent_projector(local.x) * ExprVector(basis * shift);
  const ExprVector distance = M.coframe(x0) * ExprVector(M.retract(local.x, along) - near);
  projection.inputs[4] = {"near", near};
  projection.input_names[4] = StepNames::each("near ", S.names().coordinates);
  projection.equations = joined({ExprVector(basis.transpose() * distance), constraints});
  projection.equation_names = names.tangent("projection of ", 0);
  append(projection.equation_names, constraint_names);
  projection.elimination.never_zero = {};
  projected = joined({local.x, local.v, z});

  s = graph.variables("s", M.tangent_dimension());
  shifted = M.retract(near, ExprVector(M.tangent_projector(near) * s));
  x = graph.variables("x", M.ambient_dimension());
  corrected = M.tangent_projector(near) * s + M.coframe(near) * ExprVector(x - x0);
}

}  // namespace courant
