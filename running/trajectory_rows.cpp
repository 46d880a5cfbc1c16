#include "courant/running/trajectory_rows.hpp"

#include <algorithm>

namespace courant {

TrajectoryRows::TrajectoryRows(const Experiment& experiment, const Observer& observer,
                               const RunClock& clock, std::map<double, VectorXd>& kept)
    : experiment_(experiment), observer_(observer), clock_(clock), kept_(kept) {
  const std::vector<std::string> all = names();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i >= observer.coordinate_count() || experiment.output.has_column(all[i]))
      columns_.push_back(static_cast<Index>(i));
  has_all_columns_ = columns_.size() == all.size();
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

std::vector<std::string> TrajectoryRows::column_names() const {
  std::vector<std::string> names = {"t"};
  if (has_tau_) names.push_back("tau");
  for (const Index i : columns_) names.push_back(observer_.names()[static_cast<std::size_t>(i)]);
  return names;
}

std::vector<std::string> TrajectoryRows::headings() const {
  std::vector<std::string> headings = column_names();
  for (std::string& heading : headings) heading = experiment_.output.heading(heading);
  return headings;
}

void TrajectoryRows::keep(double t, const VectorXd& row) const {
  for (const double moment : experiment_.expect.times)
    if (moment == t) kept_[moment] = row;
}

void TrajectoryRows::write(const RunMoment& moment, RunKeeper& keeper, bool is_end) const {
  if (!is_end && !has_step(moment.k)) return;
  if (has_all_columns_)
    keeper.append(moment.t, moment.tau, moment.row.head(std::ssize(columns_)));
  else
    keeper.append(moment.t, moment.tau, moment.row(columns_));
}

void TrajectoryRows::write_between(Stepper& stepper, long k, ObserverElsewhere& elsewhere,
                                   RunKeeper& keeper) const {
  if (clock_.is_transformed()) return visit_times(stepper, k, elsewhere, keeper);
  if (experiment_.output.at.empty()) return;
  const TimeSpan& time = *experiment_.time;
  for (const double t : experiment_.output.between(k, time)) {
    const VectorXd& row = elsewhere.row_within(stepper.part((t - time.time(k - 1)) / time.step));
    keeper.append(t, std::nullopt, row(columns_));
  }
}

void TrajectoryRows::visit_times(Stepper& stepper, long k, ObserverElsewhere& elsewhere,
                                 RunKeeper& keeper) const {
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
    keeper.append(t, has_tau_ ? std::optional(tau) : std::nullopt, row(columns_));
  }
}

}  // namespace courant
