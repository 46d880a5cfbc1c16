// Mechanisms: rigid bodies, joints and springs.
#include <algorithm>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/reading/mechanism_model.hpp"
#include "courant/reading/mechanism_parts.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/lagrangian_system.hpp"

namespace courant {
namespace {

// Adds names to those that are taken; a problem at its place for each that is taken already.
bool take_names(const NameList& names, const std::string& pointer, SymbolTable& taken,
                Findings& findings) {
  bool right = true;
  for (const Declaration& declaration : names.declarations()) {
    if (taken.find(declaration.name)) {
      findings.problem(pointer, "gives " + in_quotes(declaration.name) +
                                    " a second meaning; expected other names of bodies, joints, "
                                    "points or parameters");
      right = false;
      continue;
    }
    taken.add(declaration.name, declaration.shape, ExprVector::Ones(declaration.size()));
  }
  return right;
}

// Whether the formulas of loads are right.
bool check_loads(const WrittenMechanism& written, const PhaseWords& words, Findings& findings) {
  Graph graph;
  const SymbolTable symbols =
      words.at(graph.variables("x", words.manifold()->ambient_dimension()),
               graph.variables("w", words.force_size()), graph.variable("t"));
  bool right = true;
  const auto check_all = [&](const std::vector<WrittenFormula>& formulas) {
    for (const WrittenFormula& formula : formulas)
      right = check(formula, symbols, findings) && right;
  };
  for (const WrittenMechanism::Joint& joint : written.joints) check_all(joint.effort);
  for (const WrittenMechanism::Force& force : written.forces) {
    check_all(force.force);
    check_all(force.torque);
  }
  return right;
}

Mechanics mechanics_of(const std::shared_ptr<const MechanismModel>& model,
                       const std::shared_ptr<const PhaseWords>& words) {
  const Index N = model->typed().manifold()->ambient_dimension();
  Mechanics mechanics;
  mechanics.holonomic.names = model->condition_names();
  mechanics.holonomic.formula = [model, N](const ExprVector& x, const ExprVector&, const Expr&) {
    return model->conditions(x.head(N));
  };
  mechanics.damping = [model, N](const ExprVector& x, const ExprVector& w, const Expr&) {
    const ExprVector q = x.head(N);
    const Mechanism mechanism = model->at(q);
    const Mechanism::Motion motion = mechanism.motion(q);
    return mechanism.generalised(motion, mechanism.dampers(motion, w));
  };
  mechanics.force = [model, words, N](const ExprVector& x, const ExprVector& w, const Expr& t) {
    const ExprVector q = x.head(N);
    const Mechanism mechanism = model->at(q);
    const Mechanism::Motion motion = mechanism.motion(q);
    const SymbolTable symbols = words->at(x, w, t);
    std::vector<Mechanism::Load> loads = model->forces(mechanism, motion, symbols);
    const std::vector<ExprVector> efforts = model->efforts(symbols);
    for (std::size_t j = 0; j < efforts.size(); ++j)
      if (efforts[j].size() > 0)
        for (Mechanism::Load& load :
             mechanism.joint_loads(motion, static_cast<Index>(j), efforts[j]))
          loads.push_back(std::move(load));
    return mechanism.generalised(motion, loads);
  };
  // What is not there is left out, so that steps need not ask what it does.
  const WrittenMechanism& written = model->written();
  const auto is_driven = [](const WrittenMechanism::Joint& joint) { return !joint.effort.empty(); };
  const auto is_damped = [](const Mechanism::Spring& spring) {
    return !spring.damping.is_constant(0.0);
  };
  if (written.forces.empty() && std::ranges::none_of(written.joints, is_driven))
    mechanics.force = {};
  const auto has_damping = [](const WrittenMechanism::Joint& joint) {
    return !joint.damping.empty();
  };
  if (std::ranges::none_of(written.joints, has_damping) &&
      std::ranges::none_of(model->typed().parts().springs, is_damped))
    mechanics.damping = {};
  return mechanics;
}

std::string described(const Mechanism& mechanism) {
  const auto& loops = mechanism.loops();
  const auto bodies = std::ssize(mechanism.parts().bodies);
  std::string text = "mechanism of " + std::to_string(bodies) +
                     (bodies == 1 ? " body" : " bodies") + " and " +
                     counted(std::ssize(mechanism.parts().joints), "joint") + " on " +
                     mechanism.manifold()->name();
  if (!loops.empty() && !mechanism.parts().is_absolute)
    text += ", " + counted(std::ssize(loops), "loop");
  return text;
}

}  // namespace

std::optional<Model> read_mechanism(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system, {"T", "V", "H"});
  Vocabulary constants = vocabulary;
  constants.tables.clear();
  constants.definitions.clear();
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const SymbolTable parameters = constants.symbols({});
  auto written = read_mechanism_parts(system, parameters);
  if (!written) return std::nullopt;
  const auto parts = std::make_shared<const MechanismModel>(std::move(*written), constants);
  const Mechanism& mechanism = parts->typed();

  const auto bundle = std::make_shared<CotangentBundle>(mechanism.manifold());
  Space space{bundle, parts->coordinates()};
  const NameList momenta = parts->momenta();
  for (const Declaration& declaration : momenta.declarations())
    space.coordinates.append(declaration);
  const std::string pointer = system.place().pointer();
  bool right = take_names(space.coordinates, pointer, taken, findings);
  vocabulary.derived = parts->quantities();
  for (const Vocabulary::Derived& derived : vocabulary.derived)
    right = take_names(derived.names, pointer, taken, findings) && right;
  right = take_names(parts->reaction_names(), pointer, taken, findings) && right;
  if (!right) return std::nullopt;

  // Definitions may use reactions, of which the names alone are known here.
  vocabulary.derived.push_back(
      {parts->reaction_names(),
       [size = parts->reaction_names().size(),
        bundle](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
         if (!at.x || at.x->size() != bundle->ambient_dimension() || !at.velocity || !at.z || !at.t)
           return std::nullopt;
         return ExprVector(ExprVector::Constant(size, *at.t));
       }});
  const auto words = std::make_shared<const PhaseWords>(space, vocabulary, taken, findings);
  if (!check_loads(parts->written(), *words, findings)) return std::nullopt;

  const Mechanics mechanics = mechanics_of(parts, words);
  append_multipliers(vocabulary.unknowns, mechanics.holonomic.count(), taken);
  model.description = described(mechanism);
  model.system = lagrangian_system(
      bundle,
      [parts](const ExprVector& q, const ExprVector& w, const Expr&) {
        const Mechanism there = parts->at(q);
        const Mechanism::Motion motion = there.motion(q);
        return there.kinetic_energy(motion, w) - there.potential(motion, q);
      },
      vocabulary.coordinates.element_names(), mechanics);
  vocabulary.derived.back() = parts->reactions(words);
  model.reference = [parts, bundle](const std::vector<std::pair<std::string, double>>& given) {
    VectorXd x = VectorXd::Zero(bundle->ambient_dimension());
    const VectorXd q = parts->reference(given);
    x.head(q.size()) = q;
    return x;
  };
  model.starts_at_zero = true;
  return model;
}

}  // namespace courant
