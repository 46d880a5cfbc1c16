#include "courant/core/expressions/function.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/held_part.hpp"

namespace courant {
namespace {

// Outside these the compiler costs more than it saves; it takes about 0.1 to 0.2 ms an instruction.
constexpr Index kNativeMinimum = 4;
constexpr Index kNativeMaximum = 10'000;

// The variables of the groups with these names; `option` is named in the error.
std::vector<Expr> variables(const std::string& function, const std::vector<Function::Input>& inputs,
                            const std::vector<std::string>& names, const char* option) {
  std::vector<Expr> result;
  for (const std::string& wanted : names) {
    const auto found =
        std::ranges::find(inputs, wanted, [](const Function::Input& i) { return i.name; });
    if (found == inputs.end())
      throw std::invalid_argument("Function(" + function + "): " + option + " names \"" + wanted +
                                  "\", which is no input group.");
    result.insert(result.end(), found->variables.begin(), found->variables.end());
  }
  return result;
}

ExprVector as_vector(const std::vector<Expr>& expressions) {
  return Eigen::Map<const ExprVector>(expressions.data(), static_cast<Index>(expressions.size()));
}

bool is_worthwhile(Index instructions) {
  return instructions >= kNativeMinimum && instructions <= kNativeMaximum;
}

}  // namespace

Function::Function(const std::string& name, const std::vector<Input>& inputs,
                   const ExprVector& outputs, const Options& options)
    : name_(name), rows_(outputs.size()) {
  std::vector<ExprVector> groups;
  for (const Input& input : inputs) {
    groups.push_back(input.variables);
    sizes_.push_back(input.variables.size());
  }
  const std::vector<Expr> by = variables(name, inputs, options.differentiate, "differentiate");
  const std::vector<Expr> varying = variables(name, inputs, options.varying, "varying");
  ExprVector all = outputs;
  if (!by.empty()) {
    SparseExprMatrix j = courant::jacobian(outputs, as_vector(by));
    cols_ = j.cols;
    pattern_row_ = std::move(j.row);
    pattern_col_ = std::move(j.col);
    if (std::ssize(by) == sizes_[0] && options.differentiate[0] == inputs[0].name)
      matrix_numbers_ = MatrixNumbers(outputs, j.values, groups);
    all.resize(outputs.size() + j.values.size());
    all << outputs, j.values;
  }
  value_ = std::make_shared<const Program>(groups, outputs);
  all_ = by.empty() ? value_ : std::make_shared<const Program>(groups, all);
  run_value_ = value_;
  run_all_ = all_;

  const Backend alone = options.backend.together();
  const bool is_alone = options.backend.module() == nullptr;
  const Backend& backend = is_alone ? alone : options.backend;
  ExprVector held(0);
  if (!varying.empty() && is_worthwhile(value_->instruction_count()))
    held = held_part(outputs, as_vector(varying));
  if (held.size() > 0 && is_worthwhile(Program(groups, held).instruction_count())) {
    held_ = std::make_shared<const Function>(name + ", held", inputs, held,
                                             Options{.backend = backend});
    run_value_ = std::make_shared<const Program>(groups, outputs, held, Program::Order::grouped);
    run_all_ = by.empty()
                   ? run_value_
                   : std::make_shared<const Program>(groups, all, held, Program::Order::grouped);
  } else {
    held.resize(0);
  }
  add_native(groups, outputs, all, held, backend);
  if (is_alone) alone.compile();
}

void Function::add_native(const std::vector<ExprVector>& groups, const ExprVector& outputs,
                          const ExprVector& all, const ExprVector& held, const Backend& backend) {
  if (backend.kind() == Backend::Kind::interpreter) return;
  const bool automatic = backend.kind() == Backend::Kind::automatic;
  if (automatic && !backend.compiler()->is_available()) return;
  // A Jacobian is many times as long as the value, and seldom asked for: Newton's method keeps its
  // factorisations.
  const bool compile_all = !automatic || is_worthwhile(all_->instruction_count());
  if (!compile_all && !is_worthwhile(value_->instruction_count())) return;
  const auto compiled = [&](const ExprVector& results) {
    return Program(groups, results, held, Program::Order::as_made);
  };
  const Program jacobian = compile_all ? compiled(all) : Program();
  native_ = backend.module()->add(compiled(outputs), compile_all ? &jacobian : nullptr);
}

void Function::hold_and_run(const double* const* in, double* out, bool with_jacobian) const {
  thread_local std::vector<double> held;
  thread_local std::vector<const double*> groups;
  if (std::ssize(held) < held_size()) held.resize(static_cast<std::size_t>(held_size()));
  groups.assign(in, in + input_count());
  groups.push_back(held.data());
  hold(in, held.data());
  with_jacobian ? value_and_jacobian_with_held(groups.data(), out)
                : value_with_held(groups.data(), out);
}

const std::shared_ptr<const NativeModule::Entry>& Function::interpreted() {
  static const auto entry = std::make_shared<const NativeModule::Entry>();
  return entry;
}

std::vector<const double*> Function::pointers(std::span<const VectorXd> in) const {
  if (in.size() != sizes_.size())
    throw std::invalid_argument("Function(" + name_ + "): got " + std::to_string(in.size()) +
                                " input groups, expected " + std::to_string(sizes_.size()) + ".");
  std::vector<const double*> result;
  for (std::size_t g = 0; g < in.size(); ++g) {
    if (in[g].size() != sizes_[g])
      throw std::invalid_argument("Function(" + name_ + "): input group " + std::to_string(g) +
                                  " has " + std::to_string(in[g].size()) + " entries, expected " +
                                  std::to_string(sizes_[g]) + ".");
    result.push_back(in[g].data());
  }
  return result;
}

VectorXd Function::operator()(std::span<const VectorXd> in) const {
  VectorXd result(rows_);
  value(pointers(in).data(), result.data());
  return result;
}

MatrixXd Function::jacobian(std::span<const VectorXd> in) const {
  VectorXd all(rows_ + nonzeros());
  value_and_jacobian(pointers(in).data(), all.data());
  return dense_jacobian(all);
}

MatrixXd Function::dense_jacobian(const VectorXd& out) const {
  MatrixXd result = MatrixXd::Zero(rows_, cols_);
  for (std::size_t k = 0; k < pattern_row_.size(); ++k)
    result(pattern_row_[k], pattern_col_[k]) = out[rows_ + static_cast<Index>(k)];
  return result;
}

Eigen::SparseMatrix<double> Function::sparse_jacobian(std::span<const VectorXd> in) const {
  VectorXd all(rows_ + nonzeros());
  value_and_jacobian(pointers(in).data(), all.data());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < pattern_row_.size(); ++k)
    entries.emplace_back(static_cast<int>(pattern_row_[k]), static_cast<int>(pattern_col_[k]),
                         all[rows_ + static_cast<Index>(k)]);
  Eigen::SparseMatrix<double> result(rows_, cols_);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

MatrixXd Function::taylor(std::span<const MatrixXd> in) const {
  if (in.size() != sizes_.size())
    throw std::invalid_argument("Function(" + name_ + ")::taylor: got " +
                                std::to_string(in.size()) + " input groups, expected " +
                                std::to_string(sizes_.size()) + ".");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Index width = 0;
  for (const MatrixXd& series : in) width = std::max(width, series.cols());
  std::vector<RowMajor> series;
  std::vector<const double*> pointer;
  for (std::size_t g = 0; g < in.size(); ++g) {
    if (in[g].rows() != sizes_[g] || (sizes_[g] > 0 && in[g].cols() != width))
      throw std::invalid_argument("Function(" + name_ + ")::taylor: input group " +
                                  std::to_string(g) + " is " + std::to_string(in[g].rows()) +
                                  " x " + std::to_string(in[g].cols()) + ", expected " +
                                  std::to_string(sizes_[g]) + " x " + std::to_string(width) + ".");
    series.emplace_back(in[g]);
  }
  for (const RowMajor& s : series) pointer.push_back(s.data());
  if (width == 0)
    throw std::invalid_argument("Function(" + name_ + ")::taylor: no input has a coefficient.");
  RowMajor out(rows_, width);
  taylor(pointer.data(), width - 1, out.data());
  return out;
}

}  // namespace courant
