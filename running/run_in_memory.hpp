// RunInMemory: a run as objects.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "courant/running/run_curve.hpp"
#include "courant/running/runner.hpp"

namespace courant {

// Rows of numbers under names, one row after the other.
struct RunTable {
  std::vector<std::string> names = {};
  std::vector<double> values = {};

  std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
  // Throws std::invalid_argument where there is no column of this name.
  std::vector<double> column(const std::string& name) const;
};

// What a run without a folder leaves. It makes the rows that a run in a folder writes, with the same bits:
//
//   const RunInMemory pendulum = run_in_memory(read_experiment(text));
//   pendulum.rows.column("q"), pendulum.outcome.summary.ladder, pendulum.events.at("turning")
struct RunInMemory {
  RunTable rows = {};                           // t first
  std::map<std::string, RunTable> events = {};  // by name: t, then what is measured there
  RunOutcome outcome = {};                      // status, message, summary with the ladder
  std::shared_ptr<RunCurve> curve =
      nullptr;  // null unless it was asked for, or where no step was made
};

// How it is run, and what is kept of it.
struct RunInMemoryOptions {
  RunOptions run = {};     // its folder is not looked at
  bool has_curve = false;  // keeps all states, for rows at any time
};

// Throws as run() does, but for what concerns folders.
RunInMemory run_in_memory(const Experiment& experiment, const RunInMemoryOptions& options = {});

}  // namespace courant
