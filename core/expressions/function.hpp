// Function: a smooth map, traced once, compiled, with its exact derivatives.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "courant/core/expressions/backend.hpp"
#include "courant/core/expressions/expr.hpp"
#include "courant/core/expressions/matrix_numbers.hpp"
#include "courant/core/expressions/native_module.hpp"
#include "courant/core/expressions/program.hpp"

namespace courant {

// A map f: R^{n_0} × … × R^{n_g} → Rᵐ of named input groups, with its Jacobian by some of them and
// its truncated Taylor series.
//
//   f(in_0, …, in_g) = outputs
//   J = ∂f/∂(the groups named in `differentiate`, side by side)      m × Σ n_i, pattern known
//
// Immutable and cheap to copy. It keeps no Expr: the graph it was traced in may be dropped.
class Function {
 public:
  struct Input {
    std::string name;
    ExprVector variables;
  };
  // What a function is traced from.
  struct Formulas {
    std::vector<Input> inputs;
    ExprVector outputs = ExprVector(0);
  };
  struct Options {
    std::vector<std::string> differentiate = {};  // names of input groups; empty: no Jacobian
    // Names of the groups that change while the others stay, see hold(); empty: nothing is held.
    std::vector<std::string> varying = {};
    Backend backend = Backend::interpreter;
  };

  Function() = default;
  // Throws std::invalid_argument if an output depends on a variable that is in no group, or
  // `differentiate` or `varying` names no group.
  Function(const std::string& name, const std::vector<Input>& inputs, const ExprVector& outputs,
           const Options& options);
  Function(const std::string& name, const std::vector<Input>& inputs, const ExprVector& outputs)
      : Function(name, inputs, outputs, Options()) {}
  Function(const std::string& name, const Formulas& of, const Options& options)
      : Function(name, of.inputs, of.outputs, options) {}

  const std::string& name() const { return name_; }
  Index input_count() const { return static_cast<Index>(sizes_.size()); }
  Index input_size(Index group) const { return sizes_[static_cast<std::size_t>(group)]; }
  Index output_size() const { return rows_; }

  // The pattern of the Jacobian, sorted by row, then column.
  Index jacobian_cols() const { return cols_; }
  Index nonzeros() const { return static_cast<Index>(pattern_row_.size()); }
  const std::vector<Index>& pattern_row() const { return pattern_row_; }
  const std::vector<Index>& pattern_col() const { return pattern_col_; }
  // What its entries are made of, where it is by the first group alone.
  const MatrixNumbers& matrix_numbers() const { return matrix_numbers_; }

  // Whether compiled C code evaluates it; how many operations an evaluation has.
  bool is_native() const { return native_->value != nullptr; }
  Index instruction_count() const { return value_->instruction_count(); }

  // The inner loop: in[g] points to the n_g numbers of group g; nothing is checked, nothing
  // allocated (with held parts after the first call of a thread).
  void value(const double* const* in, double* out) const {  // out: m
    held_ == nullptr ? value_with_held(in, out) : hold_and_run(in, out, false);
  }
  void value_and_jacobian(const double* const* in,
                          double* out) const {  // out: m values, then nonzeros() entries of J
    held_ == nullptr ? value_and_jacobian_with_held(in, out) : hold_and_run(in, out, true);
  }

  // The same in two parts, for many values of the groups that are `varying`:
  //
  //   f.hold(in, held);                                what the other groups alone determine: held_size() numbers
  //   f.value_with_held(in, out);  …                   in: one group more, the last: held
  //
  // The bits are those of value(). Where nothing is held a group more does no harm.
  Index held_size() const { return held_ == nullptr ? 0 : held_->output_size(); }
  void hold(const double* const* in, double* held) const {
    if (held_ != nullptr) held_->value(in, held);
  }
  void value_with_held(const double* const* in, double* out) const {
    const auto native = native_->value.load(std::memory_order_acquire);
    native != nullptr ? native(in, native_->constants.data(), out) : run_value_->run(in, out);
  }
  void value_and_jacobian_with_held(const double* const* in, double* out) const {
    const auto native = native_->value_and_jacobian.load(std::memory_order_acquire);
    native != nullptr ? native(in, native_->constants_with_jacobian.data(), out)
                      : run_all_->run(in, out);
  }
  // J as a matrix, from what value_and_jacobian has put out.
  MatrixXd dense_jacobian(const VectorXd& out) const;
  // Series of order K: in[g] and out hold K+1 coefficients for each number, see taylor.hpp.
  void taylor(const double* const* in, Index order, double* out) const {
    value_->run_taylor(in, order, out);
  }
  void taylor_with_jacobian(const double* const* in, Index order, double* out) const {
    all_->run_taylor(in, order, out);
  }
  // With bounds of errors, see Uncertain; the values are those of the call without.
  void taylor_with_jacobian(const Uncertain* const* in, Index order, Uncertain* out) const {
    all_->run_taylor(in, order, out);
  }
  // With 113 bits.
  void taylor_with_jacobian(const Quadruple* const* in, Index order, Quadruple* out) const {
    all_->run_taylor(in, order, out);
  }

  // The same with sizes checked (std::invalid_argument).
  VectorXd operator()(std::span<const VectorXd> in) const;
  VectorXd operator()(std::initializer_list<VectorXd> in) const {
    return (*this)(std::span(in.begin(), in.size()));
  }
  MatrixXd jacobian(std::span<const VectorXd> in) const;
  MatrixXd jacobian(std::initializer_list<VectorXd> in) const {
    return jacobian(std::span(in.begin(), in.size()));
  }
  Eigen::SparseMatrix<double> sparse_jacobian(std::span<const VectorXd> in) const;
  // Row i of in[g] and of the result: coefficients 0 … K of that number.
  MatrixXd taylor(std::span<const MatrixXd> in) const;

 private:
  static const std::shared_ptr<const NativeModule::Entry>& interpreted();
  void hold_and_run(const double* const* in, double* out, bool with_jacobian) const;
  void add_native(const std::vector<ExprVector>& groups, const ExprVector& outputs,
                  const ExprVector& all, const ExprVector& held, const Backend& backend);
  std::vector<const double*> pointers(std::span<const VectorXd> in) const;

  std::string name_;
  std::vector<Index> sizes_;
  Index rows_ = 0;
  Index cols_ = 0;
  std::vector<Index> pattern_row_;
  std::vector<Index> pattern_col_;
  MatrixNumbers matrix_numbers_;
  std::shared_ptr<const Program> value_ = std::make_shared<const Program>();
  std::shared_ptr<const Program> all_ = value_;  // value and Jacobian
  std::shared_ptr<const Function> held_;         // of the same inputs; null: nothing is held
  // The programs that are run, and native_: those with what is held as a last group of inputs.
  std::shared_ptr<const Program> run_value_ = value_, run_all_ = value_;
  std::shared_ptr<const NativeModule::Entry> native_ = interpreted();
};

}  // namespace courant
