// The quick part of simplified Newton: a kept inverse of few unknowns that contracts.
#pragma once

#include <algorithm>

#include "courant/core/expressions/function.hpp"
#include "courant/core/expressions/inputs.hpp"

namespace courant {

// When changes of simplified Newton u ← u - A F(u) have come to an end, and when they teach A something. `moved` and
// `previous`: the last change and the one before, relative to the size of the unknowns, by the same A.
namespace contraction {

// The contraction κ = moved / previous says what error is left where both are short: κ < 1/2 and max(κ, previous) moved
// ≤ (1 - κ) tolerance. It is tested without a division, as the end of a step waits for it. The first change
// on the way back from far away is shorter by as much as one went astray. A contraction below the length
// of the change before is an accident: A is at least as far away as that change was long, and may
// have been exact for the unknowns that the sizes show. A multiplier of size 0.2, weighted as nearly
// free, was left wrong by 3e-8 so.
constexpr double kLongStep = 1e-2;
inline bool has_ended(double moved, double previous, double tolerance) {
  return moved < 0.5 * previous && previous <= kLongStep &&
         std::max(moved, previous * previous) * moved <= (previous - moved) * tolerance;
}

// The same of unknowns in groups, each relative to its own size. `slowest`: the contraction of the group that contracts
// worst, of those whose change is no round-off. Changes may pass from one group to another, where they are small next
// to its size, and come back: an error of a multiplier of 7e-12 was once in velocities, which their increments are
// measured for, and then 4e-14 of the multiplier again, though the largest change had contracted by 6e-4.
inline bool has_ended_everywhere(double moved, double slowest, double tolerance) {
  return slowest * moved <= (1.0 - slowest) * tolerance;
}

// By the matrix of affine equations a change leaves its own rounding errors only. Those of the residual are as large as
// of a change of length 1: next to them what a change of this length leaves is nothing, and a second one says no more.
constexpr double kForeseen = 1e-3;

// A change of this relative length is far enough above round-off that the next one tells what A lacks; one that
// contracts so well leaves A as it is.
constexpr double kTeaches = 1e-12;
constexpr double kGood = 0.01;
inline bool teaches(double moved, double previous) {
  return previous > kTeaches && moved > kGood * previous;
}

// Of unknowns of this size; those of scale 0 that end at 0 have moved by all of themselves.
inline double relative(double change, double size) {
  return change > 0.0 ? (size > 0.0 ? change / size : 1.0) : change;
}

}  // namespace contraction

// Iterations for up to 8 unknowns that are side by side and measured by one scale, in loops whose length the compiler
// knows. A is regular, and the equations are as many as the unknowns.
class Contraction {
 public:
  struct Workspace {
    double* inverse;  // A, column by column, aligned as matrices of Eigen are
    double* u;
    double* residual;         // F
    double *change, *before;  // the last change; the one before, until A has learned
  };
  struct Limits {
    double scale;      // of u, whose size counts too
    double tolerance;  // relative
    double slow;       // a contraction that is not worth going on with
    int most;          // iterations
    bool is_exact;     // A is the inverse of the matrix of affine equations
  };
  // What became of u.
  struct Result {
    bool has_converged = false;
    int iterations = 0;
    double moved = 0.0, previous = 0.0;  // the last changes, relative; ∞ if one is not finite
    double size = 0.0;                   // of u
    bool has_learned = false;            // A, from two of the changes
  };

  // All give the same bits; the best are those of this processor that have three operands.
  enum class Instructions { best, plain };

  Contraction() = default;  // not available
  // For so many unknowns.
  explicit Contraction(Index count, Instructions instructions = Instructions::best);
  // Whether there are loops for so many.
  bool is_available() const { return iterate_ != nullptr; }

  // `in`: with what F holds as the last group, see Function::hold.
  // Iterates until the changes have ended or contract badly, one is not finite, or there were as many as may be.
  Result operator()(const Function& F, const Inputs& in, const Workspace& at,
                    const Limits& limits) const {
    return iterate_(F, in, at, limits);
  }
  // One change, by the residual that is there. Returns its largest entry, ∞ if one is not finite, and in `size`
  // the largest of u.
  double improve(const Workspace& at, double& size) const { return improve_(at, size); }

 private:
  Result (*iterate_)(const Function&, const Inputs&, const Workspace&, const Limits&) = nullptr;
  double (*improve_)(const Workspace&, double&) = nullptr;
};

}  // namespace courant
