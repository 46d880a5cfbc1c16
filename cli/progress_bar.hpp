// The progress of a run, on a terminal.
#pragma once

#include <iosfwd>

#include "courant/running/runner.hpp"

namespace courant::cli {

// One line, written over itself: share done, rate, remaining time, energy drift.
class ProgressBar {
 public:
  explicit ProgressBar(std::ostream& out) : out_(out) {}
  // Leaves no trace.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  std::ostream& out_;
  bool shown_ = false;
};

}  // namespace courant::cli
