// RunKeeper: what keeps a run.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/running/checkpoint.hpp"
#include "courant/running/run_summary.hpp"
#include "courant/running/run_watcher.hpp"

namespace courant {

// What is known of a run before its first row.
struct RunOpening {
  std::vector<std::string> columns;        // names: t, in transformed time tau, then quantities
  std::vector<std::string> headings;       // the same with the units of the experiment
  std::vector<std::string> events;         // names of its events
  std::vector<std::string> event_columns;  // of what is measured there, behind t
  const ConstraintLadder& ladder;
  std::shared_ptr<const Integrator> integrator;  // null where no step can be made
};

// Where a run goes: a folder (FolderKeeper), memory (RunInMemory). run() knows no other place. It calls these in
// the order of their declarations, in its own thread.
class RunKeeper {
 public:
  virtual ~RunKeeper() = default;

  // Before anything is computed. Throws where the run cannot be kept.
  virtual void check(const Experiment&) {}
  // Once there is a start: from now on the run is kept. Where it goes on; null if it begins.
  virtual const Checkpoint* begin(const Experiment&) { return nullptr; }
  // Throws that the checkpoint which begin() gave is of another run.
  [[noreturn]] virtual void refuse_checkpoint(const std::string& what) const {
    throw std::invalid_argument("checkpoint: " + what);
  }
  // Of the run, empty where it has none.
  virtual std::string id() const { return {}; }
  virtual void open(const RunOpening& opening) = 0;

  // A row; `values` are those of the columns behind t and tau.
  virtual void append(double t, const std::optional<double>& tau,
                      const Eigen::Ref<const VectorXd>& values) = 0;
  // An occurrence of an event; `values` are those of its columns.
  virtual void append_event(const std::string& name, double t,
                            const Eigen::Ref<const VectorXd>& values) = 0;
  // Each state of the run, those without a row too.
  virtual void see(const RunMoment&) {}
  // An epoch has ended; the checkpoint is made when it is asked for.
  virtual void keep(const std::function<Checkpoint()>&) {}
  // No row follows.
  virtual void close() {}
  // At the beginning and at the end.
  virtual void tell(const RunSummary& summary) = 0;
};

}  // namespace courant
