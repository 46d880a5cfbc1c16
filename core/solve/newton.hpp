// Newton's method with kept factorisations, for the equations of a step.
#pragma once

#include <optional>
#include <vector>

#include "courant/core/expressions/inputs.hpp"
#include "courant/core/linear/linear_solver.hpp"
#include "courant/core/solve/contraction.hpp"
#include "courant/core/solve/equation_system.hpp"
#include "courant/core/solve/exponential_watch.hpp"
#include "courant/core/solve/limited_newton.hpp"

namespace courant {

// Solves F(y; parameters) = 0 again and again along a trajectory, for those unknowns that the system keeps; the others
// follow from these.
//
// Simplified Newton: y ← y - A F(y), where A is the pseudo-inverse of an earlier Jacobian. So redundant equations are
// met in the sense of least squares, and undetermined unknowns change least. A is kept as long as the iteration
// contracts well. Where A is an inverse and two changes contract badly, broyden_update() corrects it, so that it
// follows the Jacobian along a trajectory.
//
// The iteration ends where the error that is left is small next to the scale of the unknowns. The last change and the
// contraction tell this error. The iteration also ends
//
// * where iterates move by round-off only: an absolute test would go on for ever once the state is large,
// * where the residual is round-off of its terms,
// * where a matrix that was just made does not bring iterates nearer: close to a singular point round-off moves
//   unknowns far.
//
// An engine that has the equations does all this itself, by the same measures of convergence. Unknowns that F does not
// contain stay as they are. Holds workspace: one object a trajectory, not shared between threads. No allocation after
// the first solve.
class Newton {
 public:
  struct Options {
    // Relative error of the unknowns that is accepted. What an iteration leaves has a direction, so
    // it adds up over steps where round-off does not: with 1e-15 the energy of four vortices that
    // have travelled 10⁵ times their distance drifts by 5e-13 a step, with 1e-17 by nothing
    // measurable.
    double tolerance = 1e-17;
    int max_iterations = 60;
    // Contraction above which a new factorisation is worth its price (about ten evaluations for n = 8).
    double slow = 0.2;
    // What solves the linear systems; empty: linear_solver().
    LinearSolver::Maker solver = {};
  };
  enum class Status { converged, diverged, singular };
  struct Result {
    Status status = Status::diverged;
    int iterations = 0;
    int factorizations = 0;
    std::vector<double> residuals;  // ‖F‖_∞ of the iterates, filled only if not converged
  };

  // `groups`: sizes of consecutive blocks of y that are measured by their own scale (empty: one
  // block). Throws std::invalid_argument if they don't add up.
  Newton(EquationSystem system, std::vector<Index> groups, const Options& options);

  // For the unknowns y and the parameters of `in`. scales[g]: a nominal size of block g (its current values
  // count too). On failure y holds the last iterate. Throws std::invalid_argument if `in` has not so many
  // groups as the equations.
  // The result is valid until the next solve().
  const Result& solve(const Inputs& in, const double* scales);

  const Result& result() const { return result_; }  // of the last solve

  // Moves y by damped steps from far away to where solve() converges. The zero that is found then need not be the one
  // that is meant, see damped_newton(). Arguments as of solve(). False, with y as it was, if the steps do not get
  // there.
  bool approach(const Inputs& in, const double* scales);

  // Takes the unknowns that the last factorisation leaves open from y₀; the others stay as predicted. From y₀
  // solve() moves what is open least; predictions of it would grow without bounds.
  void settle(VectorXd& y, const VectorXd& y0);

  // Forgets the kept factorisation, and what the solver keeps of it.
  void reset() {
    factorized_ = false;
    if (solver_) solver_->forget();
    round_off_ = 0.0;
  }

  // The unknowns that solve() starts from and moves, and those that it leaves as they are, since no
  // equation contains them; it writes the others without reading them. Ascending.
  const std::vector<Index>& sought() const { return sought_; }
  const std::vector<Index>& left() const { return left_; }

  // Whether, by the last factorisation, F determines all the unknowns that it contains.
  bool is_determined() const { return system_.by_engine() || solver_->is_determined(); }

 private:
  Status solve_kept(const Inputs& in, const double* scales);
  Status solve_by_engine(const Inputs& in, const double* scales, bool is_damped);
  void find_contained();
  const Inputs& take_kept(const Inputs& in);
  void give(double* y);
  bool factorize(const Inputs& in);
  Contraction::Workspace workspace(double* y);
  double improve(double* y, const double* scales);
  void learn();
  template <class Size>
  void sum_terms(const Size& size);
  double unsolved_part(const double* y, const double* scales, bool any);
  double largest_part(const VectorXd& magnitude) const;
  bool sees_all() const;
  bool is_solved(const double* y, const double* scales, bool fresh);
  bool is_settled(const Inputs& in, bool fresh);
  bool is_still(const double* y, const double* scales, bool fresh, double& before);

  EquationSystem system_;
  const Function function_;  // of the unknowns that are kept
  std::vector<Index> sought_, left_;
  std::vector<Index> groups_;     // their sizes among those
  std::vector<Index> contained_;  // kept unknowns that F contains, ascending
  std::vector<Index> ends_;       // of the groups, in contained_
  bool is_explicit_ = false;      // there is nothing to solve
  bool is_contiguous_ = false;    // contained_, without gaps
  // Of a small inverse, where all unknowns that F contains are side by side in one group.
  Contraction contraction_;
  std::size_t group_ = 0;      // the first one that F contains unknowns of
  bool is_one_group_ = false;  // that has all of them
  Options options_;
  std::unique_ptr<LinearSolver>
      solver_;  // for a row an equation, a column an unknown of contained_
  bool factorized_ = false;
  double* inverse_ = nullptr;     // of the solver
  MatrixNumbers matrix_numbers_;  // of the last factorisation
  double round_off_ = 0.0;  // by how much iterates moved when they stalled with a new factorisation
  Inputs in_;               // where the kept unknowns are, the parameters, and what is held
  VectorXd kept_;           // unknowns
  VectorXd held_;           // what parameters alone determine of the equations
  Result result_;           // of the last solve
  VectorXd all_;            // F and the entries of its Jacobian
  VectorXd step_, settled_;
  VectorXd sizes_;              // of groups, at the last change
  VectorXd moved_;              // the last changes of groups, relative to those
  double slowest_ = 0.0;        // of several groups, see has_ended_everywhere()
  VectorXd before_, weighted_;  // the change before, and in units of those sizes
  // Where there are exponentials.
  std::optional<ExponentialWatch> exponentials_;
  std::optional<LimitedNewton> limited_;
  VectorXd magnitude_, stalled_;  // of the terms that each equation is a sum of
};

}  // namespace courant
