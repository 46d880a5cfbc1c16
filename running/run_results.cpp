#include "courant/running/run_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/running/boundary_run.hpp"

namespace courant {
namespace {

double per(double amount, double count) { return count > 0.0 ? amount / count : 0.0; }

}  // namespace

std::vector<ExpectationResult> RunResults::expectations() const {
  RunRecord record;
  record.completed =
      (status == RunStatus::completed || status == RunStatus::not_finite) && !statistics.empty();
  for (const auto& [time, row] : rows_at_times)
    for (std::size_t i = 0; i < observer.names().size(); ++i)
      record.moments[time][observer.names()[i]] = row[static_cast<Index>(i)];
  record.ladder = &ladder;
  record.boundary = experiment.solution.get();
  if (!statistics.empty()) {
    for (std::size_t i = 0; i < observer.names().size(); ++i)
      record.quantities[observer.names()[i]] = statistics.record(static_cast<Index>(i));
    record.max_violation = max_violation();
    if (const PowerAccount* account = observer.account())
      record.max_imbalance = account->imbalance(),
      record.max_stage_imbalance = account->stage_imbalance();
  }
  if (event_watch) record.events = event_watch->records();
  std::vector<ExpectationResult> results;
  for (const auto& check : experiment.expect.checks) results.push_back(check(record));
  return results;
}

double RunResults::max_violation() const {
  double greatest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < observer.constraint_count(); ++i) {
    const auto record = statistics.record(static_cast<Index>(observer.first_constraint() + i));
    greatest = std::fmax(greatest, std::max(record.max, -record.min));
  }
  return greatest;
}

RunSummary RunResults::summary(RunStatus told_status,
                               const std::vector<ExpectationResult>& results) const {
  RunSummary told{
      .id = id,
      .status = told_status,
      .message = message,
      .warnings = warnings,
      .title = experiment.title,
      .system = experiment.model.description,
      .method = experiment.method ? experiment.method->description : "constraint algorithm",
      .metric = metric,
      .steps = steps,
      .ladder = ladder_report,
      .expectations = results};
  const bool is_stopped = event_watch && event_watch->stop();
  if (is_stopped) told.stopped_by = event_watch->stop()->event;
  if (const auto& time = experiment.time)
    told.time = {.start = time->start,
                 .end = time->is_transformed() || is_stopped ? t : time->time(steps),
                 .step = time->step};
  if (!statistics.empty()) {
    for (std::size_t i = 0; i < observer.first_constraint(); ++i) {
      const std::string& name = observer.names()[i];
      const QuantityRecord record = statistics.record(static_cast<Index>(i));
      if (i < observer.coordinate_count())
        told.final.emplace_back(name, record.final);
      else
        told.observables.emplace_back(name, record);
    }
    if (observer.constraint_count() > 0) told.max_violation = max_violation();
    if (const PowerAccount* account = observer.account(); account && steps > 0)
      told.power_balance = account->report();
  }
  if (const RunSensitivities* sensitivities = observer.sensitivities();
      sensitivities && !statistics.empty()) {
    VectorXd last = sensitivities->values();
    for (Index i = 0; i < last.size(); ++i)
      last[i] = statistics.record(observer.first_sensitivity() + i).final;
    told.sensitivities = sensitivities->summary(last);
  }
  if (experiment.solution) told.boundary = boundary_summary(*experiment.solution);
  for (const SymmetryFinding& finding : symmetries)
    told.symmetries.emplace_back(finding.name,
                                 RunSummary::Symmetry{.is_conserved = finding.report.is_conserved(),
                                                      .remark = finding.why_not_conserved()});
  if (event_watch)
    for (const auto& [name, record] : event_watch->records())
      told.events.emplace_back(
          name,
          RunSummary::Event{.count = record.count, .first = record.first, .last = record.last});
  const auto count = static_cast<double>(steps);
  told.solver = {.iterations_per_step = per(static_cast<double>(solver.iterations), count),
                 .factorizations_per_step = per(static_cast<double>(solver.factorizations), count),
                 .failures = solver.failures,
                 .second_attempts = solver.second_attempts,
                 .confirmations = solver.confirmations,
                 .divisions = solver.divisions};
  told.backend = backend;
  told.engine = engine;
  told.wall_seconds = wall_seconds;
  told.cpu_seconds = cpu_seconds;
  told.steps_per_second = per(count, wall_seconds);
  return told;
}

}  // namespace courant
