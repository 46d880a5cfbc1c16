// SolveError: a step that could not be made.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace courant {

// Thrown by Stepper::step, which leaves the state as it was.
class SolveError : public std::runtime_error {
 public:
  enum class Reason {
    diverged,      // no solution was found
    singular,      // a matrix or a value is not finite
    left_domain,   // the step leads to a state that is not finite
    disconnected,  // no solution was found that is connected to the state
  };
  // Where the solution ends that is connected to the state.
  struct Reach {
    double h;            // the size of the last step that has it
    std::string remedy;  // a sentence; empty: that a shorter step would do
  };
  // The message is "<method>: the step of <h> from t = <time> <what happened>", and with a reach
  // "…: the one that is ends at a step of <reach>. <remedy>". `what_happened` ends with a full stop unless
  // there is a reach.
  SolveError(Reason reason, const std::string& method, double time, double h,
             std::string what_happened, std::vector<double> residuals = {},
             std::optional<Reach> reach = std::nullopt);

  // What a method says whose step needed this one: of its own step of `h` from `time`. `unit`: what the
  // unit of time of this error is in the time of that method.
  SolveError of_step(const std::string& method, double time, double h, double unit = 1.0) const;

  Reason reason() const { return reason_; }
  double time() const { return time_; }  // of the state that the step began at
  double step_size() const { return h_; }
  const std::vector<double>& residuals() const { return residuals_; }  // ‖F‖_∞ of the iterates
  // Where the solution ends that is connected to the state, if that was found.
  const std::optional<Reach>& reach() const { return reach_; }

 private:
  Reason reason_;
  double time_, h_;
  std::string what_happened_;
  std::vector<double> residuals_;
  std::optional<Reach> reach_;
};

}  // namespace courant
