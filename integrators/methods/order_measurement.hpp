// The order that the errors of an integrator show.
#pragma once

#include <functional>
#include <map>

#include "courant/integrators/step/integrator.hpp"

namespace courant {

// Measures orders of an integrator from one state, with several steps, each once: by the distances between the ends
// of 2^k and of 2^{k+1} steps, k = 1 … 5, over the same time.
class OrderMeasurement {
 public:
  // A distance of states next to what they are, so that 1e-12 is round-off.
  using Separation = std::function<double(const State&, const State&)>;
  struct Errors {
    // Their slope; infinite where steps are exact, or so good that fewer than three errors are more than round-off.
    double order = 0.0;
    // Small ones that stay with half the step, as those of an ill-conditioned system: above what round-off is
    // taken to be, and no errors of the method.
    bool are_round_off = false;
  };

  // The integrator has to outlive the measurement.
  OrderMeasurement(const Integrator& integrator, State from, Separation separation)
      : integrator_(integrator), from_(std::move(from)), separation_(std::move(separation)) {}

  // Over the time h, which may be negative, of any size. Throws what a step throws.
  const Errors& errors(double h);

 private:
  const Integrator& integrator_;
  State from_;
  Separation separation_;
  std::map<double, Errors> errors_;  // by h
};

}  // namespace courant
