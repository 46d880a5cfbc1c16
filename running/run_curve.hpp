// RunCurve: a run between its steps.
#pragma once

#include <memory>
#include <vector>

#include "courant/running/observer.hpp"

namespace courant {

// t ↦ row, from the states of a run and the method that made its steps: the row at a time between two states is that
// at the end of a shorter step from the first of them, so it is of the method's order, and on M_f where the method is.
// A row costs what a step costs. One thread at a time.
class RunCurve {
 public:
  // A state, and the step that begins there.
  struct Piece {
    State state = {};
    double h = 0.0;
    bool is_in_t = true;  // whether h is a time, not one of a transformation
  };
  // States with rising or falling times, at least one.
  RunCurve(Experiment experiment, ConstraintLadder ladder,
           std::shared_ptr<const Integrator> integrator, std::vector<Piece> pieces);

  const std::vector<std::string>& names() const { return observer_.names(); }
  double first() const { return pieces_.front().state.t; }
  double last() const { return pieces_.back().state.t; }

  // What a run measures at t, in the order of names(); valid until the next call. Throws std::invalid_argument for
  // a t that is not between the ends of the run, SolveError where the step cannot be made.
  const VectorXd& operator()(double t);

 private:
  State at(double t);

  Experiment experiment_;
  ConstraintLadder ladder_;
  std::shared_ptr<const Integrator> integrator_;
  std::vector<Piece> pieces_;
  Observer observer_;
  std::unique_ptr<Stepper> stepper_;
};

}  // namespace courant
