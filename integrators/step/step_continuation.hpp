// The solution of a step that is connected to the state.
#pragma once

#include <memory>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/core/expressions/inputs.hpp"
#include "courant/core/linear/linear_solver.hpp"

namespace courant {

// The equations G(y; h) = 0 of a step may have several solutions. The one that a step of h means is
// the end of the curve σ ↦ y(σ), G(y(σ); σ h) = 0, that begins at the state for σ → 0. This follows
// the curve up to σ = 1, or to where it turns back or ends.
//
// It begins at a thousandth of the step or less, with a solution from which Newton's method, its matrix made afresh in
// each iteration, contracts to a quarter after the first one, if need be after damped steps, and goes on along the
// tangent. A prediction must be right to a tenth, Newton's method has to contract at once, the sign of the determinant
// stays the same, and the tangents of both ends have to say by how much the prediction was wrong: those of two branches
// do not, so that turning points are not stepped over, nor pairs of them. Else the step in σ is shortened; the first
// one tried leads to σ = 1.
//
// Where the state does not obey all equations, as after a step of Method 1 with constraints, displacements do not
// vanish for σ → 0: the curve begins with a jump to where they hold. Where they have no limit either, as velocities
// that grow like 1/σ and multipliers like 1/σ², what the state predicts is carried to the solution at the step itself,
// along
//
//   G(y; h) = (1 - τ) G(y₀; h),   τ from 0 to 1
//
// by arcs like those above, and last the curve begins at a tenth of the step, with any solution that Newton's method
// finds. So near the state that the matrix loses rank to round-off, which that of the step itself has, nothing is seen,
// and no curve begins. One object a trajectory.
class StepContinuation {
 public:
  // Group 0 of `equations` is y, whose first `displacements` entries are displacements from the
  // state: they are measured, and zero for h → 0. As are the last `multipliers` entries, which are not
  // measured. Group `h` is the step size.
  struct Layout {
    Index displacements = 0, multipliers = 0;
    Index h = 0;
  };
  StepContinuation(Function equations, const Layout& layout);

  struct Result {
    bool arrived = false;         // at σ = 1, y up to some seven digits of a displacement
    double reached = 0.0;         // the greatest σ that there is a solution for; 0: none was found
    int arcs = 0;                 // that lead there from the beginning
    bool begins_at_state = true;  // or at a tenth of the step, with any solution
    long iterations = 0;
  };
  // y: at first what is predicted for σ = 1 by the state alone, in the end y(1), or y(reached).
  // `parameters`: of the equations; the place of their unknowns is not used. `size`: of the coordinates of
  // the state. `usual`: the sizes of displacements in the steps before, 0 where there are none.
  Result follow(VectorXd& y, const Inputs& parameters, double size, const VectorXd& usual);

 private:
  struct Point {
    double sigma = 0.0;
    VectorXd u, tangent;  // du/dσ
  };

  // A way to begin: whether displacements vanish for σ → 0, so that divided by σ they are smooth, or
  // not, and they are smooth themselves; whether the curve has to lead back towards the state; where.
  struct Attempt {
    bool vanishes, leads_back;
    double beginning, least;
  };

  bool begins(const Attempt& attempt, const VectorXd& start, double size, Result& result);
  void track(double size, Result& result);
  bool carries(const VectorXd& start, double size, Result& result);
  bool reaches(double next, double size, Result& result);
  // Newton's method from u_, for σ. False: it does not contract, or its first change is more than
  // `near`.
  bool converges(double sigma, double size, double near, Result& result);
  bool approach(double sigma, double size);
  bool differentiate(double sigma);
  void accept(double sigma);
  void evaluate(double sigma, bool with_jacobian);
  void set(const VectorXd& u, double sigma, VectorXd& y) const;
  bool shrinks(Index i) const;
  double largest_part(const VectorXd& change, double sigma, double size) const;

  Function equations_;
  Layout layout_;
  std::vector<Index> contained_;  // unknowns that the equations contain
  std::unique_ptr<LinearSolver> solver_;
  Inputs in_;                         // y_ and the parameters, with part_of_h_ for h
  double h_ = 0.0, part_of_h_ = 0.0;  // σ h
  int orientation_ = 0;               // of the curve so far
  VectorXd usual_;                    // sizes of displacements
  bool is_determined_ = true;         // whether the matrix of the step has full rank
  bool vanishes_ = true;              // as in Attempt
  Point point_;                       // the last one
  // Unknowns of this σ with displacements and multipliers divided by σ, and their derivative by σ.
  VectorXd u_, tangent_;
  VectorXd predicted_;
  VectorXd given_;     // G(y₀; h) where the prediction is carried, else empty
  double part_ = 0.0;  // 1 - τ
  VectorXd y_, all_, step_, rate_;
};

}  // namespace courant
