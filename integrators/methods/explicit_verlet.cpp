#include "courant/integrators/methods/explicit_verlet.hpp"

#include <string>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/maps/adjoint.hpp"

namespace courant {
namespace {

ExprVector chosen(const ExprVector& all, const std::vector<Index>& places) { return all(places); }

// Components of a vector field that are found one after the other, as those do that contain only what has been found.
class InTurn {
 public:
  // `field` contains `unknown`, of which component i is found by `found(i, field[i])`.
  template <class Found>
  static std::optional<ExprVector> solve(ExprVector field, const ExprVector& unknown,
                                         const Found& found) {
    ExprVector result(field.size());
    std::vector<Index> open(static_cast<std::size_t>(field.size()));
    for (Index i = 0; i < field.size(); ++i) open[static_cast<std::size_t>(i)] = i;
    while (!open.empty()) {
      const std::vector<bool> waits = each_depends(chosen(field, open), chosen(unknown, open));
      std::vector<Index> now, later;
      for (std::size_t k = 0; k < open.size(); ++k) (waits[k] ? later : now).push_back(open[k]);
      if (now.empty()) return std::nullopt;
      for (const Index i : now) result[i] = found(i, field[i]);
      const ExprVector values = chosen(result, now), symbols = chosen(unknown, now);
      const ExprVector rest = substitute(chosen(field, later), symbols, values);
      for (std::size_t k = 0; k < later.size(); ++k) field[later[k]] = rest[static_cast<Index>(k)];
      open = std::move(later);
    }
    return result;
  }
};

}  // namespace

std::optional<ExplicitVerlet> ExplicitVerlet::of(
    const VectorFieldFormulas& field, const std::shared_ptr<const DiscretizationMap>& map) {
  const Manifold& M = *map->manifold();
  const Index n = M.dimension(), m = field.system->auxiliary_size();
  const Adjoint adjoint(map);
  if (!field.is_explicit() || map->stage_time() != 0.0 || !VerletTrace::moves_by_sums(map))
    return std::nullopt;
  const ExprVector& x = field.inputs[1].variables;
  const ExprVector& time = field.inputs[3].variables;
  if (n == 0 || x[0].is_constant()) return std::nullopt;
  const Graph graph = x[0].graph();
  const ExprVector x0 = graph.variables("x0", n), w = graph.variables("w", n),
                   middle = graph.variables("middle", n), end = graph.variables("end", n),
                   h = graph.variables("h", 1), t = graph.variables("t", 1);
  const Expr half = 0.5 * h[0];

  const auto first = map->from_start(x0, w);
  const auto second = adjoint.inverse(middle, end);

  // Rows of the rate: ẋ, v, z. Here ẋ = v.
  const ExprVector v = field.rate.segment(n, n), z = field.rate.tail(m);
  const auto at = [&](const ExprVector& formula, const ExprVector& point, const Expr& instant) {
    return substitute(formula, joined(x, time), joined(point, ExprVector::Constant(1, instant)));
  };
  const Expr at_end = t[0] + h[0];
  const ExprVector v_first = at(v, first.x, t[0]), v_second = at(v, second.x, at_end);

  // What the end of a step says of the beginning of the next one.
  ExplicitVerlet result;
  const ExprVector v_start = at(v, x0, t[0]), v_end = at(v, end, at_end);
  for (Index i = 0; i < n; ++i)
    if (v_first[i] == v_start[i] && v_second[i] == v_end[i]) result.handed_on.push_back(i);
  const auto count = static_cast<Index>(result.handed_on.size());
  const ExprVector r0 = graph.variables("r0", count), r1 = graph.variables("r1", count);
  const auto with = [&](ExprVector formula, const ExprVector& r) {
    for (Index k = 0; k < count; ++k) formula[result.handed_on[static_cast<std::size_t>(k)]] = r[k];
    return formula;
  };

  ExprVector rate = v_first;  // in the first half, as it is found
  const auto moved = InTurn::solve(with(v_first, r0), w, [&](Index i, const Expr& velocity) {
    rate[i] = velocity;
    return Expr(half * velocity);
  });
  if (!moved) return std::nullopt;
  const ExprVector at_middle = x0 + *moved;

  // x₁ for what moves with one velocity in both halves: x₀ + h v.
  const auto ends = [&](ExprVector field_there, ExprVector& found) {
    found = field_there;
    return InTurn::solve(std::move(field_there), end, [&](Index i, const Expr& velocity) {
      found[i] = velocity;
      return velocity == rate[i] ? Expr(x0[i] + h[0] * velocity)
                                 : Expr(at_middle[i] + half * velocity);
    });
  };
  ExprVector rate_after, rate_known;
  const auto x1 = ends(substitute(v_second, middle, at_middle), rate_after);
  if (!x1) return std::nullopt;
  const auto x1_known = ends(with(substitute(v_second, middle, at_middle), r1), rate_known);
  if (!x1_known) return std::nullopt;

  result.beginning = {.inputs = {{"x0", x0}, {"t", t}},
                      .outputs = chosen(v_start, result.handed_on)};
  result.step = {.inputs = {{"x0", x0}, {"r", r0}, {"h", h}, {"t", t}},
                 .outputs = joined(*x1, chosen(rate_after, result.handed_on))};
  const auto there = [&](const ExprVector& formula) {
    return substitute(formula, joined(middle, end), joined(at_middle, *x1_known));
  };
  const ExprVector z_first = substitute(at(z, first.x, t[0]), w, *moved);
  const ExprVector z_second = there(at(z, second.x, at_end));
  const std::vector<Function::Input> inputs = {
      {"x0", x0}, {"r0", r0}, {"r1", r1}, {"h", h}, {"t", t}};
  result.stages = {.inputs = inputs,
                   .outputs = joined(substitute(first.x, w, *moved), rate, z_first, at_middle,
                                     there(second.x), rate_known, z_second)};
  result.ending = {.inputs = inputs, .outputs = joined(rate_known, z_second)};
  return result;
}

std::optional<ExplicitVerlet> ExplicitVerlet::of(const VerletTrace& trace,
                                                 const Manifold& manifold) {
  auto multipliers = VerletMultipliers::of(trace, manifold);
  if (!multipliers) return std::nullopt;
  const std::vector<Function::Input>& point = multipliers->step.inputs;
  const auto with_nothing = [](Function::Formulas formulas, std::vector<std::string> names) {
    for (std::string& name : names)
      formulas.inputs.insert(formulas.inputs.begin() + 1, {std::move(name), ExprVector(0)});
    return formulas;
  };
  ExplicitVerlet result{
      .handed_on = {},
      .beginning = {.inputs = {point.front(), point[2]}, .outputs = ExprVector(0)},
      .step = with_nothing(multipliers->step, {"r"}),
      .stages = with_nothing(multipliers->stages, {"r1", "r0"}),
      .ending = with_nothing(multipliers->ending, {"r1", "r0"})};
  result.multipliers = std::move(multipliers);
  return result;
}

}  // namespace courant
