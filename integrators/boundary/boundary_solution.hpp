// BoundarySolution: a motion that meets conditions at both ends, with the evidence for it.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/boundary/boundary_problem.hpp"

namespace courant {

// What solve_boundary_problem() found. It starts as failure.
struct BoundarySolution {
  enum class Verdict {
    unsolved,  // no motion was found; the numbers are those of where the search ended
    isolated,  // no other solution is near, but for the phase of a periodic one
    family,    // of family_dimension parameters
  };
  Verdict verdict = Verdict::unsolved;
  std::string reason = {};  // one sentence, where it is unsolved: how far, which condition

  State start = {};
  double h = 0.0;
  long steps = 0;
  std::vector<State> nodes = {};
  VectorXd multipliers = {};
  double duration() const { return static_cast<double>(steps) * h; }

  // Of the run from the start without a break: what each condition is at its end, where it should be 0. Where steps
  // stretch differences much, that is more than the jumps.
  struct Condition {
    std::string name;
    double residual = 0.0;
  };
  std::vector<Condition> conditions = {};
  std::optional<double> closure = {};  // ‖x_n - x_0‖ of a periodic one
  double jump = 0.0;                   // the greatest at a node

  // Of the shooting matrix, columns of multipliers left out of the count of the family.
  RankDecision rank = {};
  Index family_dimension = 0;
  bool has_phase = false;  // a periodic motion that may begin anywhere on its way

  int iterations = 0;
  std::vector<double> changes = {};  // ‖Δ‖ of each iteration

  // Times at which a motion that leaves as the initial conditions allow meets this one to first order, as the final
  // conditions see it: zeros of det ∂r_T(x(t))/∂(free directions at the start). No value where that is no square
  // matrix, the time is free, the motion is periodic or needs its nodes.
  std::optional<std::vector<double>> conjugate_times = {};

  // The eigenvalues of TΦ on T M_f, of a periodic one; by descending modulus. None where the run from the start does
  // not close to six digits.
  Eigen::VectorXcd floquet = {};

  // Whether the run from the start misses the end, so much has round-off grown: the motion is then the one from node to
  // node, node i after step steps_before(i).
  bool needs_nodes = false;
  long steps_before(std::size_t node) const {
    return steps * static_cast<long>(node) / std::ssize(nodes);
  }
};

std::string to_string(BoundarySolution::Verdict verdict);  // "unsolved", "isolated", "family"

// When a solution counts as found, and when the search is given up.
struct BoundaryOptions {
  // ‖Δ‖ next to the size of the states, at which the iteration ends.
  double tolerance = 1e-11;
  int most_iterations = 80;
  const std::atomic<bool>* stop =
      nullptr;  // set by someone else: std::runtime_error("interrupted")
};

// Multiple shooting by a damped Gauss–Newton iteration,
//
//   Δ = -J⁺F,   y ← y ⊕ λ Δ,   ‖J⁺F(y ⊕ λΔ)‖ ≤ (1 - λ/4) ‖Δ‖
//
// The natural level function ‖J⁺F‖ does not change with the units of the conditions; λ is as large as the linear model
// is seen to hold (P. Deuflhard, Newton Methods for Nonlinear Problems, 2004, sections 3.3 and 4.3). Steps of least
// norm choose among the motions of a family, and the phase of a periodic one.
//
// What cannot be solved is a result, not an exception. Throws std::invalid_argument where the problem is none: no
// regular ladder, a method without a differential, more independent conditions at the ends than there are unknowns;
// what the first step of the guess throws.
BoundarySolution solve_boundary_problem(const BoundaryProblem& problem,
                                        const BoundaryOptions& options = {});
// The same from a solution of a problem nearby, with the same sizes, whose states are the guess.
BoundarySolution solve_boundary_problem(const BoundaryProblem& problem,
                                        const BoundarySolution& near,
                                        const BoundaryOptions& options = {});

// Homotopy: the problem of a parameter c from one value to another, each solved from those before, in steps of c that
// are halved where one is not solved and grow where it is. The last solution that was found where the way does not go
// on, as unsolved, with the value of c in its reason. `tell` hears each value that was solved.
BoundarySolution continue_boundary_problem(const std::function<BoundaryProblem(double c)>& problem,
                                           double from, double to,
                                           const BoundaryOptions& options = {},
                                           const std::function<void(double c)>& tell = {});

}  // namespace courant
