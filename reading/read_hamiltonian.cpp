#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant {

// S = {v : (v, dH) ∈ D}.
std::optional<Model> read_hamiltonian(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto space = read_structure_space(system, vocabulary, taken);
  const auto key = system.required("hamiltonian");
  const auto formula = key ? read_formula(*key) : std::nullopt;
  if (!space) return std::nullopt;

  vocabulary.coordinates = space->coordinates;
  check_definitions(vocabulary, findings);
  const auto structure =
      structure_kinds().read_key(system, "structure", {space->manifold, vocabulary});
  Graph graph;
  const SymbolTable symbols = vocabulary.symbols(
      {.x = graph.variables("x", vocabulary.coordinates.size()), .t = graph.variable("t")});
  if (!formula || !check(*formula, symbols, findings) || !structure) return std::nullopt;

  const auto manifold = (*structure)->manifold();
  const auto family = std::make_shared<Hamiltonian>(
      manifold, [formula = *formula, vocabulary](const ExprVector& x, const Expr& t) {
        return evaluate(formula, vocabulary.symbols({.x = x, .t = t}));
      });
  model.description = "Hamiltonian system on " + manifold->name();
  model.system = std::make_shared<DiracSystem>(
      *structure, family, ImplicitSystem::Names{vocabulary.coordinates.element_names(), {}, {}});
  return model;
}

}  // namespace courant
