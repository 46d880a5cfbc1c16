#include "courant/running/consistent_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <unordered_set>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/integrators/certificate/certificate_in_digits.hpp"
#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/ladder_in_units.hpp"
#include "courant/integrators/certificate/movements.hpp"
#include "courant/integrators/certificate/nearest_start.hpp"
#include "courant/integrators/methods/integrator_in_units.hpp"
#include "courant/running/given_quantities.hpp"
#include "courant/running/impulsive_start.hpp"
#include "courant/running/solved_unknowns.hpp"
#include "courant/running/start_stages.hpp"
#include "courant/running/undefined_formula.hpp"

namespace courant {
namespace {

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

std::vector<Index> indices(const Flags& flags) {
  std::vector<Index> list;
  for (Index i = 0; i < flags.size(); ++i)
    if (flags[i]) list.push_back(i);
  return list;
}

std::string with_zeros(const Experiment& experiment) {
  return experiment.initial.x.given.all() ? "" : " (with 0 for what is not given)";
}

void check_near_manifold(const Experiment& experiment, const VectorXd& x) {
  const Manifold& M = *experiment.model.system->manifold();
  try {
    M.project(x);
  } catch (const std::domain_error& error) {
    throw ExperimentError("/initial", "no point of " + M.name() + " is near the initial values" +
                                          with_zeros(experiment) + ": " +
                                          without_place(error.what()));
  }
}

// Unknowns that were given nothing are tried at 0; where these divide, or are under a root, elsewhere.
void place_unknowns(const Experiment& experiment, InitialGuess& guess) {
  constexpr Index most = 200;
  const ImplicitSystem& system = *experiment.model.system;
  const Index m = system.auxiliary_size();
  if (m == 0 || m > most) return;
  const VectorXd v =
      guess.v.size() > 0 ? guess.v : VectorXd::Zero(system.manifold()->tangent_dimension());
  const VectorXd z = guess.z.size() > 0 ? guess.z : system.auxiliary_guess(guess.x, guess.v);
  std::vector<Index> open;
  // Unknowns without names cannot be given.
  const Flags& given = experiment.initial.z.given;
  for (Index i = 0; i < m; ++i)
    if (i >= given.size() || !given[i]) open.push_back(i);
  const auto defined =
      defined_unknowns(system, {.t = guess.t, .x = guess.x, .v = v, .z = z}, std::move(open));
  if (defined && *defined != z) guess.z = *defined;
}

void check_finite(const Experiment& experiment, const InitialGuess& guess) {
  const ImplicitSystem& system = *experiment.model.system;
  const VectorXd v =
      guess.v.size() > 0 ? guess.v : VectorXd::Zero(system.manifold()->tangent_dimension());
  const VectorXd z = guess.z.size() > 0 ? guess.z : system.auxiliary_guess(guess.x, guess.v);
  const VectorXd residual = system.residual(guess.x, v, z, guess.t);
  for (Index i = 0; i < residual.size(); ++i)
    if (!std::isfinite(residual[i])) {
      const std::string where = "at the initial values" + with_zeros(experiment);
      const std::string why =
          undefined_formula(experiment, {.t = guess.t, .x = guess.x, .v = v, .z = z}, where);
      throw ExperimentError("/initial", !why.empty() ? why
                                                     : equation_in_words(system, i) + " is " +
                                                           number_text(residual[i]) + ' ' + where +
                                                           "; expected a finite number");
    }
}

// The coordinates that are not given and change along a direction on M_f along which no given one changes; none
// if what is given of (v, z) may tell these directions apart.
std::vector<Index> free_coordinates(const Manifold& M, const ConstraintLadder& ladder,
                                    const InitialValues& initial) {
  const LinearMap<double> basis = M.tangent_basis(ladder.point.x);
  const LinearMap<double> motion = M.frame(ladder.point.x) * basis;
  MatrixXd conditions = ladder.conormals() * basis;
  const std::vector<Index> given = indices(initial.x.given);
  // On Rⁿ directions are coordinates: those that are given, and those that no conormal contains, need no matrix.
  std::vector<Index> sought, free;
  if (motion.is_identity()) {
    for (Index i = 0; i < motion.cols(); ++i)
      if (!initial.x.given[i]) (conditions.col(i).isZero(0.0) ? free : sought).push_back(i);
    conditions = conditions(Eigen::all, sought).eval();
  } else {
    const Index count = conditions.rows();
    conditions.conservativeResize(count + std::ssize(given), Eigen::NoChange);
    conditions.bottomRows(std::ssize(given)) = motion.entries()(given, Eigen::all);
    sought = indices(!initial.x.given);
  }
  const MatrixXd directions =
      sought.empty() ? MatrixXd() : kernel(conditions, {.data_error = 1e-9});
  if (std::ssize(free) + directions.cols() <=
      initial.velocity.given.count() + initial.z.given.count())
    return {};
  for (std::size_t k = 0; k < sought.size(); ++k) {
    const auto row = static_cast<Index>(k);
    const double length = motion.is_identity()
                              ? directions.row(row).norm()
                              : (motion.entries().row(sought[k]) * directions).norm();
    if (length > 1e-6) free.push_back(sought[k]);
  }
  std::sort(free.begin(), free.end());
  return free;
}

// Names of coordinates that are not given and that neither M_f nor the given velocities and
// unknowns determine.
std::vector<std::string> undetermined(const Experiment& experiment,
                                      const ConstraintLadder& ladder) {
  if (ladder.verdict != Verdict::regular && ladder.verdict != Verdict::gauge) return {};
  const InitialValues& initial = experiment.initial;
  if (initial.x.given.all() || experiment.model.starts_at_zero) return {};
  const std::vector<Index> free =
      free_coordinates(*experiment.model.system->manifold(), ladder, initial);
  const auto& coordinates = experiment.model.system->names().coordinates;
  std::vector<std::string> names;
  for (const Index i : free) names.push_back(coordinates[static_cast<std::size_t>(i)]);
  return names;
}

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

void forget_moves_of_what_was_not_given(ConstraintLadder& ladder, const Experiment& experiment) {
  const InitialValues& initial = experiment.initial;
  const ImplicitSystem::Names& names = experiment.model.system->names();
  std::unordered_set<std::string> given;
  for (Index i = 0; i < initial.x.given.size(); ++i) {
    const std::string& name = names.coordinates[static_cast<std::size_t>(i)];
    if (initial.x.given[i]) given.insert(name);
    if (initial.velocity.given[i]) given.insert(name + "'");
  }
  for (Index i = 0; i < initial.z.given.size(); ++i)
    if (initial.z.given[i]) given.insert(names.auxiliary[static_cast<std::size_t>(i)]);
  std::erase_if(ladder.moves, [&](const Movement& move) { return !given.contains(move.name); });
}

// Whether the search found no point of the last level: what it was to keep may be why.
bool has_no_start(const ConstraintLadder& ladder) {
  return ladder.verdict == Verdict::inconsistent || ladder.verdict == Verdict::not_reached;
}

// Whether the equations of a ladder, and what was held, hold at its point, in all digits or in four: a search has units of
// its own, which may be those of what it met on its way.
enum class MetTo { all_digits, four_digits };
bool is_met(const InitialGuess& held, const ConstraintLadder& ladder,
            const std::shared_ptr<const ChartEquations>& equations, MetTo digits) {
  if (has_no_start(ladder) || ladder.levels.empty() || ladder.jet.size() == 0) return true;
  const ConsistentPoint consistent(equations, held, {});
  constexpr double part = 1e-4;
  const ConsistentJet jet = consistent.jet_of(ladder);
  return digits == MetTo::all_digits ? consistent.is_met_at(jet)
                                     : consistent.is_met_at(jet, part, part);
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

// The ladder of a system whose numbers may be far apart: then that in natural units, and where that in the units of
// the experiment has another verdict about a point, a doubt.
class LadderSearch {
 public:
  LadderSearch(std::shared_ptr<const ChartEquations> equations,
               std::shared_ptr<const JetEquations> in_digits, const InitialGuess& guess,
               const VectorXd& weight, Decider decider)
      : equations_(std::move(equations)),
        in_digits_(std::move(in_digits)),
        weight_(weight),
        decider_(decider),
        own_(algorithm(weight)) {
    if (is_of_digits_alone(decider)) return;
    const std::shared_ptr<const ImplicitSystem>& system = equations_->system();
    const VectorXd z = guess.z.size() > 0 ? guess.z : system->auxiliary_guess(guess.x, guess.v);
    const auto units = needed_units(equations_, {.t = guess.t, .x = guess.x, .v = guess.v, .z = z});
    if (!units) return;
    measured_ = std::make_shared<SystemInUnits>(system, *units);
    equations_in_units_ = std::make_shared<const ChartEquations>(measured_);
    // The metric of the experiment, up to a factor.
    length_ = units->coordinates.maxCoeff();
    const VectorXd parts = units->coordinates / length_;
    in_units_.emplace(algorithm(weight.cwiseProduct(parts.cwiseAbs2())));
  }

  // What the equations themselves make of the guess, without what they imply; where it contradicts them, what
  // they leave the least residual at. Nothing where they are not defined.
  std::optional<State> nearly_solved(const InitialGuess& guess) const {
    ConstraintAlgorithm::Options options;
    options.max_level = 0;
    const ConstraintLadder ladder = ConstraintAlgorithm(options).run(equations_, guess);
    if (ladder.levels.empty() || !ladder.point.x.allFinite()) return std::nullopt;
    return ladder.point;
  }

  ConstraintLadder run(const InitialGuess& guess) const {
    if (!in_digits_) return by_bounds(guess);
    ConstraintAlgorithm::Options options;
    options.metric = SparseMatrixXd(weight_.asDiagonal());
    return is_of_digits_alone(decider_)
               ? certificate_in_digits(*in_digits_, guess, options, decider_)
               : decided_together(by_bounds(guess), *in_digits_, guess, options);
  }

 private:
  ConstraintLadder by_bounds(const InitialGuess& guess) const {
    ConstraintLadder own = own_.run(equations_, guess);
    if (!measured_) return own;
    const State start =
        measured_->units().measure({.t = guess.t, .x = guess.x, .v = guess.v, .z = guess.z});
    InitialGuess there = guess;
    there.t = start.t;
    there.x = start.x;
    there.v = start.v;
    there.z = start.z;
    ConstraintLadder ladder = restored(in_units_->run(equations_in_units_, there), *measured_);
    // A search that comes to no point in one kind of units says nothing of what was found in the other.
    const bool is_lost = ladder.verdict == Verdict::not_reached && !has_no_start(own);
    if (ladder.levels.empty() || is_lost) return own;
    ladder.moved *= length_;
    // A search that ended without a point where numbers are far apart says nothing of the point that was found here.
    if (!are_alike(ladder, own) && !has_no_start(own))
      ladder.doubts.push_back(
          "In the units of the experiment, in which numbers are far apart, the ladder is another "
          "one, " +
          to_string(own.verdict) + ".");
    return ladder;
  }

  static ConstraintAlgorithm algorithm(const VectorXd& weight) {
    ConstraintAlgorithm::Options options;
    options.metric = SparseMatrixXd(weight.asDiagonal());
    return ConstraintAlgorithm(options);
  }

  std::shared_ptr<const ChartEquations> equations_;
  std::shared_ptr<const JetEquations> in_digits_;  // null: decided by bounds
  VectorXd weight_;
  Decider decider_;
  ConstraintAlgorithm own_;
  std::shared_ptr<const SystemInUnits> measured_;
  std::shared_ptr<const ChartEquations> equations_in_units_;
  std::optional<ConstraintAlgorithm> in_units_;
  double length_ = 1.0;
};

// The search for a start that keeps what is given if it can. If velocities or coordinates cannot be kept, it is the
// nearest: positions change least, then velocities and momenta, in the metric of the kinetic energy where there is one,
// then unknowns; what is held does not.
class StartSearch {
 public:
  StartSearch(const Experiment& experiment, Decider decider)
      : experiment_(experiment),
        initial_(experiment.initial),
        coframe_(manifold_near_start().coframe(initial_.x.values)),
        are_velocities_(
            experiment.model.system->manifold()->velocities_among_components(initial_.x.values)),
        guess_(first_guess()),
        weight_(
            initial_.x.given.cast<double>().matrix().cwiseProduct(initial_.cost_of_coordinates())),
        stages_(start_stages(experiment, guess_)),
        decider_(decider),
        equations_(std::make_shared<const ChartEquations>(experiment.model.system)),
        in_digits_(equations_in_digits(equations_, decider)),
        ladders_(equations_, in_digits_, guess_, weight_, decider) {}

  ConsistentStart find() const {
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

  // Nothing is held.
  ConstraintLadder free() const { return ladders_.run(guess_); }
  // From other coordinates, with velocities and unknowns that are held.
  ConstraintLadder free_from(const VectorXd& x) const {
    InitialGuess guess = holding(guess_, initial_.x.held, initial_.velocity.held, initial_.z.held);
    guess.x = x;
    return met(guess, ladders_.run(guess));
  }

  // What is held, which a point has to round-off.
  void keep_to_the_bit(State& point) const {
    const InitialGuess held =
        holding(guess_, initial_.x.held, initial_.velocity.held, initial_.z.held);
    for (const Index i : held.hold_x) point.x[i] = guess_.x[i];
    for (const Index i : held.hold_v) point.v[i] = guess_.v[i];
    for (const Index i : held.hold_z) point.z[i] = guess_.z[i];
  }

 private:
  const Manifold& manifold_near_start() const {
    check_near_manifold(experiment_, initial_.x.values);
    return *experiment_.model.system->manifold();
  }

  InitialGuess first_guess() const {
    InitialGuess guess{.t = experiment_.start(), .x = initial_.x.values};
    if (initial_.velocity.given.any()) guess.v = coframe_ * initial_.velocity.values;
    if (initial_.z.given.any()) guess.z = initial_.z.values;
    place_unknowns(experiment_, guess);
    check_finite(experiment_, guess);
    return guess;
  }

  // Velocities or unknowns.
  bool more_is_given() const { return initial_.velocity.given.any() || initial_.z.given.any(); }

  InitialGuess holding(InitialGuess guess, const Flags& x, const Flags& velocities,
                       const Flags& unknowns) const {
    guess.hold_x = indices(x);
    guess.hold_v = indices(components_of(velocities, are_velocities_, coframe_));
    guess.hold_z = indices(unknowns);
    return guess;
  }

  // All that is given, of coordinates what x has.
  ConstraintLadder all_kept(const VectorXd& x) const {
    InitialGuess guess = guess_;
    guess.x = x;
    return all_kept(guess);
  }
  // All that is given, with the values that the guess has.
  ConstraintLadder all_kept(const InitialGuess& guess, MetTo digits = MetTo::all_digits) const {
    const InitialGuess held =
        holding(guess, initial_.x.given, initial_.velocity.given, initial_.z.given);
    return met(held, ladders_.run(held), digits);
  }
  // Whether coordinates moved, and by what is none next to them: zeros alone are measured by 1.
  bool moves_by_round_off(const ConstraintLadder& ladder) const {
    constexpr double round_off = 1e-15;
    if (has_no_start(ladder)) return false;
    const double size = guess_.x.norm(), moved = (ladder.point.x - guess_.x).norm();
    return moved > 0.0 && moved <= round_off * (size > 0.0 ? size : 1.0);
  }
  ConstraintLadder met(const InitialGuess& held, ConstraintLadder ladder,
                       MetTo digits = MetTo::all_digits) const {
    if (is_met(held, ladder, equations_, digits)) return ladder;
    ladder.verdict = Verdict::not_reached;
    ladder.reason = "The equations, and what was held, do not vanish where the search ended.";
    return ladder;
  }
  // Of what is held alone. Among numbers so large that they hide the digits of a point, the search begins again at the
  // point that it came to.
  ConstraintLadder free_ladder() const {
    constexpr int most_searches = 10;
    InitialGuess guess = holding(guess_, initial_.x.held, initial_.velocity.held, initial_.z.held);
    ConstraintLadder ladder = ladders_.run(guess);
    for (int search = 1;
         search < most_searches && !is_met(guess, ladder, equations_, MetTo::four_digits) &&
         ladder.point.x.norm() < guess.x.norm();
         ++search) {
      guess.x = initial_.x.held.select(guess.x, ladder.point.x);
      ladder = ladders_.run(guess);
    }
    return ladder;
  }

  // With the momenta that belong to the velocities by the equations themselves, where they are not given. Likewise of
  // unknowns, where some are given: those that the others have beside these, from `open` for all of them.
  InitialGuess with_what_follows(double open = 0.0) const {
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
  ConstraintLadder nearest_to_given_unknowns(const Search& search) const {
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
  // Unknowns that move by less, next to their size, do not.
  static constexpr double kNotMoved = 1e-6;

  // From the momenta that belong to the velocities, which move no farther than they must.
  ConstraintLadder coordinates_kept() const {
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
  ConsistentStart coordinates_moved() const {
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

  // How far what is nearest first of all, the positions, is from what is given.
  double moved_first(const State& point) const {
    return stages_.empty() ? 0.0 : stages_.front()(point).of(point);
  }

  // The nearest start of the last level of a ladder, which has one; that of the ladder if it is none.
  ConsistentStart nearest(const ConstraintLadder& ladder) const {
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
  std::string impasse(const State& point) const {
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

  const Experiment& experiment_;
  const InitialValues& initial_;
  LinearMap<double> coframe_;
  Flags are_velocities_;  // of the components of v
  InitialGuess guess_;
  VectorXd weight_;  // of the coordinates that are given
  std::vector<NearestStart::Stage> stages_;
  Decider decider_;
  std::shared_ptr<const ChartEquations> equations_;
  std::shared_ptr<const JetEquations> in_digits_;
  LadderSearch ladders_;
};

// Which of the coordinates that are held a start without that would move.
std::string held_moves(const Experiment& experiment, const ConstraintLadder& free) {
  const auto& names = experiment.model.system->names().coordinates;
  std::vector<std::string> moves;
  for (const Movement& move : free.moves) {
    const auto found = std::ranges::find(names, move.name);
    if (found != names.end() && experiment.initial.x.held[found - names.begin()])
      moves.push_back(move.name + " from " + number_text(move.from) + " to " +
                      number_text(move.to));
  }
  constexpr std::size_t most = 6;
  if (moves.empty()) return "";
  return "; they hold near by with " +
         word_list(std::span(moves).first(std::min(moves.size(), most))) +
         (moves.size() > most ? ", …" : "");
}

// What the equations that contradict each other are at a point, in the numbers of the experiment: those that are not 0
// there. Of derivatives of equations the point alone does not tell.
std::string violations(const ImplicitSystem& system, const ConstraintLadder& ladder,
                       const State& point) {
  constexpr double nothing = 1e-9;
  const VectorXd residual = system.residual(point.x, point.v, point.z, point.t);
  const double least = nothing * residual.lpNorm<Eigen::Infinity>();
  const auto& names = system.names().equations;
  std::vector<std::string> parts;
  for (const NamedEquation& equation : ladder.contradiction) {
    const auto found = std::ranges::find(names, equation.name);
    if (found == names.end() || equation.derivative > 0) continue;
    const Index i = found - names.begin();
    if (std::fabs(residual[i]) > least)
      parts.push_back(equation_in_words(system, i) + " is " + number_text(residual[i], 3));
  }
  constexpr std::size_t most = 3;
  if (parts.empty()) return "";
  return ": " + word_list(std::span(parts).first(std::min(parts.size(), most))) +
         (parts.size() > most ? ", …" : "");
}

// Unknowns that nobody gave, and that are round-off of others or of 1, are 0 where this solves each equation no worse: of
// diodes at rest a search leaves 10⁻¹⁸ V.
void drop_round_off_of_unknowns(const Experiment& experiment, State& point) {
  constexpr double round_off = 1e-15;
  const InitialValues& initial = experiment.initial;
  if (point.z.size() == 0 || point.z.size() != initial.z.given.size() || !point.z.allFinite())
    return;
  const double least = round_off * (1.0 + point.z.lpNorm<Eigen::Infinity>());
  const VectorXd z = (initial.z.given || point.z.array().abs() > least).select(point.z, 0.0);
  if (z == point.z) return;
  const ImplicitSystem& system = *experiment.model.system;
  const VectorXd before = system.residual(point.x, point.v, point.z, point.t),
                 after = system.residual(point.x, point.v, z, point.t);
  if ((after.array().abs() <= before.array().abs()).all()) point.z = z;
}

// Whether these coordinates, which nothing determines, are determined where velocities that are not given are 0.
bool determined_at_rest(const Experiment& experiment, const std::vector<std::string>& missing,
                        Decider decider) {
  Json document = experiment.document;
  Json& initial = document["initial"];
  if (!initial.is_object() || initial.contains("rest")) return false;
  initial["rest"] = true;
  try {
    const Experiment resting = read_experiment_document(document);
    const auto& names = resting.model.system->names().coordinates;
    const auto is_told = [&](const Flags& given, const std::string& name) {
      const auto found = std::ranges::find(names, name);
      return found != names.end() && given[found - names.begin()];
    };
    for (const std::string& name : missing)
      if (!is_told(resting.initial.x.given, name) &&
          !(name.starts_with("p_") && is_told(resting.initial.velocity.given, name.substr(2))))
        return false;
    const ConsistentStart start = consistent_start(resting, decider);
    return !has_no_start(start) && start.moves.empty();
  } catch (const ExperimentError&) {
    return false;
  }
}

ConsistentStart found_start(const Experiment& experiment, Decider decider) {
  const StartSearch search(experiment, decider);
  const ConsistentStart nearest = search.find();
  ConsistentStart ladder =
      impulsive_start(experiment, nearest, [&](const VectorXd& x) { return search.free_from(x); });
  ladder.is_nearest = ladder.is_impulse || nearest.is_nearest;
  if (!ladder.is_impulse) ladder.impasse = nearest.impasse;
  forget_moves_of_what_was_not_given(ladder, experiment);
  const InitialValues& initial = experiment.initial;
  const bool any_held = initial.x.held.any() || initial.velocity.held.any() || initial.z.held.any();
  if (has_no_start(ladder)) {
    ladder.moves.clear();
    ladder.moved = 0.0;
    if (!any_held) return ladder;
    const ConstraintLadder free = search.free();
    if (has_no_start(free)) return free;
    const bool is_empty = !ladder.levels.empty() && ladder.levels.back().is_empty;
    State where = ladder.point;
    if (is_empty) search.keep_to_the_bit(where);
    throw ExperimentError("/hold",
                          "what is held contradicts the constraints" +
                              (is_empty ? violations(*experiment.model.system, ladder, where) +
                                              held_moves(experiment, free)
                                        : std::string()) +
                              "; expected values that satisfy them");
  }
  search.keep_to_the_bit(ladder.point);
  drop_round_off_of_unknowns(experiment, ladder.point);
  if (const auto missing = undetermined(experiment, ladder); !missing.empty()) {
    const auto told = std::span(missing).first(std::min<std::size_t>(missing.size(), 5));
    throw ExperimentError("/initial", "nothing determines " + word_list(told) +
                                          (missing.size() > 5 ? ", …" : "") +
                                          "; expected more initial values" +
                                          (determined_at_rest(experiment, missing, decider)
                                               ? ", or \"rest\": true among them, with which "
                                                 "velocities that are not given are 0"
                                               : ""));
  }
  return ladder;
}

}  // namespace

ConsistentStart consistent_start(const Experiment& written, Decider decider) {
  if (!written.initial.quantities.empty()) {
    Experiment experiment = written;
    experiment.initial = with_quantities(written);
    experiment.initial.quantities.clear();
    ConsistentStart ladder = consistent_start(experiment, decider);
    if (ladder.verdict != Verdict::inconsistent)
      for (Movement& move : moved_quantities(written, ladder.point))
        ladder.moves.push_back(std::move(move));
    return ladder;
  }
  const Experiment& experiment = written;
  const auto fails = [&](const std::exception& error) {
    return ExperimentError("/initial", "the constraint algorithm fails at the initial values" +
                                           with_zeros(experiment) + ": " +
                                           without_place(error.what()));
  };
  try {
    return found_start(experiment, decider);
  } catch (const ExperimentError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw ExperimentError(
        "/system", "takes more memory than there is: the constraint algorithm has matrices of " +
                       std::to_string(experiment.model.system->manifold()->ambient_dimension()) +
                       " coordinates");
  } catch (const std::domain_error& error) {
    throw fails(error);
  } catch (const std::runtime_error& error) {
    throw fails(error);
  }
}

}  // namespace courant
