// CheckpointKeeper: when the checkpoints of a run are written.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "courant/running/checkpoint.hpp"

namespace courant {

// An epoch may take a millisecond, and a file that is synced takes some. So not each checkpoint is
// written: at least `interval` goes by from one to the next, and 200 times what writing took, so
// that it costs less than half a percent. A run that is killed goes on from the last that was.
class CheckpointKeeper {
 public:
  // `write` puts all that a checkpoint stands on on the disk, then the checkpoint.
  CheckpointKeeper(std::function<void(const Checkpoint&)> write,
                   std::chrono::duration<double> interval);

  // Throw what `write` throws.
  void keep(Checkpoint checkpoint);
  // The last one is written.
  void flush();

 private:
  using Clock = std::chrono::steady_clock;

  std::function<void(const Checkpoint&)> write_;
  std::chrono::duration<double> interval_;
  std::optional<Checkpoint> kept_;  // that is not written
  Clock::time_point written_ = Clock::now();
};

}  // namespace courant
