// CheckpointKeeper: the file of the last checkpoint of a run.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

#include "courant/running/checkpoint.hpp"
#include "courant/running/trajectory_writer.hpp"

namespace courant {

// An epoch may take a millisecond, and a file takes a tenth of that. So not each checkpoint is
// written: at least `interval` goes by from one to the next, and 200 times what writing took, so
// that it costs less than half a percent. A run that is killed goes on from the last that was.
class CheckpointKeeper {
 public:
  // `writer`, that of the rows which checkpoints stand on, has to outlive it.
  CheckpointKeeper(std::filesystem::path file, TrajectoryWriter& writer,
                   std::chrono::duration<double> interval);

  // Throws OutputError.
  void keep(Checkpoint checkpoint);
  // The last one is in the file. Throws OutputError.
  void flush();

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path file_;
  TrajectoryWriter& writer_;
  std::chrono::duration<double> interval_;
  std::optional<Checkpoint> kept_;  // that is not in the file
  Clock::time_point written_ = Clock::now();
};

}  // namespace courant
