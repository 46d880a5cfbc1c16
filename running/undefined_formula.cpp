#include "courant/running/undefined_formula.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <unordered_set>
#include <vector>

#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/expressions/undefined.hpp"
#include "courant/integrators/step/vector_field.hpp"

namespace courant {
namespace {

// The formulas of an experiment in variables that have the names of its words.
class Formulas {
 public:
  Formulas(const Experiment& experiment, bool with_quantities) : system_(*experiment.model.system) {
    const ImplicitSystem::Names& names = system_.names();
    const Manifold& M = *system_.manifold();
    for (const std::string& name : names.coordinates) add(name);
    const ExprVector x = variables_;
    const bool plain = M.has_velocities_as_vectors();
    for (Index i = 0; i < M.tangent_dimension(); ++i)
      add(plain ? names.coordinates[static_cast<std::size_t>(i)] + "'"
                : "v[" + std::to_string(i) + "]");
    const ExprVector v = variables_.tail(M.tangent_dimension());
    for (const std::string& name : names.auxiliary) add(name);
    const ExprVector z = variables_.tail(system_.auxiliary_size());
    const Expr t = add("t");

    const ExprVector equations = system_.residual(x, v, z, t);
    for (Index i = 0; i < equations.size(); ++i)
      add("in " + equation_in_words(system_, i), equations[i]);
    if (!with_quantities) return;
    if (const auto energy = system_.energy(x, z, t)) add("in the energy H", *energy);
    const SymbolTable symbols = experiment.model.symbols(x, v, z, t);
    for (const DeclaredSymmetry& declared : experiment.symmetries)
      add("in the symmetry \"" + declared.name + '"', declared.symmetry.momentum(x));
    for (const Observable& observable : experiment.observe)
      if (!observable.uses_energies)
        add("in the observable \"" + observable.name + '"', evaluate(observable.formula, symbols));
  }

  std::string undefined_at(const State& state, const std::string& where) const {
    VectorXd values = VectorXd::Zero(variables_.size());
    Index offset = 0;
    const auto fill = [&](const VectorXd& part, Index size) {
      if (part.size() == size) values.segment(offset, size) = part;
      offset += size;
    };
    fill(state.x, system_.manifold()->ambient_dimension());
    fill(state.v, system_.manifold()->tangent_dimension());
    fill(state.z, system_.auxiliary_size());
    values[offset] = state.t;
    const auto found = find_undefined(
        Eigen::Map<const ExprVector>(expressions_.data(), static_cast<Index>(expressions_.size())),
        variables_, values);
    if (!found) return "";
    return found->formula + ' ' + places_[static_cast<std::size_t>(found->output)] +
           " has no value " + where + ": " + found->reason;
  }

 private:
  Expr add(const std::string& name) {
    variables_.conservativeResize(variables_.size() + 1);
    return variables_[variables_.size() - 1] = graph_.variable(name);
  }
  void add(std::string place, const Expr& expression) {
    places_.push_back(std::move(place));
    expressions_.push_back(expression);
  }

  const ImplicitSystem& system_;
  Graph graph_;
  ExprVector variables_;
  std::vector<Expr> expressions_;
  std::vector<std::string> places_;
};

}  // namespace

std::string undefined_formula(const Experiment& experiment, const State& state,
                              const std::string& where) {
  return Formulas(experiment, true).undefined_at(state, where);
}

std::string equation_in_words(const ImplicitSystem& system, Index equation) {
  const std::string& name = system.names().equations[static_cast<std::size_t>(equation)];
  if (name == "equation[" + std::to_string(equation) + "]")
    return "equation " + std::to_string(equation + 1);
  return "the equation \"" + name + '"';
}

std::string corner_in_words(const std::string& message, const ImplicitSystem& system,
                            const ConstraintLadder& ladder) {
  const Manifold& M = *system.manifold();
  if (!message.starts_with("constrain-first") || ladder.degrees_of_freedom == M.dimension())
    return "";
  Graph graph;
  const ExprVector equations = system.residual(
      graph.variables("x", M.ambient_dimension()), graph.variables("v", M.tangent_dimension()),
      graph.variables("z", system.auxiliary_size()), graph.variable("t"));
  for (Index i = 0; i < equations.size(); ++i) {
    const Subgraph part(equations.segment(i, 1));
    const bool has_corner = std::ranges::any_of(part.nodes(), [&](std::uint32_t node) {
      const Op op = part.graph().node(node).op;
      return op == Op::select || op == Op::min || op == Op::max || op == Op::abs;
    });
    if (has_corner)
      return " This method solves derivatives of the constraints, which jump where " +
             equation_in_words(system, i) +
             " has a corner (if, min, max, abs); expected discretize-first, or steps that end "
             "there.";
  }
  return "";
}

std::string condition_on_time_in_words(const ImplicitSystem& system) {
  const Manifold& M = *system.manifold();
  Graph graph;
  const Expr t = graph.variable("t");
  const ExprVector equations = system.residual(graph.variables("x", M.ambient_dimension()),
                                               graph.variables("v", M.tangent_dimension()),
                                               graph.variables("z", system.auxiliary_size()), t);
  for (Index i = 0; i < equations.size(); ++i) {
    const Subgraph part(equations.segment(i, 1));
    std::unordered_set<std::uint32_t> of_time;
    for (const std::uint32_t number : part.nodes()) {  // operands come first
      const Node node = part.graph().node(number);
      if (node.op == Op::select && of_time.contains(node.a))
        return " The solution jumps where a condition on t changes that " +
               equation_in_words(system, i) + " has; expected its times in /time/corners.";
      const std::array operands = {node.a, node.b, node.c};
      const auto last = operands.begin() + arity(node.op);
      if (t.node() == number ||
          std::any_of(operands.begin(), last, [&](auto of) { return of_time.contains(of); }))
        of_time.insert(number);
    }
  }
  return "";
}

std::string undefined_ahead(const Experiment& experiment, const ConstraintLadder& ladder,
                            const State& state, double h) {
  const Formulas formulas(experiment, false);
  const Manifold& M = *experiment.model.system->manifold();
  State ahead = state;
  VectorXd rate = VectorXd::Zero(state.x.size());
  if (state.v.size() == M.tangent_dimension())
    rate = values(ExprVector(M.frame(constants(state.x)) * constants(state.v)));
  std::unique_ptr<const VectorField> field;
  std::optional<VectorField::Evaluation> velocity;
  if (ladder.verdict == Verdict::regular) {
    field = std::make_unique<VectorField>(experiment.model.system, ladder, Backend::interpreter);
    velocity.emplace(*field);
  }
  constexpr int steps = 8;
  for (int k = 0; k < steps; ++k) {
    ahead.x += 2.0 * h / steps * rate;
    ahead.t += 2.0 * h / steps;
    if (std::string found = formulas.undefined_at(ahead, "ahead of the state"); !found.empty())
      return found;
    try {
      if (velocity) (*velocity)(ahead.x, rate, ahead.t);
    } catch (const std::domain_error&) {
      break;  // the velocity has none of the reasons that are looked for
    }
  }
  return "";
}

}  // namespace courant
