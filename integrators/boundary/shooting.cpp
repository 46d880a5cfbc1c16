#include "courant/integrators/boundary/shooting.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"

namespace courant {
namespace {

constexpr long kUsualSegments = 8;
// Some minutes of an iteration, within which nobody is asked whether to stop.
constexpr long kMostSteps = 10'000'000;
// Of the size of a step, for differences: their error is its fourth power, round-off over it.
constexpr double kPartOfStep = 1e-3;
// A step that leaves M_f by more than this of the size of its point is that of a method which does not keep to it.
constexpr double kKeeps = 1e-9;

std::vector<long> lengths_of_segments(long steps, long segments) {
  std::vector<long> parts;
  for (long i = 0; i < segments; ++i)
    parts.push_back(steps * (i + 1) / segments - steps * i / segments);
  return parts;
}

}  // namespace

Shooting::End::End(const EndConditions& conditions, const ImplicitSystem& system,
                   std::string place) {
  const Manifold& M = *system.manifold();
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension()),
                   v = graph.variables("v", M.tangent_dimension()),
                   z = graph.variables("z", system.auxiliary_size()),
                   nu = graph.variables("nu", conditions.multipliers);
  const ExprVector t = graph.variables("t", 1);
  const ExprVector r = conditions.formula ? conditions.formula({x, v, z, t[0], nu}) : ExprVector(0);
  has_rates_ = depends(r, v) || depends(r, z);
  conditions_ =
      Function("conditions at the " + place, {{"x", x}, {"v", v}, {"z", z}, {"nu", nu}, {"t", t}},
               r, {.differentiate = {"x", "v", "z", "nu"}});
  names_ = conditions.names;
  for (Index i = std::ssize(names_); i < r.size(); ++i)
    names_.push_back("condition " + std::to_string(i + 1) + " at the " + place);
}

VectorXd Shooting::End::values(const ConsistentPoints& points, const State& at,
                               const VectorXd& nu) const {
  VectorXd v = VectorXd::Zero(conditions_.input_size(1)),
           z = VectorXd::Zero(conditions_.input_size(2));
  if (has_rates_) {
    const auto rates = points.rates(at, MatrixXd(at.x.size(), 0));
    v = rates.v;
    z = rates.z;
  }
  return conditions_({at.x, v, z, nu, VectorXd::Constant(1, at.t)});
}

Shooting::End::Slopes Shooting::End::slopes(const ConsistentPoints& points, const State& at,
                                            const MatrixXd& V, const VectorXd& nu) const {
  const Index N = conditions_.input_size(0), n = conditions_.input_size(1),
              m = conditions_.input_size(2);
  ConsistentPoints::Rates rates{VectorXd::Zero(n), VectorXd::Zero(m), MatrixXd::Zero(n, V.cols()),
                                MatrixXd::Zero(m, V.cols())};
  if (has_rates_) rates = points.rates(at, V);
  const MatrixXd J =
      conditions_.jacobian({at.x, rates.v, rates.z, nu, VectorXd::Constant(1, at.t)});
  return {J.leftCols(N) * V + J.middleCols(N, n) * rates.dv + J.middleCols(N + n, m) * rates.dz,
          J.rightCols(nu.size()), J.rowwise().norm()};
}

Shooting::Shooting(const BoundaryProblem& problem)
    : problem_(problem),
      flow_(problem.method, problem.h, problem.steps),
      points_(problem.method->system(), problem.ladder),
      initial_(problem.initial, *problem.method->system(), "beginning"),
      final_(problem.final, *problem.method->system(), "end") {
  if (problem_.steps < 1 || !(problem_.h > 0.0) || problem_.segments < 0)
    throw std::invalid_argument("Shooting::Shooting: steps is " + std::to_string(problem_.steps) +
                                ", segments is " + std::to_string(problem_.segments) +
                                "; expected at least one step, forward in time.");
  if (problem_.steps > kMostSteps)
    throw std::invalid_argument("Shooting::Shooting: steps is " + std::to_string(problem_.steps) +
                                "; expected at most " + std::to_string(kMostSteps) +
                                " where boundary values are sought, all of which each iteration "
                                "makes.");
  problem_.guess = points_.nearest(problem_.guess);
  // A method that leaves M_f would be brought back at nodes, and the run from the start would be another motion.
  const State after = problem_.method->advance(problem_.guess, problem_.h);
  const bool keeps = (points_.nearest(after).x - after.x).norm() <= kKeeps * (1.0 + after.x.norm());
  const long most = problem_.segments > 0 ? problem_.segments : kUsualSegments;
  steps_ = lengths_of_segments(problem_.steps, keeps ? std::min(most, problem_.steps) : 1);
}

std::vector<std::string> Shooting::names() const {
  std::vector<std::string> all = initial_.names();
  all.insert(all.end(), final_.names().begin(), final_.names().end());
  return all;
}

Shooting::Motion Shooting::guess() const {
  Motion motion{{problem_.guess}, problem_.h, VectorXd::Zero(multiplier_count())};
  place(motion, 0);
  for (std::size_t i = 0; i + 1 < steps_.size(); ++i) {
    motion.nodes.push_back(motion.nodes.back());
    try {
      motion.nodes.back() = end_of(motion, i);
    } catch (const SolveError&) {
    } catch (const std::domain_error&) {
    }
    place(motion, i + 1);
  }
  return motion;
}

// Takes the node to where the guess has it.
void Shooting::place(Motion& motion, std::size_t node) const {
  if (!problem_.guess_at) return;
  const State last = begin_of(motion, node);
  State guessed = last;
  problem_.guess_at(guessed);
  motion.nodes[node] = points_.moved(last, points_.way(last.x, guessed.x));
}

Shooting::Bases Shooting::bases(const Motion& motion) const {
  Bases bases;
  for (std::size_t i = 0; i < motion.nodes.size(); ++i)
    bases.push_back(points_.directions(begin_of(motion, i)));
  return bases;
}

Shooting::Motion Shooting::moved(const Motion& from, const Bases& bases,
                                 const VectorXd& change) const {
  Motion to = from;
  const Index k = points_.dimension();
  for (std::size_t i = 0; i < from.nodes.size(); ++i)
    to.nodes[i] =
        points_.moved(begin_of(from, i), bases[i] * change.segment(static_cast<Index>(i) * k, k));
  Index at = k * std::ssize(from.nodes);
  if (problem_.has_free_time) to.h *= std::exp(change[at++]);
  to.multipliers += change.tail(change.size() - at);
  return to;
}

State Shooting::begin_of(const Motion& motion, std::size_t segment) const {
  long before = 0;
  for (std::size_t i = 0; i < segment; ++i) before += steps_[i];
  State state = motion.nodes[segment];
  state.t = problem_.guess.t + static_cast<double>(before) * motion.h;
  return state;
}

State Shooting::end_of(const Motion& motion, std::size_t segment) const {
  State end = problem_.method->advance(begin_of(motion, segment), motion.h, steps_[segment]);
  points_.require_energy(end);
  return end;
}

VectorXd Shooting::joined(const Motion& motion, const Bases& bases,
                          const std::vector<State>& ends) const {
  const Index k = points_.dimension(), m = std::ssize(motion.nodes);
  const Index joints = problem_.is_periodic ? m : m - 1;
  VectorXd all(initial_.count() + k * joints + final_.count());
  all.head(initial_.count()) = initial_.values(points_, begin_of(motion, 0), nu_initial(motion));
  for (Index i = 0; i < joints; ++i) {
    const auto next = static_cast<std::size_t>((i + 1) % m);
    all.segment(initial_.count() + k * i, k) =
        bases[next].transpose() *
        points_.way(motion.nodes[next].x, ends[static_cast<std::size_t>(i)].x);
  }
  all.tail(final_.count()) = final_.values(points_, ends.back(), nu_final(motion));
  return all;
}

VectorXd Shooting::residual(const Motion& motion, const Bases& bases) const {
  std::vector<State> ends;
  for (std::size_t i = 0; i < motion.nodes.size(); ++i) ends.push_back(end_of(motion, i));
  return joined(motion, bases, ends);
}

Shooting::Linear Shooting::linear(const Motion& motion, const Bases& bases) const {
  const Index k = points_.dimension(), m = std::ssize(motion.nodes);
  const Index first_nu = k * m + (problem_.has_free_time ? 1 : 0);
  std::vector<State> ends;
  std::vector<MatrixXd> images;
  for (Index i = 0; i < m; ++i) {
    const auto at = static_cast<std::size_t>(i);
    auto image = flow_.over(motion.h, steps_[at]).push_forward(begin_of(motion, at), bases[at]);
    ends.push_back(std::move(image.end));
    images.push_back(std::move(image.directions));
  }
  Linear result{joined(motion, bases, ends), {}, {}};
  result.matrix = MatrixXd::Zero(result.residual.size(), first_nu + multiplier_count());
  MatrixXd& J = result.matrix;
  result.sizes = VectorXd::Ones(J.rows());
  const auto begins = initial_.slopes(points_, begin_of(motion, 0), bases[0], nu_initial(motion));
  J.topLeftCorner(initial_.count(), k) = begins.along;
  J.block(0, first_nu, initial_.count(), begins.by_multipliers.cols()) = begins.by_multipliers;
  result.sizes.head(initial_.count()) = begins.sizes;
  const Index joints = problem_.is_periodic ? m : m - 1;
  for (Index i = 0; i < joints; ++i) {
    const Index row = initial_.count() + k * i, next = (i + 1) % m;
    const MatrixXd& B = bases[static_cast<std::size_t>(next)];
    J.block(row, k * i, k, k) += B.transpose() * images[static_cast<std::size_t>(i)];
    J.block(row, k * next, k, k) -= MatrixXd::Identity(k, k);
  }
  const auto finish = final_.slopes(points_, ends.back(), images.back(), nu_final(motion));
  J.block(J.rows() - final_.count(), k * (m - 1), final_.count(), k) += finish.along;
  J.bottomRightCorner(final_.count(), finish.by_multipliers.cols()) = finish.by_multipliers;
  result.sizes.tail(final_.count()) = finish.sizes;
  if (problem_.has_free_time) {
    const auto longer = [&](double part) {
      Motion other = motion;
      other.h *= 1.0 + part;
      return residual(other, bases);
    };
    constexpr double d = kPartOfStep;
    J.col(k * m) =
        (8.0 * (longer(d) - longer(-d)) - (longer(2.0 * d) - longer(-2.0 * d))) / (12.0 * d);
  }
  return result;
}

VectorXd Shooting::of_run(const Motion& motion) const {
  const State start = begin_of(motion, 0);
  const State end = problem_.method->advance(start, motion.h, problem_.steps);
  VectorXd all(initial_.count() + final_.count() + (problem_.is_periodic ? 1 : 0));
  all.head(initial_.count()) = initial_.values(points_, start, nu_initial(motion));
  all.segment(initial_.count(), final_.count()) = final_.values(points_, end, nu_final(motion));
  if (problem_.is_periodic) all[all.size() - 1] = points_.way(start.x, end.x).norm();
  return all;
}

MatrixXd Shooting::initial_slopes(const State& at, const MatrixXd& V,
                                  const VectorXd& multipliers) const {
  return initial_.slopes(points_, at, V, multipliers).along;
}

MatrixXd Shooting::final_slopes(const State& at, const MatrixXd& V,
                                const VectorXd& multipliers) const {
  return final_.slopes(points_, at, V, multipliers).along;
}

}  // namespace courant
