#include "courant/running/solved_unknowns.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"

namespace courant {
namespace {

// A zero of the equation in the one unknown; nothing, and z as it was, where none is found.
bool solve(const Function& equation, VectorXd& z, Index unknown) {
  constexpr int most_steps = 50;
  constexpr double places[] = {0.0, 1.0, -1.0, 0.1, -0.1, 10.0, -10.0};
  const double before = z[unknown];
  for (const double place : places) {
    z[unknown] = place;
    for (int step = 0; step < most_steps; ++step) {
      const double value = equation({z})[0], slope = equation.jacobian({z})(0, unknown);
      if (value == 0.0) return true;
      const double change = value / slope;
      if (!std::isfinite(change)) break;
      z[unknown] -= change;
      if (std::fabs(change) <= 1e-14 * std::fabs(z[unknown])) return true;
    }
  }
  z[unknown] = before;
  return false;
}

}  // namespace

VectorXd solved_unknowns(const ImplicitSystem& system, const State& guess,
                         std::vector<Index> open) {
  Graph graph;
  const ExprVector v = graph.variables("v", system.manifold()->tangent_dimension()),
                   z = graph.variables("z", system.auxiliary_size());
  const ExprVector F = system.residual(constants(guess.x), v, z, Expr(guess.t));
  const std::vector<bool> has_velocity = each_depends(F, v);
  // Which of the open unknowns each equation contains.
  std::vector<std::vector<Index>> contained(static_cast<std::size_t>(F.size()));
  for (const Index unknown : open) {
    const std::vector<bool> with = each_depends(F, z.segment(unknown, 1));
    for (std::size_t e = 0; e < contained.size(); ++e)
      if (with[e]) contained[e].push_back(unknown);
  }
  VectorXd found = guess.z;
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (std::size_t e = 0; e < contained.size(); ++e) {
      if (has_velocity[e] || contained[e].size() != 1) continue;
      const Index unknown = contained[e].front();
      const Function equation("equation", {{"z", z}}, ExprVector{{F[static_cast<Index>(e)]}},
                              {.differentiate = {"z"}});
      contained[e].clear();
      if (!solve(equation, found, unknown)) continue;
      is_new = true;
      for (auto& unknowns : contained) std::erase(unknowns, unknown);
    }
  }
  return found;
}

}  // namespace courant
