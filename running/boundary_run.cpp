#include "courant/running/boundary_run.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/words/message.hpp"
#include "courant/integrators/step/solve_error.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/varied_system.hpp"

namespace courant {
namespace {

const std::string kBoundary = "/boundary";

PreparedMethod prepared(const Experiment& experiment, const ConsistentStart& start) {
  try {
    return experiment.method->prepare({.system = experiment.model.system,
                                       .ladder = start,
                                       .initial = start.point,
                                       .step = experiment.time->step,
                                       .backend = Backend::interpreter,
                                       .vocabulary = &experiment.model.vocabulary});
  } catch (const ExperimentError&) {  // has its own place
    throw;
  } catch (const std::invalid_argument& error) {
    throw ExperimentError("/method", without_place(error.what()));
  }
}

// The problem of an experiment, whose words it keeps.
BoundaryProblem boundary_problem(const Experiment& experiment) {
  const ConsistentStart start = consistent_start(experiment);
  if (start.verdict != Verdict::regular)
    throw ExperimentError(
        kBoundary, "needs a regular system, of which a point says how it moves; the verdict is \"" +
                       to_string(start.verdict) + "\"");
  const Boundary& boundary = *experiment.boundary;
  const TimeSpan& time = *experiment.time;
  const PreparedMethod method = prepared(experiment, start);
  BoundaryProblem problem;
  problem.method = method.integrator;
  problem.ladder = start;
  problem.guess = method.initial;
  if (!boundary.guess.empty())
    problem.guess_at = [boundary, model = experiment.model](State& state) {
      take_guess(boundary, model, state);
    };
  problem.h = time.step;
  problem.steps = time.steps;
  problem.segments = boundary.segments;
  problem.initial = end_conditions(boundary, experiment.model, false);
  problem.final = end_conditions(boundary, experiment.model, true);
  problem.is_periodic = boundary.is_periodic;
  problem.has_free_time = boundary.has_free_time;
  return problem;
}

BoundarySolution solved(const Experiment& experiment, const std::atomic<bool>* stop) {
  const BoundaryOptions options{.stop = stop};
  const auto& continuation = experiment.boundary->continuation;
  if (!continuation) return solve_boundary_problem(boundary_problem(experiment), options);
  const Sensitivities::Variable parameter{.name = continuation->parameter,
                                          .pointer = kBoundary + "/continuation/parameter",
                                          .parameter = continuation->parameter};
  const auto at = [&](double c) { return boundary_problem(with_number(experiment, parameter, c)); };
  BoundarySolution solution =
      continue_boundary_problem(at, continuation->from, continuation->to, options);
  if (!solution.reason.empty())
    solution.reason = "with " + continuation->parameter + ": " + solution.reason;
  return solution;
}

// Coordinates that are given at the beginning have the bits that were typed, not round-off beside them.
void take_given(const Experiment& experiment, Json& initial) {
  constexpr double round_off = 1e-10;
  const Model& model = experiment.model;
  const SymbolTable symbols = model.vocabulary.symbols({.t = Expr(experiment.start())});
  for (const BoundaryCondition& condition : experiment.boundary->initial) {
    Findings findings;
    if (!initial.contains(condition.name) || !check(condition.value, symbols, findings)) continue;
    const Expr value = evaluate(condition.value, symbols);
    if (value.is_constant() && std::fabs(value.value() - initial[condition.name].get<double>()) <=
                                   round_off * (1.0 + std::fabs(value.value())))
      initial[condition.name] = value.value();
  }
}

// A search that could not begin, where the guess is.
BoundarySolution not_begun(const Experiment& experiment, const std::exception& error) {
  BoundarySolution solution;
  solution.start = consistent_start(experiment).point;
  solution.h = experiment.time->step;
  solution.steps = experiment.time->steps;
  solution.reason = "no run leads from the initial values, which are the guess, to the end: " +
                    without_place(error.what());
  return solution;
}

}  // namespace

std::shared_ptr<const Experiment> with_boundary_solved(const Experiment& experiment,
                                                       const std::atomic<bool>* stop) {
  auto solution = std::make_shared<BoundarySolution>();
  try {
    *solution = solved(experiment, stop);
  } catch (const ExperimentError&) {  // has its own place
    throw;
  } catch (const std::invalid_argument& error) {
    throw ExperimentError(kBoundary, without_place(error.what()));
  } catch (const SolveError& error) {
    *solution = not_begun(experiment, error);
  } catch (const std::domain_error& error) {
    *solution = not_begun(experiment, error);
  }
  Json document = experiment.document;
  const auto& names = experiment.model.system->names().coordinates;
  Json initial = Json::object();
  for (std::size_t i = 0; i < names.size(); ++i)
    initial[names[i]] = solution->start.x[static_cast<Index>(i)];
  take_given(experiment, initial);
  const VectorXd& z = solution->start.z;
  const auto& unknowns = experiment.model.system->names().auxiliary;
  if (experiment.initial.z.given.size() == z.size() && std::ssize(unknowns) == z.size())
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      initial[unknowns[i]] = z[static_cast<Index>(i)];
  document["initial"] = initial;
  if (experiment.boundary->has_free_time) {
    document["time"]["step"] = solution->h;
    document["time"]["end"] = experiment.time->start + solution->duration();
  }
  auto result = std::make_shared<Experiment>(read_experiment_document(document));
  result->remarks = experiment.remarks;
  result->solution = std::move(solution);
  return result;
}

std::map<long, VectorXd> nodes_of_run(const Experiment& experiment) {
  std::map<long, VectorXd> nodes;
  const auto& solution = experiment.solution;
  if (!solution || !solution->needs_nodes) return nodes;
  for (std::size_t i = 1; i < solution->nodes.size(); ++i)
    nodes[solution->steps_before(i)] = solution->nodes[i].x;
  return nodes;
}

bool is_unsolved(const Experiment& experiment) {
  return experiment.solution && experiment.solution->verdict == BoundarySolution::Verdict::unsolved;
}

Json boundary_summary(const BoundarySolution& solution) {
  Json json{{"verdict", to_string(solution.verdict)}, {"duration", solution.duration()},
            {"iterations", solution.iterations},      {"changes", solution.changes},
            {"conditions", Json::object()},           {"jump", solution.jump}};
  for (const auto& [name, residual] : solution.conditions) json["conditions"][name] = residual;
  if (solution.closure) json["closure"] = *solution.closure;
  if (solution.needs_nodes) json["needs_nodes"] = true;
  if (!solution.reason.empty()) json["reason"] = solution.reason;
  if (solution.verdict == BoundarySolution::Verdict::unsolved) return json;
  const VectorXd& values = solution.rank.singular_values;
  json["family_dimension"] = solution.family_dimension;
  json["phase"] = solution.has_phase;
  json["unknowns"] = solution.rank.columns;
  json["rank"] = solution.rank.rank;
  json["gap"] = solution.rank.gap;
  json["singular_values"] = std::vector<double>(values.begin(), values.end());
  if (solution.conjugate_times) json["conjugate_times"] = *solution.conjugate_times;
  for (const auto& multiplier : solution.floquet)
    json["multipliers"].push_back({multiplier.real(), multiplier.imag()});
  return json;
}

std::vector<std::string> boundary_in_words(const BoundarySolution& solution) {
  std::vector<std::string> lines;
  if (solution.verdict == BoundarySolution::Verdict::unsolved) return lines;
  double greatest = solution.closure.value_or(0.0);
  for (const auto& condition : solution.conditions)
    greatest = std::fmax(greatest, std::fabs(condition.residual));
  const bool is_whole = !solution.needs_nodes;
  lines.push_back("The motion meets its conditions " +
                  (is_whole ? "to " + number_text(greatest, 2)
                            : "with jumps of " + number_text(solution.jump, 2) + " at its nodes") +
                  ", after " + std::to_string(solution.iterations) +
                  (solution.iterations == 1 ? " iteration" : " iterations") +
                  " of Newton's method. It takes " + number_text(solution.duration(), 10) + ".");
  if (!is_whole)
    lines.push_back("From its initial values alone it would miss them by " +
                    number_text(greatest, 2) +
                    ", so fast does round-off grow: the run goes on from node to node.");
  const RankDecision& rank = solution.rank;
  const std::string ranks = "the shooting matrix has rank " + std::to_string(rank.rank) + " of " +
                            std::to_string(rank.columns) + " unknowns, with a gap of " +
                            number_text(rank.gap, 2) + ".";
  if (solution.verdict == BoundarySolution::Verdict::family)
    lines.push_back("It is one of a family of " + std::to_string(solution.family_dimension) +
                    (solution.family_dimension == 1 ? " dimension: " : " dimensions: ") + ranks);
  else
    lines.push_back(
        "It is isolated" +
        std::string(solution.has_phase ? ", but for where on its way it begins: " : ": ") + ranks);
  if (solution.conjugate_times) {
    const auto& times = *solution.conjugate_times;
    std::string text = times.empty() ? "No point before the end is conjugate to the beginning."
                                     : "Conjugate to the beginning at t =";
    for (std::size_t i = 0; i < times.size() && i < 5; ++i)
      text += (i > 0 ? ", " : " ") + number_text(times[i]);
    if (!times.empty())
      text += times.size() > 5 ? ", …: no minimum beyond." : ": no minimum beyond.";
    lines.push_back(text);
  }
  if (solution.floquet.size() > 0) {
    std::string text = "Moduli of its multipliers:";
    for (Index i = 0; i < solution.floquet.size() && i < 12; ++i)
      text += (i > 0 ? ", " : " ") + number_text(std::abs(solution.floquet[i]));
    lines.push_back(text + (solution.floquet.size() > 12 ? ", …" : "."));
  }
  return lines;
}

}  // namespace courant
