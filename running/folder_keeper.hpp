// FolderKeeper: a run in its folder.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "courant/running/checkpoint_keeper.hpp"
#include "courant/running/event_file.hpp"
#include "courant/running/run_folder.hpp"
#include "courant/running/run_keeper.hpp"
#include "courant/running/trajectory_writer.hpp"

namespace courant {

// Keeps a run as files (docs/experiment-format.md has them). Nothing is written before begin().
class FolderKeeper final : public RunKeeper {
 public:
  FolderKeeper(std::filesystem::path path, ExistingRun existing,
               std::chrono::duration<double> checkpoint_interval);

  // These throw UnusableFolder, those after them OutputError.
  void check(const Experiment& experiment) override;
  const Checkpoint* begin(const Experiment& experiment) override;
  [[noreturn]] void refuse_checkpoint(const std::string& what) const override;
  std::string id() const override { return folder_->id(); }
  void open(const RunOpening& opening) override;
  void append(double t, const std::optional<double>& tau,
              const Eigen::Ref<const VectorXd>& values) override;
  void append_event(const std::string& name, double t,
                    const Eigen::Ref<const VectorXd>& values) override;
  void keep(const std::function<Checkpoint()>& checkpoint) override;
  void close() override;
  void tell(const RunSummary& summary) override;

 private:
  std::filesystem::path path_;
  ExistingRun existing_;
  std::chrono::duration<double> checkpoint_interval_;
  Output::Format format_ = Output::Format::csv;
  std::optional<RunFolder> folder_;
  std::unique_ptr<TrajectoryWriter> rows_;
  std::optional<EventFile> events_;
  std::optional<CheckpointKeeper> checkpoints_;
  VectorXd with_tau_;
};

}  // namespace courant
