// Steps that are solved for displacements.
#pragma once

#include <memory>
#include <string>

#include "courant/integrators/step/predictor.hpp"
#include "courant/integrators/step/round_off_projection.hpp"
#include "courant/integrators/step/step_solver.hpp"
#include "courant/integrators/step/stepper.hpp"

namespace courant {

// The workspace of a method whose step solves equations for y = (displacements, z) at a stage, from
// where x₁ and v are given. y is extrapolated from the steps before.
//
// To subclass, override do_step, which calls make_step, do_begin, do_stage and do_fresh.
class DisplacementStepper : public Stepper {
 protected:
  struct Formulas {
    const EquationSystem& equations;
    const Function& whole;    // the same without elimination, or empty, see StepSolver
    const Function& advance;  // the inputs of the equations ↦ x₁, v, what is kept of the stage
    const Function& constraint;    // of RoundOffProjection
    Index displacements;           // so many numbers of y
    std::vector<Index> contained;  // the coordinates of x that the equations contain
    Index h;                       // the input that is h
  };
  DisplacementStepper(std::string method, std::shared_ptr<const ImplicitSystem> system,
                      const Formulas& formulas);

  // The place of y.
  double* unknown() { return solver_.unknown().data(); }
  // `in`: y, and the parameters of the equations.
  void make_step(const Inputs& in, const State& before, double h, State& after);
  // What advance gave for the last step that stands.
  const VectorXd& kept() const { return kept_; }
  // No step before tells where the next one leads.
  void forget_steps() { predictor_.forget(); }

  void do_keep(const State& before, const State& after) override;
  void do_forget() override;

 private:
  // To subclass, override: writes the displacements of y for a step without others before; its z
  // are those of the state.
  virtual void do_begin(const State& before, double h, VectorXd& y) = 0;

  double size_of(const VectorXd& x) const;
  void do_change_step() override { predictor_.forget(); }
  void do_accompany(std::span<const Companion> companions) override;
  Motion do_motion() const override { return solver_.motion(manifold()); }
  void do_expect(const Motion& motion) override { solver_.expect(motion); }

  Function advance_;
  RoundOffProjection projection_;
  Index m_;  // the size of z
  // The coordinates that the equations contain. Displacements are solved for next to these: a body that has
  // gone far in a space whose equations do not contain its place moves as one that has not.
  const std::vector<Index> contained_;
  const bool contains_all_;
  StepSolver solver_;
  Predictor predictor_;
  VectorXd next_, kept_;  // what advance_ gives for the step that is made, and the last that stands
};

}  // namespace courant
