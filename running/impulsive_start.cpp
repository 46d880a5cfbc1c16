#include "courant/running/impulsive_start.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"

namespace courant {
namespace {

constexpr Index kMostMovable = 500;
constexpr int kMostJumps = 20;
// Next to coordinates so much larger, those that were given are round-off: no impulse does this.
constexpr double kMostGrowth = 1e6;
// Next to the sizes of coordinates: what is left of a movement along impulses is round-off.
constexpr double kReached = 1e-10;
constexpr double kRoundOffOfJump = 1e-14;
constexpr double kLeastSine = 1e-9;
// Next to how much constraints are violated: an impulse that leaves more of it leads to none of their points.
constexpr double kMostLeft = 0.5;

// Columns: the directions of Δx (n) in which what is kept does not move, none where the residual has no derivative.
MatrixXd impulse_directions(const Experiment& experiment, const Flags& kept, const State& at) {
  const ImplicitSystem& system = *experiment.model.system;
  const Index n = at.x.size(), m = at.z.size();
  Graph graph;
  const ExprVector x = graph.variables("x", n), v = graph.variables("v", n),
                   z = graph.variables("z", m);
  const Expr t = graph.variable("t");
  const Function F("impulses", {{"v", v}, {"z", z}, {"x", x}, {"t", ExprVector{{t}}}},
                   system.residual(x, v, z, t), {.differentiate = {"v", "z"}});
  const MatrixXd J = F.jacobian({at.v, at.z, at.x, VectorXd::Constant(1, at.t)});
  if (!J.allFinite()) return MatrixXd(n, 0);
  std::vector<Index> held;
  for (Index i = 0; i < n; ++i)
    if (kept[i]) held.push_back(i);
  MatrixXd conditions = MatrixXd::Zero(J.rows() + std::ssize(held), n + m);
  conditions.topRows(J.rows()) = J;
  for (std::size_t k = 0; k < held.size(); ++k)
    conditions(J.rows() + static_cast<Index>(k), held[k]) = 1.0;
  return kernel(conditions, {.data_error = 1e-9}).topRows(n);
}

// Where an impulse begins: at what is given, and of the rest where the nearest start has it. Where all that is not given is
// 0, and coordinates alone are given, it is 0.
VectorXd beginning(const Experiment& experiment, const VectorXd& nearest) {
  const InitialValues& initial = experiment.initial;
  const bool at_zero =
      experiment.model.starts_at_zero && !initial.velocity.given.any() && !initial.z.given.any();
  return at_zero ? initial.x.values : VectorXd(initial.x.given.select(initial.x.values, nearest));
}

bool is_start(const ConstraintLadder& ladder) {
  return (ladder.verdict == Verdict::regular || ladder.verdict == Verdict::gauge) &&
         !ladder.levels.empty() && ladder.levels.back().is_solved;
}

// A search that begins within its tolerance of a zero ends there; from a little beside, along the conormals, it ends at
// round-off.
ConstraintLadder polished(ConstraintLadder ladder,
                          const std::function<ConstraintLadder(const VectorXd& x)>& nearest_to) {
  constexpr double beside = 1e-7;
  const VectorXd& x = ladder.point.x;
  const double size = x.lpNorm<Eigen::Infinity>();
  const VectorXd across = ladder.conormals().rowwise().normalized().colwise().sum();
  ConstraintLadder again = nearest_to(x + beside * size * across);
  const bool same =
      is_start(again) && (again.point.x - x).lpNorm<Eigen::Infinity>() <= kReached * size;
  return same ? again : ladder;
}

// With the moves from `begin`, of what was given.
ConsistentStart as_impulse(const Experiment& experiment, ConstraintLadder ladder,
                           const VectorXd& begin) {
  const VectorXd& x = ladder.point.x;
  const double least = kReached * begin.cwiseAbs().cwiseMax(x.cwiseAbs()).maxCoeff();
  const auto& names = experiment.model.system->names().coordinates;
  ladder.moves.clear();
  for (Index i = 0; i < x.size(); ++i)
    if (experiment.initial.x.given[i] && std::fabs(x[i] - begin[i]) > least)
      ladder.moves.push_back({names[static_cast<std::size_t>(i)], begin[i], x[i]});
  ladder.moved = experiment.initial.x.given.select(x - begin, 0.0).matrix().norm();
  return {std::move(ladder), true};
}

}  // namespace

ConsistentStart impulsive_start(
    const Experiment& experiment, ConstraintLadder nearest,
    const std::function<ConstraintLadder(const VectorXd& x)>& nearest_to) {
  const InitialValues& initial = experiment.initial;
  const Manifold& M = *experiment.model.system->manifold();
  const Index n = M.ambient_dimension();
  if (!is_start(nearest) || n != M.tangent_dimension() || n > kMostMovable ||
      !M.frame(nearest.point.x).is_identity() || !(initial.weight.array() == 1.0).all())
    return nearest;
  const VectorXd begin = beginning(experiment, nearest.point.x);
  const auto size = [&](const VectorXd& x) {
    return begin.cwiseAbs().cwiseMax(x.cwiseAbs()).maxCoeff();
  };
  if ((begin - nearest.point.x).lpNorm<Eigen::Infinity>() <= kReached * size(nearest.point.x))
    return nearest;
  // What is given stays if it can: then only the rest moves.
  const VectorXd given_moves = initial.x.given.select(begin - nearest.point.x, 0.0);
  Flags kept = initial.x.held;
  if (given_moves.lpNorm<Eigen::Infinity>() <= kReached * size(nearest.point.x))
    kept = kept || initial.x.given;
  VectorXd x = begin;
  ConstraintLadder ladder = nearest;
  double before = std::numeric_limits<double>::infinity();
  try {
    for (int step = 0; step < kMostJumps; ++step) {
      const double beside = (x - ladder.point.x).lpNorm<Eigen::Infinity>();
      const bool is_settled = beside <= kRoundOffOfJump * size(x) || beside >= before;
      if (step > 0 && is_settled && beside > kReached * size(x)) return nearest;
      if (step > 0 && is_settled)
        return as_impulse(experiment, polished(std::move(ladder), nearest_to), begin);
      before = step > 0 ? beside : before;
      const MatrixXd K = impulse_directions(experiment, kept, ladder.point);
      const MatrixXd A = ladder.conormals().rowwise().normalized();
      if (K.cols() == 0 || A.rows() == 0) return nearest;
      // Sines of angles between impulses and constraints: where these are round-off, no impulse acts.
      const MatrixXd sines = A * K;
      const MatrixXd acting = (sines.array().abs() > kLeastSine).select(sines, 0.0);
      const VectorXd violated = A * (begin - ladder.point.x);
      const VectorXd sizes = CompleteOrthogonalDecomposition(acting).solve(violated);
      if ((violated - acting * sizes).norm() > kMostLeft * violated.norm()) return nearest;
      x = begin - K * sizes;
      if (size(x) > kMostGrowth * size(nearest.point.x)) return nearest;
      ladder = nearest_to(x);
      if (!is_start(ladder)) return nearest;
    }
  } catch (const std::runtime_error&) {  // impulses lead to where nothing is defined
  } catch (const std::domain_error&) {
  }
  return nearest;
}

}  // namespace courant
