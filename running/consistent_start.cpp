#include "courant/running/consistent_start.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <span>
#include <stdexcept>
#include <unordered_set>

#include "courant/core/words/message.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/running/first_guess.hpp"
#include "courant/running/given_quantities.hpp"
#include "courant/running/impulsive_start.hpp"
#include "courant/running/start_search.hpp"
#include "courant/running/undefined_formula.hpp"
#include "courant/running/undetermined_start.hpp"

namespace courant {
namespace {

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
  if (const auto missing = undetermined_coordinates(experiment, ladder); !missing.empty()) {
    const auto told = std::span(missing).first(std::min<std::size_t>(missing.size(), 5));
    throw ExperimentError(
        "/initial", "nothing determines " + word_list(told) + (missing.size() > 5 ? ", …" : "") +
                        "; expected more initial values" +
                        (determined_at_rest(experiment, missing,
                                            [&](const Experiment& resting) {
                                              return consistent_start(resting, decider);
                                            })
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
