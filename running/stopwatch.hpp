// What a run takes.
#pragma once

#include <chrono>
#include <ctime>

namespace courant {

// What passes by the clock, and what the processor spends on all threads of this process, since it was made.
class Stopwatch {
 public:
  double wall_seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }
  double cpu_seconds() const { return processor() - processor_begin_; }

 private:
  using Clock = std::chrono::steady_clock;

  static double processor() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
  }

  Clock::time_point begin_ = Clock::now();
  double processor_begin_ = processor();
};

}  // namespace courant
