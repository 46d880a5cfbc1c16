#include "courant/integrators/certificate/discrete_constraint_algorithm.hpp"

#include "courant/integrators/certificate/chain_array.hpp"
#include "courant/integrators/certificate/ladder_levels.hpp"
#include "courant/integrators/certificate/least_zero.hpp"

namespace courant {
namespace {

// The chain of zero.y one link longer, as far on as the last one went.
VectorXd longer(const ChainArray& chain, const VectorXd& y, const VectorXd& step, Index k) {
  const Index n = chain.base_size();
  VectorXd result = VectorXd::Zero(chain.unknown_count(k));
  result.head(y.size()) = y;
  result.segment(chain.x_offset(k + 1), n) = y.segment(chain.x_offset(k), n) + step;
  if (k > 0) {
    const Index m = chain.auxiliary_size();
    result.segment(chain.z_offset(k), m) = y.segment(chain.z_offset(k - 1), m);
  }
  return result;
}

Zero nearest(const ChainArray& chain, const VectorXd& start, const VectorXd& nominal) {
  const Index n = chain.base_size();
  const LinearizableMap F = [&](const VectorXd& y) { return chain.linearize(y); };
  Mobility mobility{.cost = VectorXd::Constant(start.size(), 0.03), .frozen = n};
  mobility.cost.head(n).setOnes();
  mobility.nominal = VectorXd::Zero(start.size());
  for (Index i = 0; i <= chain.level_of(start) + 1; ++i)
    mobility.nominal.segment(chain.x_offset(i), n) = nominal;
  Zero zero = find_zero(F, start, mobility);
  if (zero.found) return zero;
  mobility.frozen = 0;
  zero = find_zero(F, start, mobility);
  if (!zero.found) return zero;
  SparseMatrixXd identity(n, n);
  identity.setIdentity();
  return least_zero(
      F,
      [&](const VectorXd& y) {
        return Quadratic{0.5 * y.head(n).squaredNorm(), y.head(n), identity};
      },
      zero, mobility);
}

}  // namespace

ConstraintLadder DiscreteConstraintAlgorithm::run(
    const std::shared_ptr<const ImplicitSystem>& system,
    const std::shared_ptr<const DiscretizationMap>& map, double h,
    const InitialGuess& guess) const {
  const ChainArray chain(system, map, h, guess.t, guess.x);
  const Manifold& M = *system->manifold();
  const Index n = chain.base_size();
  const VectorXd step = guess.v.size() > 0 ? VectorXd(h * (chain.basis().transpose() * guess.v))
                                           : VectorXd(VectorXd::Zero(n));
  const VectorXd nominal = (chain.basis().transpose() * (M.coframe(guess.x) * guess.x)).cwiseAbs();
  VectorXd y = VectorXd::Zero(n);
  ConstraintLadder ladder;
  bool stopped = false;
  for (Index k = 0; k <= options_.max_level && !stopped; ++k) {
    VectorXd start = longer(chain, y, step, k);
    if (k == 0 && guess.z.size() > 0) start.segment(chain.z_offset(0), guess.z.size()) = guess.z;
    const Zero zero = nearest(chain, start, nominal);
    if (!zero.found) {
      LadderLevel empty;
      empty.k = k;
      empty.is_empty = true;
      empty.residual = chain.residual(zero.y).lpNorm<Eigen::Infinity>();
      ladder.levels.push_back(empty);
      ladder.verdict = Verdict::inconsistent;
      ladder.reason = "No chain of " + std::to_string(k + 1) + " steps was found near the point.";
      break;
    }
    y = zero.y;
    ladder.levels = ladder_levels(chain, y, zero.uncertainty);
    if (k > 0) {
      const LadderLevel &last = ladder.levels.back(),
                        &before = ladder.levels[ladder.levels.size() - 2];
      stopped = last.dim_S == before.dim_S && last.dim_M == before.dim_M;
    }
  }
  ladder.jet = y;
  ladder.moved = y.head(n).norm();
  ladder.point = {guess.t, chain.point(y, 0), VectorXd(), VectorXd()};
  if (ladder.verdict == Verdict::inconsistent) return ladder;
  const LadderLevel& last = ladder.levels.back();
  ladder.degrees_of_freedom = last.dim_M;
  ladder.gauge_dimension = last.fibre();
  if (!stopped) {
    ladder.reason =
        "The dimensions still fell at level " + std::to_string(last.k) + ", the highest allowed.";
    return ladder;
  }
  ladder.index = last.k - 1;
  ladder.verdict = ladder.gauge_dimension == 0 ? Verdict::regular : Verdict::gauge;
  return ladder;
}

}  // namespace courant
