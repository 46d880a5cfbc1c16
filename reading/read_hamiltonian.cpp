#include "courant/reading/mechanics_keys.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/lagrangian_system.hpp"

namespace courant {

// S = {v : (v, dH) ∈ D}, with constraints and forces.
std::optional<Model> read_hamiltonian(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto space = read_structure_space(system, vocabulary, taken);
  const auto key = system.required("hamiltonian");
  const auto formula = key ? read_formula(*key) : std::nullopt;
  if (!space) return std::nullopt;

  const PhaseWords words(*space, vocabulary, taken, findings);
  vocabulary.unknowns = NameList();
  const auto structure =
      structure_kinds().read_key(system, "structure", {space->manifold, vocabulary});
  Graph graph;
  const SymbolTable symbols = vocabulary.symbols(
      {.x = graph.variables("x", vocabulary.coordinates.size()), .t = graph.variable("t")});
  const bool right = formula && check(*formula, symbols, findings);
  const auto mechanics = read_mechanics(system, words);
  if (!right || !structure || !mechanics) return std::nullopt;

  const auto manifold = (*structure)->manifold();
  const auto family = std::make_shared<Hamiltonian>(
      manifold, [formula = *formula, vocabulary](const ExprVector& x, const Expr& t) {
        return evaluate(formula, vocabulary.symbols({.x = x, .t = t}));
      });
  append_multipliers(vocabulary.unknowns,
                     mechanics->holonomic.count() + mechanics->nonholonomic.count(), taken);
  vocabulary.unknowns.append_unnamed((*structure)->port_size());
  model.description = "Hamiltonian system on " + manifold->name() + described(*mechanics);
  model.system =
      hamiltonian_system(*structure, family, vocabulary.coordinates.element_names(), *mechanics);
  if (std::dynamic_pointer_cast<const CanonicalSymplectic>(*structure))
    if (const auto D = nonholonomic_structure(words.bundle(), *mechanics))
      model.structures = {{"nonholonomic", D}};
  return model;
}

}  // namespace courant
