// SolveError: a step that could not be made.
#pragma once

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
  // The message is "<method>: the step of <h> from t = <time> <what happened>".
  SolveError(Reason reason, const std::string& method, double time, double h,
             const std::string& what_happened, std::vector<double> residuals = {});

  Reason reason() const { return reason_; }
  double time() const { return time_; }  // of the state that the step began at
  double step_size() const { return h_; }
  const std::vector<double>& residuals() const { return residuals_; }  // ‖F‖_∞ of the iterates

 private:
  Reason reason_;
  double time_, h_;
  std::vector<double> residuals_;
};

// What the message says behind the time.
std::string what_happened(const SolveError& error);

}  // namespace courant
