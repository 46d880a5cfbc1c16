// SeriesFunction: formulas on truncated Taylor series in the digits of a decision.
#pragma once

#include <cstdint>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/numbers/digits.hpp"

namespace courant {

class Ball;

// The map (in_0, …, in_g) ↦ outputs of some formulas on series Σ_i a_i tⁱ, i = 0 … K, in doubles, in Digits or in
// Balls. In the latter two a constant is what was meant by who wrote it (MeantNumber).
//
// A switch is an operation that jumps or bends: abs, sign, min, max and comparisons. It is at its edge where
// the number that decides it is zero. A number that only time is in is decided by what it is a moment later.
//
// Immutable; keeps no Expr.
class SeriesFunction {
 public:
  SeriesFunction() = default;
  // Throws std::invalid_argument if the outputs contain a variable that is in no group. `time` is the number of
  // the group that only time is in, or -1.
  SeriesFunction(const std::vector<ExprVector>& inputs, const ExprVector& outputs, Index time = -1);

  Index output_size() const { return static_cast<Index>(outputs_.size()); }
  bool has_switches() const { return has_switches_; }

  // in[g] + j (K+1): the coefficients of the j-th number of group g; out likewise. `side`: what switches at
  // their edge see, the side of larger numbers (1), of smaller ones (-1), or 0. Returns whether some are.
  bool run(const double* const* in, Index order, double* out, int side = 0) const;
  bool run(const Digits* const* in, Index order, Digits* out, int side = 0) const;
  // Of balls also where a number that decides is not proved to be on one side, or zero.
  bool run(const Ball* const* in, Index order, Ball* out, int side = 0) const;

 private:
  struct Step {
    Op op;
    std::int32_t k;
    std::uint32_t a, b, c;
    bool of_time_alone;
  };
  struct Load {
    std::uint32_t slot, group, index;
  };

  template <class Number>
  bool carry_out(const Number* const* in, Index order, Number* out, int side) const;

  // Slots: constants, inputs, then one for each step.
  std::vector<double> constants_;
  std::vector<Load> loads_;
  std::vector<Step> steps_;
  std::vector<std::uint32_t> outputs_;
  std::uint32_t first_step_ = 0;
  bool has_switches_ = false;
};

}  // namespace courant
