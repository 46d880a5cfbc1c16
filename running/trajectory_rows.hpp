// TrajectoryRows: which rows of a run are written, and which are kept for expectations.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/running/observer_elsewhere.hpp"
#include "courant/running/run_clock.hpp"
#include "courant/running/run_folder.hpp"
#include "courant/running/trajectory_writer.hpp"

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
  bool has_step(long k) const;  // of the state after step k

  // The file; of a run that goes on, as it was at its checkpoint.
  void open(const RunFolder& folder);
  TrajectoryWriter& file() const { return *file_; }  // after open()

  // The rows that are asked for between step k - 1 and the one that was made, step k. In transformed time
  // also those that expectations ask for; those at the end of a step, keep() has.
  void write_between(Stepper& stepper, long k, ObserverElsewhere& elsewhere);
  // A row that may be one that expectations ask for by its time.
  void keep(double t, const VectorXd& row);

 private:
  void visit_times(Stepper& stepper, long k, ObserverElsewhere& elsewhere);

  const Experiment& experiment_;
  const Observer& observer_;
  const RunClock& clock_;
  std::map<double, VectorXd>& kept_;
  std::vector<Index> columns_;
  bool has_tau_;
  std::unique_ptr<TrajectoryWriter> file_;
};

}  // namespace courant
