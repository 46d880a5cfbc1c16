#include "courant/running/checkpoint_keeper.hpp"

#include <algorithm>
#include <utility>

namespace courant {

CheckpointKeeper::CheckpointKeeper(std::function<void(const Checkpoint&)> write,
                                   std::chrono::duration<double> interval)
    : write_(std::move(write)), interval_(interval) {}

void CheckpointKeeper::keep(Checkpoint checkpoint) {
  kept_ = std::move(checkpoint);
  if (Clock::now() - written_ >= interval_) flush();
}

void CheckpointKeeper::flush() {
  if (!kept_) return;
  const auto begin = Clock::now();
  write_(*kept_);
  kept_.reset();
  written_ = Clock::now();
  interval_ = std::max<std::chrono::duration<double>>(interval_, 200 * (written_ - begin));
}

}  // namespace courant
