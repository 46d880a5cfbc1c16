#include "courant/running/trajectory_rows.hpp"

#include <algorithm>
#include <cstdint>

#include "courant/running/run_watchers.hpp"

namespace courant {

TrajectoryRows::TrajectoryRows(const Experiment& experiment, const Observer& observer,
                               const RunClock& clock, std::map<double, VectorXd>& kept)
    : experiment_(experiment), observer_(observer), clock_(clock), kept_(kept) {
  const std::vector<std::string> all = names();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i >= observer.coordinate_count() || experiment.output.has_column(all[i]))
      columns_.push_back(static_cast<Index>(i));
  has_tau_ = clock.is_transformed() && std::ranges::find(all, "tau") == all.end();
}

std::vector<std::string> TrajectoryRows::names() const {
  std::vector<std::string> names = observer_.names();
  names.resize(observer_.written_count());
  return names;
}

bool TrajectoryRows::has_step(long k) const {
  return !experiment_.time || clock_.is_last() ||
         experiment_.output.is_written(k, *experiment_.time);
}

void TrajectoryRows::open(const RunFolder& folder) {
  std::vector<std::string> columns = {"t"};
  if (has_tau_) columns.push_back("tau");
  for (const Index i : columns_) columns.push_back(observer_.names()[static_cast<std::size_t>(i)]);
  for (std::string& column : columns) column = experiment_.output.heading(column);
  std::optional<std::uintmax_t> keep;
  if (folder.checkpoint()) keep = folder.checkpoint()->trajectory_size;
  file_ = make_trajectory_writer(experiment_.output.format, folder.path(), columns, keep);
}

void TrajectoryRows::keep(double t, const VectorXd& row) {
  for (const double moment : experiment_.expect.times)
    if (moment == t) kept_[moment] = row;
}

void TrajectoryRows::write_between(Stepper& stepper, long k, ObserverElsewhere& elsewhere) {
  if (clock_.is_transformed()) return visit_times(stepper, k, elsewhere);
  if (experiment_.output.at.empty()) return;
  const TimeSpan& time = *experiment_.time;
  for (const double t : experiment_.output.between(k, time)) {
    const VectorXd& row = elsewhere.row_within(stepper.part((t - time.time(k - 1)) / time.step));
    file_->append(t, row(columns_));
  }
}

void TrajectoryRows::visit_times(Stepper& stepper, long k, ObserverElsewhere& elsewhere) {
  const TimeSpan& time = *experiment_.time;
  const double before = stepper.last().before.t;
  const double after = clock_.is_last() ? time.until : stepper.last().after.t;
  std::map<double, bool> moments;  // whether they are written
  for (const double t : experiment_.expect.times) moments[t] = false;
  for (const double t : experiment_.output.at) moments[t] = true;
  for (const auto& [t, is_written] : moments) {
    if (!(t > before && (t < after || (t == after && is_written && !clock_.is_last())))) continue;
    const double share = stepper.share_at(std::min(t, stepper.last().after.t));
    const VectorXd& row = elsewhere.row_within(stepper.part(share));
    keep(t, row);
    if (!is_written) continue;
    const double tau = time.time(k - 1) + share * stepper.last().h;
    append_row(*file_, t, has_tau_ ? std::optional(tau) : std::nullopt, row(columns_));
  }
}

}  // namespace courant
