#include "courant/running/other_values.hpp"

#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/ladder_in_units.hpp"
#include "courant/integrators/methods/integrator_in_units.hpp"

namespace courant {
namespace {

constexpr Index kMostTried = 50;
// Of the way from one solution to the next: of three that are evenly spaced the one between is not there.
constexpr double kAside = 0.381966;
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

// The system, in natural units where its numbers are far apart: charges of 10⁻¹² C are no round-off of 1 there.
class OtherSolutions {
 public:
  OtherSolutions(const std::shared_ptr<const ImplicitSystem>& system, const State& at)
      : equations_(std::make_shared<const ChartEquations>(system)), at_(at) {
    if (const auto units = needed_units(equations_, at)) {
      units_ = units;
      equations_ = std::make_shared<const ChartEquations>(
          std::make_shared<const SystemInUnits>(system, *units));
      at_ = units->measure(at);
    }
  }

  // What unknown i is in the solution that a search comes to from -z_i at these coordinates, if it comes to another one.
  std::optional<double> value_from_opposite(Index i) const {
    ConstraintAlgorithm::Options options;
    options.max_level = 0;
    InitialGuess guess{.t = at_.t, .x = at_.x, .v = at_.v, .z = at_.z};
    guess.z[i] = -at_.z[i];
    guess.hold_x.resize(static_cast<std::size_t>(at_.x.size()));
    std::iota(guess.hold_x.begin(), guess.hold_x.end(), Index{0});
    const ConstraintLadder found = ConstraintAlgorithm(options).run(equations_, guess);
    if (found.levels.empty()) return std::nullopt;
    const State& other = found.point;
    if (!other.v.allFinite() || !other.z.allFinite() || !is_solution(other)) return std::nullopt;
    // Where a value between the two solves the equations as well, they differ by round-off.
    State between = other;
    between.z[i] += kAside * (at_.z[i] - other.z[i]);
    if (is_solution(between)) return std::nullopt;
    return (units_ ? units_->restore(other) : other).z[i];
  }

 private:
  // Whether each equation vanishes at the state next to its own terms.
  bool is_solution(const State& state) const {
    const DerivativeArray array(equations_, state.t, at_.x);
    Zero zero(array.jet(state.v, state.z));
    zero.found = true;
    const ConsistentPoint point(equations_, {.t = state.t, .x = at_.x}, {});
    return point.is_met_at({array, std::move(zero)});
  }

  std::shared_ptr<const ChartEquations> equations_;
  State at_;
  std::optional<Units> units_;
};

}  // namespace

std::vector<Movement> other_values(const Experiment& experiment, const ConstraintLadder& ladder) {
  const auto& system = experiment.model.system;
  const State& at = ladder.point;
  std::vector<Movement> others;
  if (ladder.verdict != Verdict::regular || at.z.size() > kMostTried || at.x.size() > kMostTried)
    return others;
  // Of z, compiled for the first unknown that is asked about.
  std::optional<Function> equations;
  std::optional<OtherSolutions> solutions;
  // Unknowns that have names.
  for (Index i = 0; i < experiment.initial.z.given.size(); ++i) {
    if (experiment.initial.z.given[i] || at.z[i] == 0.0) continue;
    try {
      if (!equations) equations.emplace(equations_of_unknowns(*system, at));
      if (!is_nonlinear(*equations, at.z, i)) continue;
      if (!solutions) solutions.emplace(system, at);
      if (const auto value = solutions->value_from_opposite(i))
        others.push_back({system->names().auxiliary[static_cast<std::size_t>(i)], at.z[i], *value});
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
