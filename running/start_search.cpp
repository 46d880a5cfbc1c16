#include "courant/running/start_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/movements.hpp"
#include "courant/running/first_guess.hpp"
#include "courant/running/start_stages.hpp"

namespace courant {
namespace {

// Unknowns that move by less, next to their size, do not.
constexpr double kNotMoved = 1e-6;

// The components of v = C ẋ that a part of the velocities ẋ determines; `are_velocities`: those that are one of them.
Flags components_of(const Flags& velocities, const Flags& are_velocities,
                    const LinearMap<double>& coframe) {
  if (are_velocities.all()) return velocities;
  const double negligible = 1e-9 * coframe.entries().cwiseAbs().maxCoeff();
  return Flags::NullaryExpr(coframe.rows(), [&](Index i) {
    if (are_velocities[i]) return velocities[i];
    bool any = false;
    for (Index j = 0; j < coframe.cols(); ++j) {
      if (std::fabs(coframe(i, j)) <= negligible) continue;
      if (!velocities[j]) return false;
      any = true;
    }
    return any;
  });
}

// The values that are given and are others at the point: coordinates, velocities dx/dt, unknowns, in the numbers of the
// experiment.
std::vector<Movement> movements_of_given(const Experiment& experiment, const State& point) {
  const InitialValues& initial = experiment.initial;
  const ImplicitSystem::Names& names = experiment.model.system->names();
  std::vector<Movement> moves;
  const auto compare = [&](const PartialVector& given, const VectorXd& found,
                           const std::vector<std::string>& of, const char* mark) {
    add_movements(
        given.values, found,
        [&](Index i) {
          return given.given[i] ? of[static_cast<std::size_t>(i)] + mark : std::string();
        },
        moves);
  };
  if (initial.x.given.any()) compare(initial.x, point.x, names.coordinates, "");
  if (initial.velocity.given.any())
    compare(initial.velocity, experiment.model.system->manifold()->frame(point.x) * point.v,
            names.coordinates, "'");
  if (initial.z.given.any()) compare(initial.z, point.z, names.auxiliary, "");
  return moves;
}

}  // namespace

StartSearch::StartSearch(const Experiment& experiment, Decider decider)
    : experiment_(experiment),
      initial_(experiment.initial),
      coframe_(manifold_near_start(experiment).coframe(initial_.x.values)),
      are_velocities_(
          experiment.model.system->manifold()->velocities_among_components(initial_.x.values)),
      guess_(first_guess(experiment, coframe_)),
      weight_(
          initial_.x.given.cast<double>().matrix().cwiseProduct(initial_.cost_of_coordinates())),
      stages_(start_stages(experiment, guess_)),
      decider_(decider),
      equations_(std::make_shared<const ChartEquations>(experiment.model.system)),
      in_digits_(equations_in_digits(equations_, decider)),
      ladders_(equations_, in_digits_, guess_, weight_, decider) {}

ConsistentStart StartSearch::find() const {
  ConsistentStart ladder = all_kept(guess_.x);
  if (has_no_start(ladder) && more_is_given()) {
    ladder = coordinates_kept();
    if (!has_no_start(ladder) && initial_.velocity.given.any()) ladder = nearest(ladder);
  }
  if (has_no_start(ladder)) {
    ConsistentStart moved = coordinates_moved();
    if (!moves_by_round_off(moved)) return moved;
    // Then coordinates were right, and what nobody gave is known to fewer digits, as the voltage of a diode at rest.
    ConstraintLadder kept = all_kept(guess_, MetTo::four_digits);
    return has_no_start(kept) ? moved : ConsistentStart(std::move(kept));
  }
  if (ladder.levels.back().is_solved) return ladder;
  // Equations that contradict what is given may nearly hold far away.
  ConsistentStart moved = coordinates_moved();
  return has_no_start(moved) || moved.is_ambiguous() ? ladder : moved;
}

ConstraintLadder StartSearch::free_from(const VectorXd& x) const {
  InitialGuess guess = holding(guess_, initial_.x.held, initial_.velocity.held, initial_.z.held);
  guess.x = x;
  return met(guess, ladders_.run(guess));
}

void StartSearch::keep_to_the_bit(State& point) const {
  const InitialGuess held =
      holding(guess_, initial_.x.held, initial_.velocity.held, initial_.z.held);
  for (const Index i : held.hold_x) point.x[i] = guess_.x[i];
  for (const Index i : held.hold_v) point.v[i] = guess_.v[i];
  for (const Index i : held.hold_z) point.z[i] = guess_.z[i];
}

InitialGuess StartSearch::holding(InitialGuess guess, const Flags& x, const Flags& velocities,
                                  const Flags& unknowns) const {
  guess.hold_x = indices(x);
  guess.hold_v = indices(components_of(velocities, are_velocities_, coframe_));
  guess.hold_z = indices(unknowns);
  return guess;
}

ConstraintLadder StartSearch::all_kept(const VectorXd& x) const {
  InitialGuess guess = guess_;
  guess.x = x;
  return all_kept(guess);
}

ConstraintLadder StartSearch::all_kept(const InitialGuess& guess, MetTo digits) const {
  const InitialGuess held =
      holding(guess, initial_.x.given, initial_.velocity.given, initial_.z.given);
  return met(held, ladders_.run(held), digits);
}

bool StartSearch::moves_by_round_off(const ConstraintLadder& ladder) const {
  constexpr double round_off = 1e-15;
  if (has_no_start(ladder)) return false;
  const double size = guess_.x.norm(), moved = (ladder.point.x - guess_.x).norm();
  return moved > 0.0 && moved <= round_off * (size > 0.0 ? size : 1.0);
}

bool StartSearch::is_met(const InitialGuess& held, const ConstraintLadder& ladder,
                         MetTo digits) const {
  if (has_no_start(ladder) || ladder.levels.empty() || ladder.jet.size() == 0) return true;
  const ConsistentPoint consistent(equations_, held, {});
  constexpr double part = 1e-4;
  const ConsistentJet jet = consistent.jet_of(ladder);
  return digits == MetTo::all_digits ? consistent.is_met_at(jet)
                                     : consistent.is_met_at(jet, part, part);
}

ConstraintLadder StartSearch::met(const InitialGuess& held, ConstraintLadder ladder,
                                  MetTo digits) const {
  if (is_met(held, ladder, digits)) return ladder;
  ladder.verdict = Verdict::not_reached;
  ladder.reason = "The equations, and what was held, do not vanish where the search ended.";
  return ladder;
}

// Among numbers so large that they hide the digits of a point, the search begins again at the
// point that it came to.
ConstraintLadder StartSearch::free_ladder() const {
  constexpr int most_searches = 10;
  InitialGuess guess = holding(guess_, initial_.x.held, initial_.velocity.held, initial_.z.held);
  ConstraintLadder ladder = ladders_.run(guess);
  for (int search = 1; search < most_searches && !is_met(guess, ladder, MetTo::four_digits) &&
                       ladder.point.x.norm() < guess.x.norm();
       ++search) {
    guess.x = initial_.x.held.select(guess.x, ladder.point.x);
    ladder = ladders_.run(guess);
  }
  return ladder;
}

// With the momenta that belong to the velocities by the equations themselves, where they are not given. Likewise of
// unknowns, where some are given: those that the others have beside these, from `open` for all of them.
InitialGuess StartSearch::with_what_follows(double open) const {
  InitialGuess guess = guess_;
  const bool follow_unknowns = initial_.z.given.any();
  if (follow_unknowns && open != 0.0) guess.z = initial_.z.given.select(guess.z, open);
  const InitialGuess given =
      holding(guess, initial_.x.given, initial_.velocity.given, initial_.z.given);
  if (const auto point = ladders_.nearly_solved(given)) {
    guess.x = initial_.x.given.select(guess.x, point->x);
    if (follow_unknowns && point->z.allFinite())
      guess.z = initial_.z.given.select(guess.z, point->z);
  }
  return guess;
}

// Of the ladders that a search has from what follows, the one that moves the given unknowns least. Equations such as those
// of a grid with loads of constant power have several solutions: from 0, which nobody gave, a search finds one
// without voltages; from the mean of the given ones that beside them.
template <class Search>
ConstraintLadder StartSearch::nearest_to_given_unknowns(const Search& search) const {
  ConstraintLadder found = search(with_what_follows());
  if (!initial_.z.given.any() || initial_.z.given.all()) return found;
  const double mean = initial_.z.given.select(initial_.z.values, 0.0).sum() /
                      static_cast<double>(initial_.z.given.count());
  if (mean == 0.0) return found;
  const auto moved = [&](const ConstraintLadder& ladder) {
    return has_no_start(ladder)
               ? std::numeric_limits<double>::infinity()
               : initial_.z.given.select(ladder.point.z - initial_.z.values, 0.0).norm();
  };
  const double by = moved(found);
  if (by <= kNotMoved * initial_.z.values.norm()) return found;
  ConstraintLadder other = search(with_what_follows(mean));
  return moved(other) < (1.0 - kNotMoved) * by ? other : found;
}

// From the momenta that belong to the velocities, which move no farther than they must.
ConstraintLadder StartSearch::coordinates_kept() const {
  const VectorXd weight = initial_.x.given.select(weight_, 1.0);
  ConstraintLadder ladder = nearest_to_given_unknowns([&](const InitialGuess& follows) {
    const InitialGuess guess =
        holding(follows, initial_.x.given, initial_.velocity.held, initial_.z.held);
    return met(guess, LadderSearch(equations_, in_digits_, guess, weight, decider_).run(guess));
  });
  ladder.moved = 0.0;  // what is given of x stays
  return ladder;
}

// With velocities and unknowns that can be kept at the point that is found, unless there is a nearer one; where they
// cannot, the nearest start.
ConsistentStart StartSearch::coordinates_moved() const {
  constexpr double nearer = 1e-6;
  const ConstraintLadder ladder = free_ladder();
  if (has_no_start(ladder)) return ladder;
  if (!more_is_given()) return nearest(ladder);
  ConsistentStart kept = all_kept(ladder.point.x);
  if (has_no_start(kept) || (kept.is_ambiguous() && !ladder.is_ambiguous())) {
    const ConstraintLadder moving = nearest_to_given_unknowns([&](const InitialGuess& follows) {
      const InitialGuess guess =
          holding(follows, initial_.x.held, initial_.velocity.held, initial_.z.held);
      return met(guess, ladders_.run(guess));
    });
    return nearest(has_no_start(moving) ? ladder : moving);
  }
  ConsistentStart near = nearest(kept);
  if (moved_first(near.point) < (1.0 - nearer) * moved_first(kept.point)) return near;
  kept.is_nearest = near.is_nearest;
  kept.moved = ladder.moved;
  kept.moves = movements_of_given(experiment_, kept.point);
  return kept;
}

double StartSearch::moved_first(const State& point) const {
  return stages_.empty() ? 0.0 : stages_.front()(point).of(point);
}

ConsistentStart StartSearch::nearest(const ConstraintLadder& ladder) const {
  if (ladder.jet.size() == 0) return ladder;
  const InitialGuess guess = holding(more_is_given() ? with_what_follows() : guess_,
                                     initial_.x.held, initial_.velocity.held, initial_.z.held);
  const NearestStart start(equations_, guess, ladder, stages_);
  if (start.outcomes().empty()) return met(guess, ladder, MetTo::four_digits);
  if (!start.is_consistent()) {
    ConsistentStart there = met(guess, ladder, MetTo::four_digits);
    there.is_nearest = false;
    there.moves = movements_of_given(experiment_, there.point);
    return there;
  }
  const State& point = start.point();
  ConsistentStart there = all_kept({.t = point.t, .x = point.x, .v = point.v, .z = point.z});
  if (has_no_start(there) || (there.is_ambiguous() && !ladder.is_ambiguous())) {
    there = ladder;
    there.point = point;
  }
  there.is_nearest = start.is_proven();
  constexpr double round_off = 1e-12;
  const double distance = start.outcomes().front().distance;
  there.moved = distance > round_off * guess_.x.norm() ? distance : 0.0;
  there.moves = movements_of_given(experiment_, there.point);
  there.impasse = impasse(there.point);
  if (!there.impasse.empty()) there.doubts.emplace_back(there.impasse);
  return there;
}

// A sentence where velocities or unknowns grow beyond all bounds as the given values are approached, so that there is
// a start as near to them as one likes, and none at them; else empty.
std::string StartSearch::impasse(const State& point) const {
  constexpr double near = 1e-9, large = 1e6, aside = 1e-3, fall = 1e3;
  const auto largest = [](const State& state) {
    return std::max(state.v.size() > 0 ? state.v.cwiseAbs().maxCoeff() : 0.0,
                    state.z.size() > 0 ? state.z.cwiseAbs().maxCoeff() : 0.0);
  };
  const VectorXd way = point.x - guess_.x;
  const double moved = way.norm(), size = 1.0 + guess_.x.norm(), there = largest(point);
  if (!(moved > 0.0) || moved > near * size || there < large * size) return "";
  const ConstraintLadder beside = free_from(guess_.x + aside * size / moved * way);
  if (has_no_start(beside) || fall * largest(beside.point) > there) return "";
  return "the equations have no solution at the initial values: as near as " +
         number_text(moved, 2) + " velocities or unknowns are " + number_text(there, 2) +
         ", and they grow beyond all bounds, as at an impasse or a pole";
}

}  // namespace courant
