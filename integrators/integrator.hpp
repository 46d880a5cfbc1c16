// Integrator and Stepper: a method made ready for a system, and one trajectory of it.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/structures/state.hpp"

namespace courant {

struct SolverStatistics {
  long steps = 0;
  long iterations = 0;
  long factorizations = 0;
  long failures = 0;  // steps that were tried again from a fresh factorisation and start
};

// A step that could not be made. The stepper stays at its last good state.
class SolveError : public std::runtime_error {
 public:
  enum class Reason { diverged, singular, left_domain };
  SolveError(Reason reason, double time, long step, std::vector<double> residuals,
             const std::string& message)
      : std::runtime_error(message),
        reason_(reason),
        time_(time),
        step_(step),
        residuals_(std::move(residuals)) {}

  Reason reason() const { return reason_; }
  double time() const { return time_; }  // of the last good state
  long step() const { return step_; }    // number of the step that failed, from 1
  const std::vector<double>& residuals() const { return residuals_; }  // ‖F‖_∞ of the iterates

 private:
  Reason reason_;
  double time_;
  long step_;
  std::vector<double> residuals_;
};

// One trajectory; not shared between threads.
class Stepper {
 public:
  virtual ~Stepper() = default;

  const State& state() const { return state_; }
  const SolverStatistics& statistics() const { return statistics_; }

  // x_k ↦ x_{k+1}. Throws SolveError and keeps the state.
  void step() {
    do_step();
    ++statistics_.steps;
  }

 protected:
  explicit Stepper(State initial) : state_(std::move(initial)) {}
  State state_;
  SolverStatistics statistics_;

 private:
  virtual void do_step() = 0;  // replaces state_, all or nothing
};

// A one-step method for one system, traced and compiled. Immutable; any number of trajectories may
// run at once.
class Integrator {
 public:
  virtual ~Integrator() = default;

  virtual std::string name() const = 0;
  // The order on smooth problems within the method's hypotheses.
  virtual int order() const = 0;
  virtual bool is_symmetric() const = 0;
  // Whether the step preserves the symplectic form of its phase space; no value: unknown.
  virtual std::optional<bool> is_symplectic() const { return std::nullopt; }
  virtual bool is_native() const = 0;  // whether compiled C code evaluates the step

  // A trajectory with step size h from `initial` (x on the manifold; v and z may be empty). Throws
  // std::invalid_argument unless h is finite and not zero; h < 0 goes back in time.
  virtual std::unique_ptr<Stepper> start(const State& initial, double h) const = 0;
};

}  // namespace courant
