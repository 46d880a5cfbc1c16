#include "courant/integrators/boundary/boundary_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/boundary/conjugate_times.hpp"
#include "courant/integrators/boundary/shooting.hpp"

namespace courant {
namespace {

// Below this, next to the largest, entries of the shooting matrix are not known: its column of the time is a difference.
constexpr double kMatrixError = 1e-9;
// A matrix away from the solution differs from that at it by its change over Δ, and no more than this is made of that.
constexpr double kMostChange = 1e-3, kPartOfChange = 0.1;
constexpr double kLeastDamping = 1e-6;
// Of the size of states and of the gradient of a condition: what is left of one that holds.
constexpr double kHolds = 1e-8;
// Where ‖Δ‖ is below this part of the states, round-off may keep it from falling further.
constexpr double kNearRoundOff = 1e-7;
// Of the size of states: what a run without a break may miss.
constexpr double kCloses = 1e-6;
// The cosine of the angle between the velocity of a motion and what is free: discrete motions turn it by the order of the method.
constexpr double kIsPhase = 0.999;
// Next to states that become smaller and smaller, on the way to a motion that is 0, no change is ever small.
constexpr double kLeastSize = 1e-100;

double size_of_states(const Shooting::Motion& motion) {
  double size = 0.0;
  for (const State& node : motion.nodes)
    if (node.x.size() > 0) size = std::max(size, node.x.lpNorm<Eigen::Infinity>());
  return size > 0.0 ? std::max(size, kLeastSize) : 1.0;
}

// One unit for all rows: what is round-off in one is not scaled up.
RankOptions options_of(const MatrixXd& A) {
  return {.data_error = kMatrixError, .magnitude = A.cwiseAbs().maxCoeff()};
}

Index rank_of(const MatrixXd& A) {
  return A.size() == 0 || A.isZero(0.0) ? 0 : decide_rank(A, options_of(A)).rank;
}

VectorXd inverse_sizes(const VectorXd& sizes) {
  return (sizes.array() > 0.0).select(sizes.cwiseInverse(), 1.0);
}

class MotionSearch {
 public:
  MotionSearch(const BoundaryProblem& problem, const BoundaryOptions& options)
      : problem_(problem), options_(options), shooting_(problem) {}

  BoundarySolution from(Shooting::Motion motion) {
    motion_ = std::move(motion);
    require_enough_unknowns();
    const bool ended = iterate();
    BoundarySolution solution = told();
    if (ended && holds()) {
      solution.needs_nodes = !is_run(solution);
      take_rank(solution);
      take_second_order(solution);
    } else {
      solution.reason = failure();
    }
    return solution;
  }
  const Shooting& shooting() const { return shooting_; }

 private:
  // A problem that has more independent conditions than unknowns has a solution by accident alone.
  void require_enough_unknowns() const {
    if (problem_.is_periodic) return;
    const Index k = shooting_.points().dimension();
    const auto bases = shooting_.bases(motion_);
    const auto linear = shooting_.linear(motion_, bases);
    const VectorXd weights = inverse_sizes(linear.sizes);
    const MatrixXd J = weights.asDiagonal() * linear.matrix;
    const Index m = shooting_.segments(), nu = shooting_.multiplier_count(),
                own = problem_.initial.multipliers, time = problem_.has_free_time ? 1 : 0;
    MatrixXd first(shooting_.initial_count(), k + own);
    first.leftCols(k) = J.topLeftCorner(first.rows(), k);
    first.rightCols(own) = J.block(0, k * m + time, first.rows(), own);
    MatrixXd last(shooting_.final_count(), k + time + nu - own);
    last.leftCols(k + time) = J.bottomRows(last.rows()).middleCols(k * (m - 1), k + time);
    last.rightCols(nu - own) = J.bottomRows(last.rows()).rightCols(nu - own);
    // Of conditions with multipliers those that are left when these are eliminated.
    const auto independent = [&](const MatrixXd& rows, Index multipliers) {
      return rank_of(rows) - rank_of(rows.rightCols(multipliers));
    };
    const Index begins = independent(first, own), ends = independent(last, nu - own);
    if (begins + ends <= k + time) return;
    throw std::invalid_argument(
        "solve_boundary_problem: there are more independent conditions, " + std::to_string(begins) +
        " at the beginning and " + std::to_string(ends) + " at the end, than the " +
        std::to_string(k + time) + " numbers that are free" +
        (time > 0 ? ", of which one is the time; " : "; ") + "expected fewer conditions.");
  }

  // J, with weights of its rows that take the units of conditions out, and with τ times the size of the states for τ.
  void take_matrix() {
    bases_ = shooting_.bases(motion_);
    linear_ = shooting_.linear(motion_, bases_);
    weights_ = inverse_sizes(linear_.sizes);
    units_ = VectorXd::Ones(linear_.matrix.cols());
    if (problem_.has_free_time)
      units_[shooting_.points().dimension() * shooting_.segments()] = 1.0 / size_of_states(motion_);
    matrix_ = weights_.asDiagonal() * linear_.matrix * units_.asDiagonal();
  }

  // Whether Δ is as small as is asked for.
  bool iterate() {
    double last = std::numeric_limits<double>::infinity(), lambda = 1.0;
    for (iterations_ = 0; iterations_ < options_.most_iterations; ++iterations_) {
      if (options_.stop && *options_.stop) throw std::runtime_error("interrupted");
      try {
        take_matrix();
      } catch (const std::domain_error& error) {
        obstacle_ = without_place(error.what());
        return false;
      }
      if (!matrix_.allFinite() || !linear_.residual.allFinite()) return false;
      const double size = size_of_states(motion_);
      const double error = std::clamp(kPartOfChange * last / size, kMatrixError, kMostChange);
      const CompleteOrthogonalDecomposition inverse(matrix_, error);
      const auto step = [&](const VectorXd& F) {
        return VectorXd(-inverse.solve(weights_.cwiseProduct(F)));
      };
      const VectorXd change = step(linear_.residual);
      const double norm = change.norm();
      changes_.push_back(norm);
      if (norm <= options_.tolerance * size) {
        if (error <= kMatrixError) {
          take_last(change);
          return true;
        }
        last = norm;  // once more, with all that is known of the matrix
        continue;
      }
      if (norm <= kNearRoundOff * size && norm >= last) return true;
      last = norm;
      lambda = std::min(1.0, 4.0 * lambda);
      bool accepted = false;
      while (!accepted && lambda >= kLeastDamping) {
        try {
          Shooting::Motion trial =
              shooting_.moved(motion_, bases_, lambda * units_.cwiseProduct(change));
          const VectorXd F = shooting_.residual(trial, bases_);
          if (F.allFinite()) {
            const VectorXd next = step(F);
            const double left = next.norm();
            const double unexplained = (next - (1.0 - lambda) * change).norm();
            accepted = left <= (1.0 - 0.25 * lambda) * norm ||
                       (norm <= kNearRoundOff * size && left <= 2.0 * norm);
            if (accepted) {
              motion_ = std::move(trial);
              break;
            }
            // As far as the linear model holds, but by half at least.
            lambda = std::min(0.5 * lambda,
                              std::max(0.1 * lambda, 0.5 * norm * lambda * lambda / unexplained));
            continue;
          }
        } catch (const SolveError&) {
        } catch (const std::domain_error&) {
        }
        lambda *= 0.5;
      }
      if (!accepted) return false;
    }
    return false;
  }

  // Newton's method squares its error: a change that is as small as is asked for leaves round-off, so that the answer does not depend on the way.
  void take_last(const VectorXd& change) {
    try {
      Shooting::Motion trial = shooting_.moved(motion_, bases_, units_.cwiseProduct(change));
      const VectorXd F = shooting_.residual(trial, bases_);
      if (!(weights_.cwiseProduct(F).norm() < weights_.cwiseProduct(linear_.residual).norm()))
        return;
      motion_ = std::move(trial);
      linear_.residual = F;
    } catch (const SolveError&) {
    } catch (const std::domain_error&) {
    }
  }

  // Whether all equations hold: the iteration may have ended at least squares.
  bool holds() {
    const double size = size_of_states(motion_);
    for (Index i = 0; i < linear_.residual.size(); ++i)
      if (std::fabs(weights_[i] * linear_.residual[i]) > kHolds * size) return false;
    return true;
  }

  BoundarySolution told() const {
    BoundarySolution solution;
    solution.start = motion_.nodes.front();
    solution.start.t = problem_.guess.t;
    take_rates(solution.start);
    solution.h = motion_.h;
    solution.steps = problem_.steps;
    solution.nodes = motion_.nodes;
    solution.multipliers = motion_.multipliers;
    solution.iterations = iterations_;
    solution.changes = changes_;
    const Index first = shooting_.initial_count(), last = shooting_.final_count();
    const Index joints = linear_.residual.size() - first - last;
    if (joints > 0)
      solution.jump = linear_.residual.segment(first, joints).lpNorm<Eigen::Infinity>();
    VectorXd all(first + last + (problem_.is_periodic ? 1 : 0));
    try {
      all = shooting_.of_run(motion_);
    } catch (const std::exception&) {  // the run from the start does not come to the end
      all.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    const auto names = shooting_.names();
    for (std::size_t i = 0; i < names.size(); ++i)
      solution.conditions.push_back({names[i], all[static_cast<Index>(i)]});
    if (problem_.is_periodic) solution.closure = all[all.size() - 1];
    return solution;
  }

  // Whether the run from the start, without a break, comes to the end.
  bool is_run(const BoundarySolution& solution) const {
    const double most = kCloses * size_of_states(motion_);
    const Index first = shooting_.initial_count(), all = std::ssize(solution.conditions);
    for (Index i = 0; i < all; ++i) {
      const double weight = weights_[i < first ? i : weights_.size() - all + i];
      if (!(std::fabs(weight * solution.conditions[static_cast<std::size_t>(i)].residual) <= most))
        return false;
    }
    return !solution.closure || *solution.closure <= most;
  }

  // Velocity and unknowns, which say what branch is meant where there are several.
  void take_rates(State& at) const {
    try {
      const auto rates = shooting_.points().rates(at, MatrixXd(at.x.size(), 0));
      at.v = rates.v;
      at.z = rates.z;
    } catch (const std::domain_error&) {  // the search ended where there are none
    }
  }

  void take_rank(BoundarySolution& solution) const {
    const MatrixXd& J = matrix_;
    const Index nu = shooting_.multiplier_count();
    solution.rank = decide_rank(J, options_of(J));
    const Index idle = nu - rank_of(J.rightCols(nu));
    solution.family_dimension = solution.rank.nullity() - idle;
    if (problem_.is_periodic && solution.family_dimension > 0) {
      const FundamentalSubspaces spaces(J, options_of(J));
      const VectorXd along = motion_along();
      solution.has_phase = (spaces.kernel().transpose() * along).norm() > kIsPhase * along.norm();
      if (solution.has_phase) --solution.family_dimension;
    }
    solution.verdict = solution.family_dimension > 0 ? BoundarySolution::Verdict::family
                                                     : BoundarySolution::Verdict::isolated;
  }

  // The velocity at all nodes, as a change of the unknowns.
  VectorXd motion_along() const {
    const Index k = shooting_.points().dimension();
    VectorXd all = VectorXd::Zero(linear_.matrix.cols());
    const Manifold& M = *problem_.method->system()->manifold();
    for (std::size_t i = 0; i < motion_.nodes.size(); ++i) {
      const State& at = motion_.nodes[i];
      const auto rates = shooting_.points().rates(at, MatrixXd(at.x.size(), 0));
      all.segment(static_cast<Index>(i) * k, k) =
          bases_[i].transpose() * (M.frame(at.x) * rates.v).eval();
    }
    return all;
  }

  // Nothing where the run from the start, without a break, is no longer the motion of the nodes.
  void take_second_order(BoundarySolution& solution) const {
    try {
      if (problem_.is_periodic) {
        const MatrixXd& V = bases_.front();
        solution.floquet = shooting_.flow()
                               .over(motion_.h, problem_.steps)
                               .multipliers(solution.start, V, kCloses * size_of_states(motion_));
      } else if (!problem_.has_free_time && shooting_.multiplier_count() == 0 &&
                 !solution.needs_nodes) {
        solution.conjugate_times =
            conjugate_times(shooting_, solution.start, motion_.h, problem_.steps);
      }
    } catch (const SolveError&) {
    } catch (const std::domain_error&) {
    }
  }

  std::string failure() const {
    if (!obstacle_.empty())
      return "the search came to a motion without a tangent map, after " +
             std::to_string(iterations_) + " iterations: " + obstacle_;
    const Index first = shooting_.initial_count(), last = shooting_.final_count();
    const auto names = shooting_.names();
    const VectorXd& F = linear_.residual;
    std::string words;
    double greatest = 0.0;
    for (Index i = 0; i < F.size(); ++i) {
      const double part = std::fabs(weights_[i] * F[i]);
      if (!(part > greatest) && std::isfinite(part)) continue;
      greatest = part;
      if (i < first)
        words = names[static_cast<std::size_t>(i)] + " is off by " + number_text(F[i], 3);
      else if (i >= F.size() - last)
        words = names[static_cast<std::size_t>(i - (F.size() - last) + first)] + " is off by " +
                number_text(F[i], 3);
      else
        words = "the motion has a jump of " + number_text(std::fabs(F[i]), 3);
    }
    return "no motion was found that meets the conditions: after " + std::to_string(iterations_) +
           (iterations_ == 1 ? " iteration " : " iterations ") +
           (words.empty() ? "nothing gets nearer" : words) +
           "; expected a guess nearer to a solution, or conditions that can be met";
  }

  const BoundaryProblem& problem_;
  const BoundaryOptions& options_;
  Shooting shooting_;
  Shooting::Motion motion_;
  Shooting::Bases bases_;
  Shooting::Linear linear_;
  VectorXd weights_, units_;
  MatrixXd matrix_;
  int iterations_ = 0;
  std::string obstacle_;
  std::vector<double> changes_;
};

}  // namespace

std::string to_string(BoundarySolution::Verdict verdict) {
  switch (verdict) {
    case BoundarySolution::Verdict::isolated:
      return "isolated";
    case BoundarySolution::Verdict::family:
      return "family";
    case BoundarySolution::Verdict::unsolved:
      break;
  }
  return "unsolved";
}

BoundarySolution solve_boundary_problem(const BoundaryProblem& problem,
                                        const BoundaryOptions& options) {
  MotionSearch search(problem, options);
  return search.from(search.shooting().guess());
}

BoundarySolution solve_boundary_problem(const BoundaryProblem& problem,
                                        const BoundarySolution& near,
                                        const BoundaryOptions& options) {
  BoundaryProblem from = problem;
  if (!near.nodes.empty()) from.guess = near.nodes.front();
  MotionSearch search(from, options);
  if (std::ssize(near.nodes) != search.shooting().segments() ||
      near.multipliers.size() != search.shooting().multiplier_count())
    throw std::invalid_argument(
        "solve_boundary_problem: the solution nearby has " + std::to_string(near.nodes.size()) +
        " nodes; expected one of a problem with " + std::to_string(search.shooting().segments()) +
        " segments, and as many multipliers.");
  Shooting::Motion motion{{}, problem.has_free_time ? near.h : problem.h, near.multipliers};
  for (const State& node : near.nodes)
    motion.nodes.push_back(search.shooting().points().nearest(node));
  return search.from(std::move(motion));
}

BoundarySolution continue_boundary_problem(const std::function<BoundaryProblem(double c)>& problem,
                                           double from, double to, const BoundaryOptions& options,
                                           const std::function<void(double c)>& tell) {
  constexpr double least_part = 1e-4;
  constexpr int quick = 8;  // iterations after which the next step may be longer
  const auto solved = [](const BoundarySolution& solution) {
    return solution.verdict != BoundarySolution::Verdict::unsolved;
  };
  double c = from, step = to - from;
  BoundarySolution solution = solve_boundary_problem(problem(c), options);
  if (!solved(solution)) {
    solution.reason =
        "at " + number_text(c) + ", where the continuation begins, " + solution.reason;
    return solution;
  }
  if (tell) tell(c);
  while (c != to) {
    const bool is_last = std::fabs(step) >= std::fabs(to - c);
    const double next = is_last ? to : c + step;
    BoundarySolution trial;
    try {
      trial = solve_boundary_problem(problem(next), solution, options);
    } catch (const SolveError& error) {
      trial.reason = without_place(error.what());
    } catch (const std::domain_error& error) {
      trial.reason = without_place(error.what());
    }
    if (solved(trial)) {
      const bool is_quick = trial.iterations <= quick;
      solution = std::move(trial);
      c = next;
      if (tell) tell(c);
      if (is_quick) step *= 2.0;
      continue;
    }
    step = 0.5 * (next - c);
    if (std::fabs(step) < least_part * std::fabs(to - from)) {
      solution.verdict = BoundarySolution::Verdict::unsolved;
      solution.reason = "the continuation comes to " + number_text(c) + ", not to " +
                        number_text(to) + ": " + trial.reason;
      return solution;
    }
  }
  return solution;
}

}  // namespace courant
