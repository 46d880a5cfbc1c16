// The projection onto M_f along a trajectory of Method 2.
#pragma once

#include <array>
#include <limits>

#include "courant/integrators/methods/constrain_first_functions.hpp"
#include "courant/integrators/step/predictor.hpp"
#include "courant/integrators/step/step_solver.hpp"
#include "courant/integrators/step/transported_conormals.hpp"
#include "courant/integrators/step/transported_directions.hpp"
#include "courant/integrators/step/transported_frame.hpp"

namespace courant {

// Takes points near M_f to M_f, one after the other: solves
//
//   (x, v, z) ∈ S_f,   x ∈ M_f,   R_x(B W(x) μ) = near     (Section 7.2)
//
// for (ξ, ξ', …, z, …, μ), where ξ is x in the chart at a guess of it. W is taken at the last iterate,
// until that no longer changes. Where x will be, and the other unknowns, are foreseen from the points
// before. Holds workspace: one object a trajectory, whose basis of tangent vectors it moves.
class ConstrainFirstProjection {
 public:
  // `functions` and `basis` outlive this object.
  ConstrainFirstProjection(const ConstrainFirstFunctions& functions, TransportedFrame& basis);

  // A step that leads to a point near M_f.
  struct Approach {
    const State& before;
    StepSolver::Attempt attempt;
    double t;                             // at its end
    Eigen::Ref<const VectorXd> from_M_f;  // μ of the step: how far the point is from M_f
    bool goes_on;                         // whether this is a step like the last ones
  };
  // The state that P takes `near` to, from unknown(). The basis and W are left at it. Throws SolveError,
  // and std::domain_error as Projector::directions does.
  void project(const VectorXd& near, const Approach& approach, SolverStatistics& statistics);
  // (ξ, ξ', …, z, …, μ), ξ and μ without meaning before project().
  VectorXd& unknown() { return solver_.unknown(); }
  // unknown() = y, as far as it matters what is there before project().
  void begin_with(const VectorXd& y);
  void take(State& state) const;  // what was found
  // After project(): whether the equations that it did without hold as those that it solved do. `before`: a state
  // of the sizes of the trajectory.
  bool redundant_hold(const State& before, double h);

  // What the next projection starts from is what was found.
  void record();
  // The point found is where the next step begins; the last one began at x. False if coordinates of tangent
  // vectors have nothing to do with those before: then all that was recorded is forgotten.
  bool accept(const VectorXd& x);
  // The next step begins where the other one's last accept() was; the basis is there already, or was
  // made afresh on the way (`goes_on` false).
  void take_over(const ConstrainFirstProjection& other, bool goes_on);
  // As of Stepper, at the ends of steps.
  void learn_from(const ConstrainFirstProjection& other, const Stepper::Companion& companion);
  // For each unknown of a step, or of a projection, what `times` becomes for steps of this ratio; so many of the first
  // are displacements.
  VectorXd times_of(double times, double ratio, Index displacements) const;
  void discard();        // back to the last accept()
  void forget_motion();  // what was recorded
  void forget();

  // Of the last accept(): (ξ, ξ', …, z, …, μ) with ξ and μ zero; and W there, or what project() left.
  const VectorXd& jets();
  const MatrixXd& directions() const { return directions_.matrix(); }

  // Of the groups of unknowns ξ, ξ', the rest, and μ. `besides`: a size of coordinates other than those
  // of `before`.
  static std::array<double, 4> scales(const State& before, double h, double besides = 0.0);
  // Sizes of the groups of unknowns that are extrapolated apart: tangent vectors, and the rest.
  static std::vector<Index> predicted_groups(const ConstrainFirstFunctions& functions,
                                             Index unknowns);

 private:
  void clear_places(VectorXd& y) const;
  double largest_speed(const State& before, const VectorXd& y);
  bool is_nearby(const State& before, double path, double size) const;
  double jet_change(const VectorXd& from, const VectorXd& to) const;
  void move_basis(const VectorXd& x, VectorXd& y);
  void aim(const VectorXd& x, const VectorXd& y, double t);

  const ConstrainFirstFunctions& functions_;
  Index n_, d_, rest_;
  StepSolver solver_;
  bool is_explicit_;  // formulas give what is found: nothing is foreseen
  bool gives_all_;    // and that is all there is
  Predictor end_;     // of its unknowns; of all that are found where W depends on them
  Predictor shift_;   // of the vector at near_ that leads to x
  TransportedFrame& basis_;
  TransportedConormals conormals_;
  TransportedDirections directions_;  // W
  bool is_turned_ = false;            // the basis was made afresh
  // ‖ΔW‖ / ‖Δx‖ of the last steps; unknown before the first
  double turning_ = std::numeric_limits<double>::infinity();
  VectorXd jets_;   // of the last accept(), with any ξ and μ
  VectorXd given_;  // what formulas gave since
  VectorXd start_, aimed_, near_, guess_, foreseen_, shifted_, corrected_;
  MatrixXd vectors_;  // tangent vectors, while the basis moves
  VectorXd found_, velocity_;
  VectorXd redundant_;  // equations that project() did without, with their Jacobian
  double time_ = 0.0;   // of the last project()
};

}  // namespace courant
