// Prolongation: a tower of systems of equations whose projections are the levels of a ladder.
#pragma once

#include <vector>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/numbers/uncertain.hpp"

namespace courant {

// A map near y by its value and its derivative there, with bounds of their errors.
//
// An entry of the Jacobian that is not above its bound is no entry of `jacobian`: it is zero as far
// as anyone can tell, and what chooses scales must not see it. `error` is at least
// |J_ij - J_ij(exact)| everywhere, at those places too. Both are empty for a map that does not know
// its errors.
struct Linearization {
  VectorXd value;
  SparseMatrixXd jacobian;
  VectorXd value_error = VectorXd();
  SparseMatrixXd error = SparseMatrixXd();
};

// Whether F and its derivatives are.
bool is_finite(const Linearization& at);

// The Jacobian of a Linearization from its numbers as they come; those of one place add up.
class UncertainEntries {
 public:
  void add(Index row, Index column, const Uncertain& entry);
  // Sets jacobian and error of `result`, of this many rows and columns.
  void fill(Linearization& result, Index rows, Index columns);

 private:
  struct Entry {
    Index row, column;
    Uncertain number;
  };
  std::vector<Entry> entries_;
};

// Equations F^[0], F^[1], … where F^[k+1] consists of F^[k] and r equations more, in unknowns that
// grow likewise:
//
//   y = (x_0, x_1, z_0, x_2, z_1, …, x_{k+1}, z_k),   x_i ∈ Rⁿ, z_i ∈ R^m
//   F^[k]: R^{n + (k+1)(n+m)} → R^{(k+1) r}
//
// The i-th block of r equations contains x_0 … x_{i+1}, z_0 … z_i only, so that the unknowns and
// equations of level k are leading parts of those of any higher level. The sets of the ladder are
//
//   S_k = {(x_0, x_1) : F^[k](y) = 0 for some x_2, …, z_0, …},      M_k = {x_0 : …}.
//
// Continuous: x_i, z_i are Taylor coefficients of a curve (DerivativeArray). Discrete: x_i, z_i are
// the points of a chain (ChainArray).
class Prolongation {
 public:
  virtual ~Prolongation() = default;

  Index base_size() const { return base_size_; }            // n
  Index auxiliary_size() const { return auxiliary_size_; }  // m
  Index equation_count() const { return equation_count_; }  // r

  Index row_count(Index k) const { return (k + 1) * equation_count_; }
  Index unknown_count(Index k) const {
    return base_size_ + (k + 1) * (base_size_ + auxiliary_size_);
  }
  // The level that y belongs to; throws std::invalid_argument if there is none.
  Index level_of(const VectorXd& y) const;

  // Where x_i and z_i are in y.
  Index x_offset(Index i) const {
    return i == 0 ? 0 : base_size_ + (i - 1) * (base_size_ + auxiliary_size_);
  }
  Index z_offset(Index i) const { return 2 * base_size_ + i * (base_size_ + auxiliary_size_); }

  // F^[k](y) and its Jacobian, k = level_of(y), with the bounds of their errors at the point that y
  // stands for: within `uncertainty` (≥ 0, entry by entry) of y, or, if that is not given, y rounded.
  Linearization linearize(const VectorXd& y) const { return linearize(y, rounding(y)); }
  Linearization linearize(const VectorXd& y, const VectorXd& uncertainty) const {
    return do_linearize(y, uncertainty, level_of(y));
  }
  // |y_j| u, and 0 where y_j is a small integer: see Uncertain::rounded.
  static VectorXd rounding(const VectorXd& y);
  VectorXd residual(const VectorXd& y) const { return do_residual(y, level_of(y)); }

  // Whether the Jacobian is the same everywhere; if so, ranks cannot change from point to point.
  virtual bool has_constant_jacobian() const = 0;

 protected:
  Prolongation(Index base_size, Index auxiliary_size, Index equation_count)
      : base_size_(base_size), auxiliary_size_(auxiliary_size), equation_count_(equation_count) {}

 private:
  virtual Linearization do_linearize(const VectorXd& y, const VectorXd& uncertainty,
                                     Index k) const = 0;
  virtual VectorXd do_residual(const VectorXd& y, Index k) const = 0;

  Index base_size_;
  Index auxiliary_size_;
  Index equation_count_;
};

}  // namespace courant
