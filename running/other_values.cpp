#include "courant/running/other_values.hpp"

#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"

namespace courant {
namespace {

constexpr Index kMostTried = 50;
// Values that differ by less, next to their size, are one.
constexpr double kDifferentValue = 1e-6;
// A residual that is linear leaves this part of its size, round-off, at the middle of two points.
constexpr double kLinear = 1e-12;

// F(z) where the state is what it is.
Function equations_of_unknowns(const ImplicitSystem& system, const State& at) {
  const Graph graph;
  const ExprVector z = graph.variables("z", at.z.size());
  return Function("equations", {{"z", z}},
                  system.residual(constants(at.x), constants(at.v), z, Expr(at.t)));
}

// Whether the residual F(z) is no linear function on the way from z to -z in entry i.
bool is_nonlinear(const Function& F, const VectorXd& z, Index i) {
  const auto residual = [&](double value) {
    VectorXd there = z;
    there[i] = value;
    return F({there});
  };
  const VectorXd here = residual(z[i]), opposite = residual(-z[i]), middle = residual(0.0);
  if (!middle.allFinite() || !opposite.allFinite()) return false;
  const double size =
      here.cwiseAbs().maxCoeff() + opposite.cwiseAbs().maxCoeff() + middle.cwiseAbs().maxCoeff();
  return (here + opposite - 2.0 * middle).cwiseAbs().maxCoeff() > kLinear * size;
}

}  // namespace

std::vector<Movement> other_values(const Experiment& experiment, const ConstraintLadder& ladder) {
  const auto& system = experiment.model.system;
  const State& at = ladder.point;
  std::vector<Movement> others;
  if (ladder.verdict != Verdict::regular || at.z.size() > kMostTried || at.x.size() > kMostTried)
    return others;
  ConstraintAlgorithm::Options options;
  options.max_level = 0;
  const ConstraintAlgorithm solve(options);
  std::optional<Function> equations;  // of z, compiled for the first unknown that is asked about
  // Unknowns that have names.
  for (Index i = 0; i < experiment.initial.z.given.size(); ++i) {
    if (experiment.initial.z.given[i] || at.z[i] == 0.0) continue;
    try {
      if (!equations) equations.emplace(equations_of_unknowns(*system, at));
      if (!is_nonlinear(*equations, at.z, i)) continue;
      InitialGuess guess{.t = at.t, .x = at.x, .v = at.v, .z = at.z};
      guess.z[i] = -at.z[i];
      guess.hold_x.resize(static_cast<std::size_t>(at.x.size()));
      std::iota(guess.hold_x.begin(), guess.hold_x.end(), Index{0});
      const ConstraintLadder other = solve.run(system, guess);
      if (other.levels.empty() || !other.levels.back().is_solved) continue;
      const double value = other.point.z[i], size = std::fabs(value) + std::fabs(at.z[i]);
      if (std::isfinite(value) && std::fabs(value - at.z[i]) > kDifferentValue * size)
        others.push_back({system->names().auxiliary[static_cast<std::size_t>(i)], at.z[i], value});
    } catch (const std::runtime_error&) {  // nothing is found there
    } catch (const std::domain_error&) {
    }
  }
  return others;
}

void tell_of_start(const Experiment& experiment, const ConsistentStart& start,
                   LadderReport& report) {
  report.is_impulse = start.is_impulse;
  report.choices = other_values(experiment, start);
}

ConstraintFormulas formulas_of_start(const Experiment& experiment, const ConsistentStart& start) {
  return constraint_formulas(*experiment.model.system, start,
                             experiment.model.vocabulary.numbers());
}

LadderReport report_of_start(const Experiment& experiment, const ConsistentStart& start) {
  LadderReport report =
      ladder_report(start, *experiment.model.system, formulas_of_start(experiment, start));
  tell_of_start(experiment, start, report);
  return report;
}

}  // namespace courant
