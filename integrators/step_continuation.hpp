// The solution of a step that is connected to the state.
#pragma once

#include <memory>
#include <vector>

#include "courant/core/function.hpp"
#include "courant/core/linear_solver.hpp"

namespace courant {

// The equations G(y; h) = 0 of a step may have several solutions. The one that a step of h means is
// the end of the curve σ ↦ y(σ), G(y(σ); σ h) = 0, that begins at the state for σ → 0. This follows
// the curve up to σ = 1, or to where it turns back or ends.
//
// It begins with two points at a thousandth of the step or less, and goes on by extrapolation of the
// last two. A prediction must be right to a tenth, Newton's method with a matrix made afresh in each
// iteration has to contract to a quarter at once, and the sign of the determinant stays the same, so
// that a turning point is not stepped over. Else the step in σ is shortened; the first one tried
// leads to σ = 1. Not seen is a pair of turning points between two points on the curve. One object
// a trajectory.
class StepContinuation {
 public:
  // Group 0 of `equations` is y, whose first `displacements` entries are displacements from the
  // state: they are measured, and zero for h → 0. As are the last `shifts` entries, which are not
  // measured. Group `h` is the step size.
  struct Layout {
    Index displacements = 0, shifts = 0;
    Index h = 0;
  };
  StepContinuation(Function equations, const Layout& layout);

  struct Result {
    bool arrived = false;  // at σ = 1, y up to some seven digits of a displacement
    double reached = 0.0;  // the greatest σ that there is a solution for; 0: none was found
    bool at_first = true;  // from the beginning that is tried first
    long iterations = 0;
  };
  // y: at first what is predicted for σ = 1 by the state alone, in the end y(1), or y(reached).
  // `in` as for the equations; in[0] is not used. `size`: of the coordinates of the state.
  Result follow(VectorXd& y, const double* const* in, double size);

 private:
  // Leaves the last point on the curve in point_. `start`: what the state predicts.
  Result follow_from(const VectorXd& start, double beginning, const double* const* in, double size);
  // Newton's method from u_, for σ. False: it does not contract, or its first change is more than
  // `near`.
  bool converges(double sigma, const double* const* in, double size, double near, Result& result);
  void set(const VectorXd& u, double sigma, VectorXd& y) const;
  double moved(double sigma, double size) const;

  Function equations_;
  Layout layout_;
  std::vector<Index> contained_;  // unknowns that the equations contain
  std::unique_ptr<LinearSolver> solver_;
  std::vector<const double*> in_;
  double h_ = 0.0;
  int orientation_ = 0;  // of the curve so far
  // Unknowns of this σ with displacements and shifts divided by σ, those of the last points, and a
  // copy.
  VectorXd u_, point_, last_;
  VectorXd y_, all_, step_;
};

}  // namespace courant
