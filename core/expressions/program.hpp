// Program: expressions as a straight-line sequence of instructions, the bytecode of the
// interpreter.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/numbers/uncertain.hpp"

namespace courant {

class Quadruple;

// The map (in_0, …, in_g) ↦ out of some expressions, for numbers and for truncated Taylor series.
//
// Immutable; evaluation may run in several threads at once and allocates nothing after the first
// call of a thread.
class Program {
 public:
  Program() = default;

  // The order to carry out instructions in: equal operations together, which the interpreter likes,
  // or as the expressions were made, which leaves compilers fewer values to keep at a time.
  enum class Order { grouped, as_made };

  // Throws std::invalid_argument if the outputs contain a variable that is in no input group.
  Program(std::span<const ExprVector> inputs, const ExprVector& outputs,
          Order order = Order::grouped)
      : Program(inputs, outputs, ExprVector(0), order) {}
  // The same where the values of these expressions, which are no constants, are one group of inputs more, the last
  // one, and are not worked out.
  Program(std::span<const ExprVector> inputs, const ExprVector& outputs, const ExprVector& held,
          Order order);

  Index output_size() const { return outputs_; }
  Index instruction_count() const { return static_cast<Index>(instructions_.size()); }

  // out[i] = i-th output; in[g][j] = j-th number of group g.
  void run(const double* const* in, double* out) const;

  // The same on series: in[g] + j (order+1) holds the coefficients of the j-th number of group g,
  // out + i (order+1) receives those of output i.
  void run_taylor(const double* const* in, Index order, double* out) const;
  // The same with bounds of errors: those of the inputs, of constants (Uncertain::rounded) and of
  // every rounding on the way. The values are the same to the last bit.
  void run_taylor(const Uncertain* const* in, Index order, Uncertain* out) const;
  // The same with 113 bits; constants are the doubles that they are.
  void run_taylor(const Quadruple* const* in, Index order, Quadruple* out) const;

  // `void <symbol>(const double *const *in, double *out)` in C, which gives the same bits as run(). Constants are
  // written in it; or those that are no small powers of two are passed, `(in, const double *constants, out)`: then
  // programs that differ in these alone have one source.
  enum class Constants { written, passed };
  std::string c_source(const std::string& symbol, Constants how = Constants::written) const;
  // What is passed.
  const std::vector<double>& constants() const { return constants_; }

 private:
  struct Instruction {
    std::uint32_t target, a, b, c;  // slots of the workspace
  };
  // Instructions that carry out the same operation: from the end of the run before to `end`.
  struct Run {
    Op op;
    std::int32_t k;
    std::size_t end;
  };
  // What run() carries out at once, up to `end`: instructions of a run one by one, or as many that go through the
  // workspace evenly, operands and results of the next one so many slots after those of the one before.
  struct Stretch {
    Op op = Op::constant;
    std::int32_t k = 0;
    std::size_t end = 0;
    std::uint32_t target = 0, a = 0, b = 0;
    std::int8_t stride = 0;  // of results, 1 or -1; 0: one by one
    std::int8_t stride_a = 0, stride_b = 0;
  };
  // `count` numbers of a group, from `index` on, go to as many slots, from `slot` on.
  struct Load {
    std::uint32_t slot, group, index, count;
  };
  // The next `count` outputs are what is in as many slots, from `slot` on.
  struct Store {
    std::uint32_t slot, count;
  };

  void load(std::uint32_t slot, std::size_t group, Index index);
  void find_stretches();
  Stretch even_stretch(std::size_t begin, std::size_t end, const Run& run) const;

  template <class Number>
  void carry_out_taylor(const Number* const* in, Index order, Number* out) const;

  // Workspace: constants first, then the inputs that are used, then results (slots are reused when
  // their value is dead).
  std::vector<double> constants_;
  std::vector<Load> loads_;
  std::vector<Instruction> instructions_;
  std::vector<Run> runs_;
  std::vector<Stretch> stretches_;
  std::vector<Store> stores_;
  Index outputs_ = 0;
  std::size_t slots_ = 0;
};

}  // namespace courant
