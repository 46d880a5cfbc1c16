#include "courant/integrators/methods/verlet_trace.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"
#include "courant/integrators/maps/adjoint.hpp"
#include "courant/integrators/methods/verlet_halves.hpp"
#include "courant/integrators/step/step_names.hpp"

namespace courant {
namespace {

// Whether these are the same numbers wherever they are looked at, though they may be written otherwise.
bool are_equal(const ExprVector& a, const ExprVector& b, const ExprVector& variables) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> number(0.5, 1.5);
  constexpr double round_off = 1e-12;
  for (int trial = 0; trial < 2; ++trial) {
    const ExprVector at = constants(
        VectorXd(VectorXd::NullaryExpr(variables.size(), [&] { return number(generator); })));
    const VectorXd difference = values(substitute(ExprVector(a - b), variables, at));
    if (!(difference.size() == 0 || difference.cwiseAbs().maxCoeff() <= round_off)) return false;
  }
  return true;
}

}  // namespace

VerletTrace::VerletTrace(const ImplicitSystem& system, const ConstraintLadder& ladder,
                         const std::shared_ptr<const DiscretizationMap>& map,
                         const std::string& name, Unknowns kind) {
  const ImplicitSystem& S = system;
  const DiscretizationMap& R = *map;
  const Adjoint adjoint(map);
  const Manifold& M = *S.manifold();
  const Index n = M.dimension(), m = S.auxiliary_size();
  const bool by_velocities = kind == Unknowns::velocities;
  codimension = M.dimension() - ladder.degrees_of_freedom;
  multipliers = m;
  step.name = name;
  const Graph& graph = step.graph;
  const ExprVector x0 = graph.variables("x0", M.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, M);
  const ExprVector h = graph.variables("h", 1), t = graph.variables("t", 1);
  const ExprVector w = graph.variables("w", n);
  const ExprVector z_first = graph.variables("lambda", m), z_second = graph.variables("mu", m);
  const bool is_free = codimension == 0;
  const LocalFormulation local(
      graph, S, x0, basis, t[0],
      is_free ? std::vector<int>(static_cast<std::size_t>(S.equation_count()), 0)
              : ladder.differentiations);

  const Expr half = 0.5 * h[0], rate = 2.0 / h[0], at_end = t[0] + h[0];
  const auto time = [&](double part) {
    return part == 0.0 ? t[0] : Expr(t[0] + Expr(part) * h[0]);
  };
  const auto first = R.from_start(x0, by_velocities ? ExprVector(half * w) : ExprVector(basis * w));
  const ExprVector x1 =
      by_velocities ? ExprVector(first.end + half * local.xi[0]) : ExprVector(local.x);
  const auto second = adjoint.inverse(first.end, x1);
  const ExprVector v_first = by_velocities ? w : ExprVector(first.v * rate),
                   v_second = by_velocities ? local.xi[0] : ExprVector(second.v * rate);
  const auto equations = [&](const ExprVector& x, const ExprVector& v, const ExprVector& z,
                             const Expr& instant) {
    return reduced_equations(S, basis, S.residual(x, v, z, instant));
  };
  const ExprVector F_first = equations(first.x, v_first, z_first, time(kHalf * R.stage_time()));
  const ExprVector F_second =
      equations(second.x, v_second, z_second, time(kHalf + kHalf * adjoint.stage_time()));
  // For an end that does not move with the first half.
  const ExprVector F_of_end =
      equations(adjoint.inverse(first.end, local.x).x, v_second, z_second, at_end);
  const std::vector<Index> kept = equations_of_motion(S, basis, F_first, F_of_end, w);

  const StepNames names(S);
  std::vector<ExprVector> unknowns = {w, local.xi[0]};
  std::vector<std::string> called =
      by_velocities ? names.tangent("in first half: ", 1) : names.tangent("half Δ", 0);
  append(called, by_velocities ? names.tangent("in second half: ", 1) : names.tangent("Δ", 0));
  ExprVector all = joined(ExprVector(F_first(kept)), ExprVector(F_second(kept)));
  std::vector<std::string> equation_names;
  const std::vector<std::string> named = names.equations(F_first.size());
  for (const char* half : {"first half: ", "second half: "})
    for (const Index i : kept) equation_names.push_back(half + named[static_cast<std::size_t>(i)]);
  if (!is_free) {
    const ExprVector on_M_f = local.nonzero_equations();
    for (std::size_t k = 1; k < local.xi.size(); ++k)
      if (k == 1 || depends(on_M_f, local.xi[k])) {
        unknowns.push_back(local.xi[k]);
        append(called, names.tangent("", static_cast<Index>(k)));
      }
    tangents = std::ssize(unknowns) - 1;
    for (std::size_t k = 0; k < local.z.size(); ++k)
      if (k == 0 || depends(on_M_f, local.z[k])) {
        unknowns.push_back(local.z[k]);
        append(called, names.auxiliary(static_cast<Index>(k)));
      }
    consistent_inputs = {
        {"y", joined(std::vector<ExprVector>(unknowns.begin() + 1, unknowns.end()))},
        {"x0", x0},
        {"basis", basis_parameters(basis)},
        {"t", t}};
    consistent = on_M_f;
    found = joined(local.x, local.v, local.z[0]);
    // In the chart at x₀, or in that at x₁, which there is as good.
    const auto to_end = [&](const ExprVector& formula) {
      const ExprVector at_time = substitute(formula, t, ExprVector::Constant(1, at_end));
      return by_velocities
                 ? substitute(at_time, joined(x0, local.xi[0]), joined(x1, ExprVector::Zero(n)))
                 : at_time;
    };
    all = joined(all, to_end(on_M_f));
    for (const std::string& name : names.equations(local))
      equation_names.push_back("at the end: " + name);
    ended = joined(x1, to_end(local.v), local.z[0]);
  } else {
    ended = joined(x1, v_second, z_second);
  }
  unknowns.push_back(z_first);
  unknowns.push_back(z_second);
  append(called, StepNames::each("first ", S.names().auxiliary));
  append(called, StepNames::each("second ", S.names().auxiliary));
  const ExprVector y = joined(unknowns);
  step.inputs = {{"y", y}, {"x0", x0}, {"basis", basis_parameters(basis)}, {"h", h}, {"t", t}};
  step.input_names = {std::move(called), S.names().coordinates, names.basis(), {"h"}, {"t"}};
  step.equations = all;
  step.equation_names = std::move(equation_names);
  step.elimination.never_zero = h;
  step.elimination.is_regular = true;  // the ladder is
  // Multipliers converge with the displacements, of which they may be round-off.
  step.elimination.coarseness.assign(static_cast<std::size_t>(y.size()), 1);
  std::fill_n(step.elimination.coarseness.begin(), (is_free ? 2 : 3) * n, 0);
  advanced = joined(first.x, v_first, z_first, first.end, second.x, v_second, z_second);
}

bool VerletTrace::moves_by_sums(const std::shared_ptr<const DiscretizationMap>& map) {
  const Manifold& M = *map->manifold();
  const Index n = M.dimension();
  if (!M.has_identity_frame() || n != M.ambient_dimension() || !map->has_inverse()) return false;
  const Graph graph;
  const ExprVector x0 = graph.variables("x0", n), w = graph.variables("w", n),
                   middle = graph.variables("middle", n), end = graph.variables("end", n);
  const auto first = map->from_start(x0, w);
  const auto second = Adjoint(map).inverse(middle, end);
  return are_equal(first.v, w, joined(x0, w)) && are_equal(first.end, x0 + w, joined(x0, w)) &&
         are_equal(second.v, end - middle, joined(middle, end));
}

// The equations of a half that tell v or z. The others are constraints, on positions, at x₀ and x₁.
std::vector<Index> VerletTrace::equations_of_motion(const ImplicitSystem& system,
                                                    const LinearMap<Expr>& basis,
                                                    const ExprVector& first,
                                                    const ExprVector& second,
                                                    const ExprVector& w) const {
  std::vector<Index> kept(static_cast<std::size_t>(first.size()));
  std::iota(kept.begin(), kept.end(), Index{0});
  if (codimension == 0) return kept;
  const Graph graph = w[0].graph();
  const Manifold& M = *system.manifold();
  const ExprVector x = graph.variables("x", M.ambient_dimension()),
                   v = graph.variables("v", M.tangent_dimension()),
                   z = graph.variables("z", system.auxiliary_size());
  const Expr t = graph.variable("t");
  const std::vector<bool> moves =
      each_depends(reduced_equations(system, basis, system.residual(x, v, z, t)), joined(v, z));
  const std::vector<bool> first_moves = each_depends(first, w),
                          second_moves = each_depends(second, w);
  std::erase_if(kept, [&](Index i) { return !moves[static_cast<std::size_t>(i)]; });
  const Index constraints = first.size() - std::ssize(kept);
  bool is_of_positions = 2 * constraints == codimension;
  for (std::size_t i = 0; i < moves.size(); ++i)
    is_of_positions &= moves[i] || (!first_moves[i] && !second_moves[i]);
  if (!is_of_positions)
    throw std::invalid_argument(
        "Verlet::Verlet: M_f has codimension " + std::to_string(codimension) + ", and there are " +
        std::to_string(constraints) +
        " constraints on positions; expected half as many constraints as the codimension: "
        "independent ones, on positions alone.");
  return kept;
}

}  // namespace courant
