// TrajectoryRows: which rows of a run are written, and which are kept for expectations.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "courant/running/observer_elsewhere.hpp"
#include "courant/running/run_clock.hpp"
#include "courant/running/run_keeper.hpp"

namespace courant {

// The trajectory of a run: its columns, the steps that have a row, and the rows between steps that are asked
// for by their times.
class TrajectoryRows {
 public:
  // All of these outlive this. `kept`: rows that expectations ask for, by their times.
  TrajectoryRows(const Experiment& experiment, const Observer& observer, const RunClock& clock,
                 std::map<double, VectorXd>& kept);

  // The names of the quantities of a row, and the numbers of a row that are written.
  std::vector<std::string> names() const;
  const std::vector<Index>& columns() const { return columns_; }
  // Whether there is a column of the transformed time: unless the experiment has another use for its name.
  bool has_tau() const { return has_tau_; }

  // Of the columns: t first.
  std::vector<std::string> column_names() const;
  std::vector<std::string> headings() const;

  // The row of a state of the run, if it has one, as that has with which an event ends it.
  void write(const RunMoment& moment, RunKeeper& keeper, bool is_end = false) const;
  // The rows that are asked for between step k - 1 and the one that was made, step k. In transformed time
  // also those that expectations ask for; those at the end of a step, keep() has.
  void write_between(Stepper& stepper, long k, ObserverElsewhere& elsewhere,
                     RunKeeper& keeper) const;
  // A row that may be one that expectations ask for by its time.
  void keep(double t, const VectorXd& row) const;

 private:
  bool has_step(long k) const;  // of the state after step k
  void visit_times(Stepper& stepper, long k, ObserverElsewhere& elsewhere, RunKeeper& keeper) const;

  const Experiment& experiment_;
  const Observer& observer_;
  const RunClock& clock_;
  std::map<double, VectorXd>& kept_;
  std::vector<Index> columns_;
  bool has_all_columns_, has_tau_;
};

}  // namespace courant
