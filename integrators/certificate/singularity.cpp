#include "courant/integrators/certificate/singularity.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "courant/core/words/text_layout.hpp"
#include "courant/integrators/certificate/refined_obstruction.hpp"

namespace courant {
namespace {

// What a point nearby says of a point.
struct Comparison {
  enum class Outcome {
    alike,      // the same ranks
    different,  // ranks that are higher nearby: those of the point are not constant around it
    lower,      // ranks that are lower nearby, where a number was taken for noise
    unknown,    // no point
  };
  Outcome outcome = Outcome::unknown;
  bool is_certain = true;
  bool is_proven = true;        // at least, of ranks that are alike
  bool is_hidden = false;       // whether round-off hides if equations follow
  bool is_beside = false;       // whether the direction, which is no tangent, does not tell
  std::string difference = "";  // in words
};

Comparison compare(const std::vector<LadderLevel>& here, const std::vector<LadderLevel>& nearby,
                   const std::string& place = "at a consistent point nearby") {
  using Outcome = Comparison::Outcome;
  Comparison result{.outcome = Outcome::alike};
  for (std::size_t k = 0; k < std::min(here.size(), nearby.size()); ++k) {
    const LadderLevel &a = here[k], &b = nearby[k];
    if (a.is_empty || (a.dim_S == b.dim_S && a.dim_M == b.dim_M)) continue;
    if (b.all.rank < a.all.rank || b.without_tangent.rank < a.without_tangent.rank ||
        b.without_point.rank < a.without_point.rank) {
      result.outcome = Outcome::lower;
      continue;
    }
    const std::string level = subscript(static_cast<Index>(k));
    return {.outcome = Outcome::different,
            .difference = "(dim S" + level + ", dim M" + level + ") is (" +
                          std::to_string(a.dim_S) + ", " + std::to_string(a.dim_M) +
                          ") here and (" + std::to_string(b.dim_S) + ", " +
                          std::to_string(b.dim_M) + ") " + place + "."};
  }
  return result;
}

// What is seen from a point along a tangent direction.
Comparison compare_along(const VectorXd& tangent, const ConsistentPoint& consistent,
                         const ConsistentJet& at, const std::vector<LadderLevel>& levels,
                         const SparseMatrixXd& magnitude,
                         std::optional<RefinedObstruction>& obstruction) {
  using Outcome = Comparison::Outcome;
  using Answer = Obstruction::Answer;
  const auto near = consistent.find_displaced(at, 1e-3 * tangent, magnitude);
  Comparison result;
  if (near.jet.zero().found) {
    const std::vector<LadderLevel> there = levels_at(near.jet);
    result = compare(levels, there);
    result.is_certain = are_certain(there);
    result.is_proven = are_proven(there);
    if (result.outcome == Outcome::different) return result;
  }
  const Answer seen = obstruction ? obstruction->is_seen_along(tangent) : Answer::no;
  if (seen == Answer::no) return result;
  if (seen == Answer::beside) {
    result.is_beside = true;
    return result;
  }
  if (seen == Answer::unknown) {
    result.is_hidden = true;
    return result;
  }
  return {.outcome = Outcome::different,
          .is_certain = seen == Answer::yes,
          .difference =
              "The equations have solutions in fewer directions than their linear parts: one of "
              "the constraints has a vanishing gradient here."};
}

// What several directions say of a point.
class Votes {
 public:
  void count(const Comparison& comparison) {
    using Outcome = Comparison::Outcome;
    const Outcome outcome = comparison.outcome;
    is_hidden_ = is_hidden_ || comparison.is_hidden;
    if (outcome == Outcome::alike && comparison.is_certain && !comparison.is_hidden) {
      ++alike_;
      if (!comparison.is_beside) ++nothing_hidden_;
    }
    if (outcome == Outcome::alike || outcome == Outcome::lower) ++compared_;
    if (outcome == Outcome::alike && comparison.is_proven) ++proven_;
    if (outcome == Outcome::different && !comparison.is_certain) uncertain_ = comparison.difference;
    if (outcome == Outcome::different && comparison.is_certain) add_difference(comparison);
  }
  void add_difference(const Comparison& comparison) {
    if (++different_ == 1) certain_ = comparison.difference;
  }

  // A singular point looks singular from everywhere: two directions in which nothing is hidden are enough.
  bool are_decided() const { return different_ == 3 || (nothing_hidden_ == 2 && different_ == 0); }
  int different() const { return different_; }
  const std::string& difference() const { return certain_; }

  Singularity result() const {
    std::string uncertain = uncertain_;
    if (is_hidden_ && nothing_hidden_ < 2 && uncertain.empty())
      uncertain =
          "Round-off hides whether the equations have solutions in all directions that their "
          "linear parts have, or a constraint has a vanishing gradient here.";
    if (different_ >= 2 && different_ > alike_)
      return {.reason = certain_, .is_unanimous = alike_ == 0};
    const std::string& seen = certain_.empty() ? uncertain : certain_;
    return {.seen_once = seen,
            .is_compared = compared_ >= 2,
            .is_confirmed = seen.empty() && proven_ >= 2};
  }

 private:
  int alike_ = 0, nothing_hidden_ = 0, different_ = 0, compared_ = 0, proven_ = 0;
  bool is_hidden_ = false;
  std::string certain_, uncertain_;
};

// Ranks that hold at this instant only, as that of t at t = 0, are not those of a motion.
void look_later(Votes& votes, const ConsistentPoint& consistent, const ConsistentJet& at,
                const std::vector<LadderLevel>& levels, double time_unit) {
  constexpr std::array moments = {1e-3, 1e-2};
  const VectorXd nothing = VectorXd::Zero(at.zero().y.size());
  for (const double moment : moments) {
    const auto near = consistent.find_later(at, nothing, moment * time_unit);
    if (!near.jet.zero().found) continue;
    const std::vector<LadderLevel> there = levels_at(near.jet);
    const Comparison comparison = compare(levels, there, "a moment later");
    if (comparison.outcome == Comparison::Outcome::different && are_certain(there))
      votes.add_difference(comparison);
  }
}

}  // namespace

Singularity singularity(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const std::vector<LadderLevel>& levels, bool follow) {
  if (at.array().has_constant_jacobian()) return {.is_confirmed = true};
  constexpr Index dense_limit = 200;
  const bool is_small = at.zero().y.size() <= dense_limit;
  TangentDisplacement tangents(at.array(), at.zero().y, at.zero().nominal);
  std::optional<RefinedObstruction> obstruction;
  if (follow && is_small) obstruction.emplace(at, levels, tangents.magnitude());
  using Units = TangentDisplacement::Units;
  constexpr std::array units = {Units::own_sizes, Units::large_where_zero, Units::natural,
                                Units::own_sizes, Units::large_where_zero};
  Votes votes;
  for (const Units unit : units) {
    const VectorXd tangent =
        tangents.next_at_zero(is_small || unit != Units::large_where_zero ? unit : Units::natural);
    votes.count(compare_along(tangent, consistent, at, levels, tangents.magnitude(), obstruction));
    if (votes.are_decided()) break;
  }
  Singularity result;
  if (at.array().depends_on_time() && votes.different() == 0) {
    look_later(votes, consistent, at, levels, tangents.time_unit());
    if (votes.different() == 2) result.reason = votes.difference();
  }
  if (result.reason.empty()) result = votes.result();
  if (obstruction) result.is_refined = obstruction->has_refined_ranks();
  return result;
}

bool is_same_rank_at(const ConsistentJet& at, const std::vector<LadderLevel>& levels,
                     bool lowered) {
  constexpr double far_below = 1e-3;
  const auto is_hidden = [](const RankDecision& rank) { return rank.below > far_below; };
  if (!lowered && std::none_of(levels.begin(), levels.end(), [&](const LadderLevel& level) {
        return is_hidden(level.all) || is_hidden(level.without_tangent) ||
               is_hidden(level.without_point);
      }))
    return true;
  const std::vector<LadderLevel> exact =
      ladder_levels(at.array(), at.zero().y, (lowered ? 0.0 : far_below) * at.zero().uncertainty);
  return compare(levels, exact).outcome != Comparison::Outcome::different ||
         (!lowered && !are_certain(exact));
}

bool is_lower_where_given(const ConsistentPoint& consistent, const ConsistentJet& at,
                          const std::vector<LadderLevel>& levels) {
  constexpr double next_to = 1e-3;
  const DerivativeArray given = consistent.start().array();
  const VectorXd moved = at.array().origin() - given.origin();
  if (moved.isZero(0.0) || at.array().has_constant_jacobian() ||
      given.base_size() != moved.size() ||
      moved.lpNorm<Eigen::Infinity>() > next_to * given.origin().lpNorm<Eigen::Infinity>())
    return false;
  return compare(ladder_levels(given, at.zero().y, at.zero().uncertainty), levels).outcome ==
         Comparison::Outcome::different;
}

}  // namespace courant
