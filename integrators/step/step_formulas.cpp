#include "courant/integrators/step/step_formulas.hpp"

#include <algorithm>
#include <sstream>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/solve/equation_system.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"

namespace courant {
namespace {

// Where formulas end and their origins begin.
constexpr std::size_t kOriginColumn = 56;

// The expressions with their variables named as in the experiment, in a graph of their own.
class Named {
 public:
  explicit Named(const StepFormulas& formulas) {
    for (std::size_t g = 0; g < formulas.inputs.size(); ++g) {
      const ExprVector& variables = formulas.inputs[g].variables;
      const Index first = from_.size();
      from_.conservativeResize(first + variables.size());
      to_.conservativeResize(first + variables.size());
      for (Index i = 0; i < variables.size(); ++i) {
        from_[first + i] = variables[i];
        to_[first + i] = graph_.variable(formulas.input_names[g][static_cast<std::size_t>(i)]);
      }
    }
  }
  std::string operator()(const Expr& a) const { return to_string(substitute(a, from_, to_)); }

 private:
  Graph graph_;
  ExprVector from_, to_;
};

// y_j as equation i gives it, if y_j occurs there as it was written; else as elimination found it.
Expr given(const StepFormulas& formulas, const Elimination& elimination,
           const Elimination::Pivot& pivot) {
  const ExprVector unknown = ExprVector::Constant(1, formulas.inputs[0].variables[pivot.unknown]);
  const ExprVector equation = ExprVector::Constant(1, formulas.equations[pivot.equation]);
  const Elimination alone(equation, unknown, {.never_zero = formulas.elimination.never_zero});
  return alone.kept.empty() ? alone.unknowns[0] : elimination.unknowns[pivot.unknown];
}

}  // namespace

EquationSystem StepFormulas::compile(Backend backend) const {
  return EquationSystem(name, inputs, equations,
                        {.backend = backend,
                         .eliminates = eliminates,
                         .elimination = elimination,
                         .engine = engine_of(backend)});
}

Function StepFormulas::whole() const {
  return Function(name, inputs, equations, {.differentiate = {inputs[0].name}});
}

Function StepFormulas::followed(const EquationSystem& compiled) const {
  if (compiled.by_engine() || is_affine()) return {};
  return compiled.is_reduced() ? whole() : compiled.left();
}

std::vector<Index> StepFormulas::contained(std::size_t group) const {
  const Subgraph all(equations);
  const ExprVector& variables = inputs[group].variables;
  std::vector<Index> result;
  for (Index i = 0; i < variables.size(); ++i)
    if (all.contains(variables[i])) result.push_back(i);
  return result;
}

bool StepFormulas::is_affine() const { return courant::is_affine(equations, inputs[0].variables); }

std::string derivative_name(const std::string& name, Index order) {
  return name + std::string(static_cast<std::size_t>(order), '\'');
}

std::string explanation(const StepFormulas& formulas, std::size_t width) {
  const ExprVector& y = formulas.inputs[0].variables;
  std::ostringstream text;
  text << formulas.name << ": " << formulas.equations.size() << " equations for " << y.size()
       << " unknowns\n";
  if (!formulas.eliminates) {
    text << "  All are solved for together: the system leaves some unknowns open, and the solver "
            "takes\n"
            "  the least change of all of them.\n";
    return text.str();
  }
  for (const std::string& equation : formulas.redundant)
    text << shortened("  left out, since it follows from the others: " + equation, width) << '\n';
  for (const std::string& equation : formulas.left_out)
    text << shortened("  left out, since nothing depends on what it decides: " + equation, width)
         << '\n';
  for (std::size_t i = 0; i < formulas.held.size(); ++i)
    text << "  " << formulas.held[i] << " = " << number_text(formulas.held_values[i])
         << ", since nothing depends on it\n";
  const Elimination elimination(formulas.equations, y, formulas.elimination);
  const Named named(formulas);
  const auto unknown = [&](Index j) {
    return formulas.input_names[0][static_cast<std::size_t>(j)];
  };
  for (const Elimination::Pivot& pivot : elimination.pivots) {
    const std::string formula =
        "  " + unknown(pivot.unknown) + " = " + named(given(formulas, elimination, pivot));
    const std::string origin =
        "  from: " + formulas.equation_names[static_cast<std::size_t>(pivot.equation)];
    text << padded(shortened(formula, kOriginColumn), kOriginColumn)
         << shortened(origin, width - kOriginColumn) << '\n';
  }
  const std::size_t left = elimination.remaining.size();
  text << "  " << left << (left == 1 ? " equation is left" : " equations are left");
  std::string line = elimination.kept.empty() ? "" : ", for";
  for (std::size_t k = 0; k < elimination.kept.size(); ++k) {
    const std::string next =
        " " + unknown(elimination.kept[k]) + (k + 1 < elimination.kept.size() ? "," : "");
    if (text_width(line) + text_width(next) + 24 > width) {
      text << line << "\n   ";
      line.clear();
    }
    line += next;
  }
  text << line << '\n';
  return text.str();
}

}  // namespace courant
