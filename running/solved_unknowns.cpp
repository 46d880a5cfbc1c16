#include "courant/running/solved_unknowns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"

namespace courant {
namespace {

// Where unknowns are tried that nobody gave.
constexpr std::array kPlaces = {0.0, 1.0, -1.0, 0.1, -0.1, 10.0, -10.0};

// Whether a zero of the equation in the one unknown was found; z is as it was where none is.
bool solve(const Function& equation, VectorXd& z, Index unknown) {
  constexpr int most_steps = 50;
  const double before = z[unknown];
  for (const double place : kPlaces) {
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

// The residual of a system as a function of z, at x, v and t of a guess.
class UnknownEquations {
 public:
  UnknownEquations(const ImplicitSystem& system, const State& guess)
      : z_(graph_.variables("z", system.auxiliary_size())) {
    const ExprVector x = constants(guess.x), v = graph_.variables("v", guess.v.size());
    const ExprVector F = system.residual(x, v, z_, Expr(guess.t));
    has_velocity_ = each_depends(F, v);
    F_ = substitute(F, v, constants(guess.v));
    all_ = Function("equations", {{"z", z_}}, F_, {.differentiate = {"z"}});
  }

  bool have_values_at(const VectorXd& z) const { return all_({z}).allFinite(); }
  // With their derivatives.
  bool are_finite_at(const VectorXd& z) const {
    return have_values_at(z) && all_.jacobian({z}).allFinite();
  }

  // What is solved is open no longer.
  void solve_in(VectorXd& z, std::vector<Index>& open) const {
    // Which of the open unknowns each equation contains.
    std::vector<std::vector<Index>> contained(static_cast<std::size_t>(F_.size()));
    for (const Index unknown : open) {
      const std::vector<bool> with = each_depends(F_, z_.segment(unknown, 1));
      for (std::size_t e = 0; e < contained.size(); ++e)
        if (with[e]) contained[e].push_back(unknown);
    }
    for (bool is_new = true; is_new;) {
      is_new = false;
      for (std::size_t e = 0; e < contained.size(); ++e) {
        if (has_velocity_[e] || contained[e].size() != 1) continue;
        const Index unknown = contained[e].front();
        const Function equation("equation", {{"z", z_}}, ExprVector{{F_[static_cast<Index>(e)]}},
                                {.differentiate = {"z"}});
        contained[e].clear();
        if (!solve(equation, z, unknown)) continue;
        is_new = true;
        for (auto& unknowns : contained) std::erase(unknowns, unknown);
        std::erase(open, unknown);
      }
    }
  }

 private:
  Graph graph_;
  ExprVector z_, F_;
  std::vector<bool> has_velocity_;
  Function all_;
};

}  // namespace

std::optional<VectorXd> defined_unknowns(const ImplicitSystem& system, const State& guess,
                                         std::vector<Index> open) {
  const UnknownEquations equations(system, guess);
  VectorXd z = guess.z;
  if (equations.are_finite_at(z)) return z;
  equations.solve_in(z, open);
  if (equations.are_finite_at(z)) return z;
  if (!equations.have_values_at(z)) return std::nullopt;
  VectorXd tried = z;
  for (const double place : std::span(kPlaces).subspan(1)) {  // 0 was the first that was tried
    // Each at another place, since differences may be under a root.
    for (std::size_t i = 0; i < open.size(); ++i)
      tried[open[i]] = place * (1.0 + 0.1 * static_cast<double>(i));
    if (equations.are_finite_at(tried)) return tried;
  }
  return z;
}

}  // namespace courant
