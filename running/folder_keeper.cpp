#include "courant/running/folder_keeper.hpp"

#include <utility>

namespace courant {

FolderKeeper::FolderKeeper(std::filesystem::path path, ExistingRun existing,
                           std::chrono::duration<double> checkpoint_interval)
    : path_(std::move(path)), existing_(existing), checkpoint_interval_(checkpoint_interval) {}

void FolderKeeper::check(const Experiment& experiment) {
  RunFolder::check(path_, existing_, experiment);
}

const Checkpoint* FolderKeeper::begin(const Experiment& experiment) {
  format_ = experiment.output.format;
  folder_.emplace(path_, existing_, experiment);
  if (folder_->checkpoint()) return &*folder_->checkpoint();
  if (existing_ == ExistingRun::resume) folder_->remove_rows();
  return nullptr;
}

void FolderKeeper::refuse_checkpoint(const std::string& what) const {
  throw UnusableFolder(folder_->checkpoint_file().string() + ": " + what);
}

void FolderKeeper::open(const RunOpening& opening) {
  const auto& from = folder_->checkpoint();
  const HashedBytes::Record* const events =
      from && from->event_watch ? &from->event_watch->file : nullptr;
  rows_ = make_trajectory_writer(format_, folder_->path(), opening.headings,
                                 from ? &from->trajectory : nullptr);
  if (!opening.events.empty())
    events_.emplace(folder_->path() / "events.csv", opening.event_columns, events);
  checkpoints_.emplace(
      [this](const Checkpoint& checkpoint) {  // which never promises what is not there
        rows_->sync();
        if (events_) events_->sync();
        folder_->write_checkpoint(checkpoint);
      },
      checkpoint_interval_);
}

void FolderKeeper::append(double t, const std::optional<double>& tau,
                          const Eigen::Ref<const VectorXd>& values) {
  if (!tau) return rows_->append(t, values);
  with_tau_.resize(values.size() + 1);
  with_tau_ << *tau, values;
  rows_->append(t, with_tau_);
}

void FolderKeeper::append_event(const std::string& name, double t,
                                const Eigen::Ref<const VectorXd>& values) {
  events_->append(name, t, values);
}

void FolderKeeper::keep(const std::function<Checkpoint()>& checkpoint) {
  Checkpoint now = checkpoint();
  now.trajectory = rows_->record();
  if (now.event_watch) now.event_watch->file = events_->record();
  checkpoints_->keep(std::move(now));
}

void FolderKeeper::close() {
  rows_->flush();
  if (events_) events_->flush();
  checkpoints_->flush();
}

void FolderKeeper::tell(const RunSummary& summary) { folder_->write_summary(summary); }

}  // namespace courant
