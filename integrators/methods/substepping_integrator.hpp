// SubsteppingIntegrator: steps that are made in several where one does not do.
#pragma once

#include <vector>

#include "courant/integrators/methods/integrator_adaptor.hpp"

namespace courant {

// The times first + k period, k = 0, 1, 2, …; with period 0 the first alone.
struct Corner {
  double first = 0.0;
  double period = 0.0;
};

// A method Φ_h with substeps:
//
//   * At corners: a step from t to t + h with the corners t < c₁ < … < c_m < t + h is
//     Φ_{t+h-c_m} ∘ … ∘ Φ_{c₁-t}. Where a system bends its dependence on t, at the edges of a pulse, a step over
//     the bend has an error of order 1.
//   * In halves: a step, or a piece of one, that Φ refuses (SolveError) is made as two of half the size, and each
//     of those that is refused again, up to the given number of times.
//   * In parts: a step, or a piece between corners, is made as so many of the same size.
//
// A step depends on the state and on h alone, as those of every method. Order, symmetry, form and energy are
// those of Φ; symmetry where no step is halved, since the way back meets the same corners, but may not be
// refused where the way there was. SolverStatistics::divisions counts the steps that were made in halves. A
// Step has the pieces as its parts, each with the parts that Φ makes it of. In formulas() h is the size of a
// piece.
class SubsteppingIntegrator final : public IntegratorAdaptor {
 public:
  struct Options {
    std::vector<Corner> corners = {};
    int halvings = 0;
    int parts = 1;
  };
  // Corners nearer to an end of the step than this part of it are taken for the end.
  static constexpr double kSmallestPart = 1e-6;

  // Throws std::invalid_argument unless times and periods are finite, periods not negative, there are
  // 0 to 60 halvings and at least one part.
  SubsteppingIntegrator(const std::shared_ptr<const Integrator>& method, Options options);

  // The same with so many times as many parts.
  std::shared_ptr<const SubsteppingIntegrator> in_parts(int parts) const;

  // The corners within the step from t to t + h, in the order of the way. Throws SolveError for more than
  // 1e4 of one period.
  static std::vector<double> corners_within(const std::vector<Corner>& corners, double t, double h);

 private:
  class Trajectory;

  std::unique_ptr<Stepper> do_stepper() const override;
  // The product of those of the pieces.
  std::shared_ptr<const StepDifferential> do_differential() const override;

  Options options_;
};

}  // namespace courant
