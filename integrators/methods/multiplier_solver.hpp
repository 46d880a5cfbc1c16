// The multipliers of steps by Verlet, block by block.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/core/linear/linear_solver.hpp"
#include "courant/core/solve/equation_system.hpp"
#include "courant/integrators/methods/verlet_multipliers.hpp"
#include "courant/integrators/step/predictor.hpp"
#include "courant/integrators/step/step_solver.hpp"
#include "courant/integrators/step/stepper.hpp"

namespace courant {

// The formulas of the blocks as functions. Immutable.
struct MultiplierFunctions {
  MultiplierFunctions(const VerletMultipliers& formulas, const Backend& backend);

  struct Block {
    EquationSystem equations;  // u; the unknowns of the blocks before, x₀, h, t ↦ residual
    bool is_affine;
    std::vector<Index> begins;  // see VerletMultipliers
    Index first;                // place of u among all unknowns
  };
  std::vector<Block> blocks;
  std::size_t moving;
  Index unknowns;
  Function middle;    // x₀, h, t, u ↦ x_m and its derivatives by u
  Function iterated;  // see VerletMultipliers; without outputs where it has none
};

// The unknowns of the substeps that a step is made of, extrapolated from the steps before, all of them together. One
// object a trajectory. Nothing is allocated in substeps that are iterated, nor in others after the first one.
class MultiplierSolver {
 public:
  // `functions` has to live as long. `parts`: so many substeps.
  MultiplierSolver(const MultiplierFunctions& functions, Index parts, const std::string& method);

  // Of substep i: those that its end depends on come first.
  double* unknowns(Index i) { return u_.data() + i * functions_.unknowns; }
  // Those of the last step that stands.
  const double* kept(Index i) const { return kept_.data() + i * functions_.unknowns; }

  // So many numbers are known of a substep that is iterated: its u and their last changes, which follow x₁. None where
  // none is.
  Index iterated() const { return iterated_; }

  // Before the substeps of a step of h.
  void begin(const State& before, double h);
  // Substep i, of the size h, from the u that are predicted: whether they are solutions. x1 and what is known after it.
  bool moves(Index i, const double* x0, double h, double t, double* x1,
             SolverStatistics& statistics);
  // Those of substep i, of the size h, that its end depends on; throw SolveError.
  void move(Index i, const double* x0, double h, double t, SolverStatistics& statistics);
  // The others of substep i, by equations that are affine.
  void end(Index i, const double* x0, double h, double t, SolverStatistics& statistics);
  void keep();
  void change_step() { predictor_.forget(); }
  void forget();

 private:
  struct Affine {
    std::unique_ptr<LinearSolver> solver;
    VectorXd none, all, solution;  // u = 0; residual and entries of its matrix; -u
  };

  void make_solvers();
  void begun(const MultiplierFunctions::Block& block, double* u) const;
  void solve_affine(std::size_t b, double* u, const double* x0, const double* h, const double* t,
                    SolverStatistics& statistics);

  const MultiplierFunctions& functions_;
  std::string method_;
  std::size_t parts_;
  Index iterated_ = 0;
  VectorXd u_, kept_;
  Predictor predictor_;
  std::vector<StepSolver>
      solvers_;  // of each substep and block in turn that is not affine, where needed
  std::vector<std::size_t> solver_;  // of a block, its place among those of a substep
  std::size_t solvers_a_part_ = 0;
  std::vector<Affine> affine_;  // of each block
  VectorXd multipliers_;        // z of the state
  VectorXd middle_, scales_;    // of each block
};

}  // namespace courant
