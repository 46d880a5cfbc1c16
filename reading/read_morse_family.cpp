// Systems by a Morse family of their own: E(x, λ) in formulas, and Pontryagin's.
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/lagrangian_system.hpp"
#include "courant/structures/morse_family.hpp"

namespace courant {

// (v, α) ∈ D, α ∈ 𝓛 = {∂_xE : ∂_λE = 0}.
std::optional<Model> read_morse_family(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto space = read_structure_space(system, vocabulary, taken);
  const auto multipliers = system.optional("multipliers");
  const bool named = !multipliers || read_names(*multipliers, taken, vocabulary.unknowns);
  const auto key = system.required("family");
  const auto formula = key ? read_formula(*key) : std::nullopt;
  if (!space || !named) return std::nullopt;

  vocabulary.coordinates = space->coordinates;
  check_definitions(vocabulary, findings);
  const Vocabulary words = vocabulary;
  Vocabulary at_point = vocabulary;
  at_point.unknowns = NameList();
  const auto structure =
      structure_kinds().read_key(system, "structure", {space->manifold, at_point});
  Graph graph;
  const Index k = words.unknowns.size();
  const SymbolTable symbols = words.symbols({.x = graph.variables("x", words.coordinates.size()),
                                             .z = graph.variables("z", k),
                                             .t = graph.variable("t")});
  if (!formula || !check(*formula, symbols, findings) || !structure) return std::nullopt;

  const auto family = std::make_shared<MorseFamily>(
      (*structure)->manifold(), k,
      [formula = *formula, words](const ExprVector& x, const ExprVector& lambda, const Expr& t) {
        return evaluate(formula, words.symbols({.x = x, .z = lambda, .t = t}));
      });
  vocabulary.unknowns.append_unnamed((*structure)->port_size());
  model.description = "Morse family with " + std::to_string(k) +
                      (k == 1 ? " multiplier on " : " multipliers on ") +
                      (*structure)->manifold()->name();
  model.system = hamiltonian_system(*structure, family, vocabulary.coordinates.element_names(), {},
                                    words.unknowns.element_names());
  return model;
}

// E(q, p, u) = ⟨p, f(q, u)⟩ - ℓ(q, u) on T*Q, Q the manifold of the states.
std::optional<Model> read_optimal_control(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto base = read_space(system, vocabulary, taken, "states");
  const auto controls = system.required("controls");
  const bool named = controls && read_names(*controls, taken, vocabulary.unknowns);
  const auto dynamics_key = system.required("dynamics");
  const auto dynamics = dynamics_key ? read_formulas(*dynamics_key) : std::nullopt;
  const auto cost_key = system.required("cost");
  const auto cost = cost_key ? read_formula(*cost_key) : std::nullopt;
  const auto final_key = system.optional("final_cost");
  const auto final_cost = final_key ? read_formula(*final_key) : std::nullopt;
  const bool abnormal = system.word("extremals") == "abnormal";
  const auto space =
      base ? cotangent_bundle(*base, taken, *system.optional("states")) : std::nullopt;
  if (!space || !named) return std::nullopt;

  vocabulary.coordinates = space->coordinates;
  check_definitions(vocabulary, findings);
  Vocabulary words = vocabulary;
  words.coordinates = base->coordinates;
  const Manifold& Q = *base->manifold;
  Graph graph;
  const ExprVector q = graph.variables("q", Q.ambient_dimension()),
                   u = graph.variables("u", words.unknowns.size());
  const Expr t = graph.variable("t");
  const SymbolTable symbols = words.symbols({.x = q, .z = u, .t = t});
  bool right = cost && check(*cost, symbols, findings);
  if (final_cost) right = check(*final_cost, words.symbols({.x = q, .t = t}), findings) && right;
  if (dynamics) {
    const auto count = static_cast<Index>(dynamics->formulas.size());
    const Index N = Q.ambient_dimension(), n = Q.tangent_dimension();
    if (count != N && count != n) {
      dynamics_key->problem(
          "has " + std::to_string(count) + " formulas; expected " + std::to_string(N) +
          ", one for each coordinate" +
          (N == n ? "" : ", or " + std::to_string(n) + " for the components of a tangent vector"));
      right = false;
    } else {
      right = check(*dynamics, symbols, findings) && right;
    }
  }
  if (!right || !dynamics) return std::nullopt;

  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(space->manifold);
  const auto table = [words](const ExprVector& q, const ExprVector& u, const Expr& t) {
    return words.symbols({.x = q, .z = u, .t = t});
  };
  const ControlProblem problem{
      .cost = [formula = *cost, table](const ExprVector& q, const ExprVector& u,
                                       const Expr& t) { return evaluate(formula, table(q, u, t)); },
      .dynamics =
          [formulas = *dynamics, table, Q = base->manifold](const ExprVector& q,
                                                            const ExprVector& u, const Expr& t) {
            const ExprVector f = evaluate(formulas, table(q, u, t));
            return f.size() == Q->tangent_dimension() && f.size() != Q->ambient_dimension()
                       ? f
                       : ExprVector(Q->coframe(q) * f);
          },
      .controls = words.unknowns.size(),
      .cost_multiplier = abnormal ? 0.0 : 1.0};
  model.is_control_problem = true;
  if (!abnormal) model.final_cost = final_cost;
  model.description =
      "optimal control on " + Q.name() + ", " + (abnormal ? "abnormal" : "normal") + " extremals";
  model.system = hamiltonian_system(
      std::make_shared<CanonicalSymplectic>(bundle), pontryagin_family(bundle, problem),
      vocabulary.coordinates.element_names(), {}, words.unknowns.element_names());
  return model;
}

}  // namespace courant
