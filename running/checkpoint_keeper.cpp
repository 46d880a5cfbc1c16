#include "courant/running/checkpoint_keeper.hpp"

#include <algorithm>
#include <utility>

namespace courant {

CheckpointKeeper::CheckpointKeeper(std::filesystem::path file, TrajectoryWriter& writer,
                                   std::chrono::duration<double> interval)
    : file_(std::move(file)), writer_(writer), interval_(interval) {}

void CheckpointKeeper::keep(Checkpoint checkpoint) {
  kept_ = std::move(checkpoint);
  if (Clock::now() - written_ >= interval_) flush();
}

void CheckpointKeeper::flush() {
  if (!kept_) return;
  const auto begin = Clock::now();
  writer_.flush();  // first: the checkpoint never promises rows that are not there
  write_checkpoint(file_, *kept_);
  kept_.reset();
  written_ = Clock::now();
  interval_ = std::max<std::chrono::duration<double>>(interval_, 200 * (written_ - begin));
}

}  // namespace courant
