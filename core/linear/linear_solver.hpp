// LinearSolver: what Newton's method solves its linear systems with.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

namespace courant {

using Eigen::Index;
using Eigen::VectorXd;

// Where the entries of a matrix stand that may be other than zero.
struct MatrixPattern {
  Index rows = 0, columns = 0;
  std::vector<Index> row, column;  // of entry k
};

// x = A⁺ b for matrices A (m × n) of one pattern, one after the other: A⁻¹ b where A is regular,
// else least squares of redundant equations and least change of undetermined unknowns.
//
// Made for a pattern, so that what depends on that alone is done once (an ordering, a symbolic
// factorisation, a loop of known length). Holds workspace: one object a trajectory, not shared
// between threads. A factorisation is kept until the next; solve() allocates nothing.
//
// To subclass: override the pure functions, and hand Newton a function that makes the solver.
class LinearSolver {
 public:
  using Maker = std::function<std::unique_ptr<LinearSolver>(const MatrixPattern& pattern)>;

  virtual ~LinearSolver() = default;

  // Keeps the factors of the matrix with these entries, in the order of the pattern. False, with no
  // factors kept, if they are not finite.
  bool factorize(const double* entries) { return do_factorize(entries); }
  // What earlier matrices were like is forgotten: the next factors are to the bit those of a new solver.
  void forget() { do_forget(); }
  // b: m numbers, x: n numbers. After factorize() has succeeded.
  void solve(const double* b, double* x) { do_solve(b, x); }
  // Whether A determines all of x: its columns are independent.
  bool is_determined() const { return do_is_determined(); }
  // Where A leaves x open, takes it from x₀: x ← x₀ + A⁺ A (x - x₀). Of all x with this product A x the
  // one next to x₀. x₀: n numbers.
  void settle(double* x, const double* x0) { do_settle(x, x0); }
  // The sign of det A; 0 if it is not known, or A is not square or singular.
  int orientation() const { return do_orientation(); }
  // A⁻¹, column by column, where it is kept as numbers that solve() multiplies with and that the caller may
  // improve until the next factorize(); null elsewhere, and where A is not square or singular.
  double* inverse() { return do_inverse(); }

 private:
  // To subclass, override:
  virtual bool do_factorize(const double* entries) = 0;
  virtual void do_forget() {}
  virtual void do_solve(const double* b, double* x) = 0;
  virtual bool do_is_determined() const = 0;
  // May override, if A may leave unknowns open:
  virtual void do_settle(double* /*x*/, const double* /*x0*/) {}
  // May override: 0 is what is not known.
  virtual int do_orientation() const { return 0; }
  // May override.
  virtual double* do_inverse() { return nullptr; }
};

}  // namespace courant
