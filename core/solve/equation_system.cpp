#include "courant/core/solve/equation_system.hpp"

#include <numeric>
#include <stdexcept>

namespace courant {

EquationSystem::EquationSystem(const std::string& name, const std::vector<Function::Input>& inputs,
                               const ExprVector& equations, const Options& options)
    : name_(name), size_(inputs.at(0).variables.size()) {
  const ExprVector& y = inputs[0].variables;
  const std::string unknown = inputs[0].name;
  if (options.engine && !options.eliminates)
    throw std::invalid_argument(
        "EquationSystem: a step of " + name +
        " leaves unknowns open, of which the least change is taken; the engine solves equations "
        "that determine their unknowns.");
  if (!options.eliminates) {
    *this = EquationSystem(
        Function(name, inputs, equations,
                 {.differentiate = {unknown}, .varying = {unknown}, .backend = options.backend}));
    exponentials_ = Exponentials(name, inputs, equations);
    return;
  }
  Elimination elimination(equations, y, options.elimination);
  kept_ = std::move(elimination.kept);
  pivots_ = std::move(elimination.pivots);
  std::vector<Function::Input> left = inputs;
  left[0].variables = y(kept_);
  if (options.engine && !elimination.remaining.empty()) {
    by_engine_ = options.engine->take(name, left, elimination.equations, options.backend.kind());
  } else {
    left_ =
        Function(name, left, elimination.equations,
                 {.differentiate = {unknown}, .varying = {unknown}, .backend = options.backend});
    exponentials_ = Exponentials(name, left, elimination.equations);
  }
  if (is_reduced())
    unknowns_ =
        Function(name + ", unknowns", left, elimination.unknowns, {.backend = options.backend});
}

EquationSystem::EquationSystem(Function equations)
    : name_(equations.name()),
      size_(equations.input_count() == 0 ? 0 : equations.input_size(0)),
      left_(std::move(equations)) {
  if (left_.jacobian_cols() != size_)
    throw std::invalid_argument("EquationSystem: the Jacobian of " + left_.name() + " has " +
                                std::to_string(left_.jacobian_cols()) +
                                " columns, expected one for each of the " + std::to_string(size_) +
                                " numbers of its first group.");
  kept_.resize(static_cast<std::size_t>(size_));
  std::iota(kept_.begin(), kept_.end(), Index{0});
}

}  // namespace courant
