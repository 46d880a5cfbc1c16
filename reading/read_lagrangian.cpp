#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/reading/space.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/lagrangian_system.hpp"

namespace courant {

// `coordinates` and `manifold` are those of Q; points of the system are (q, p) ∈ T*Q.
std::optional<Model> read_lagrangian(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto base = read_space(system, vocabulary, taken);
  const auto key = system.required("lagrangian");
  const auto formula = key ? read_formula(*key) : std::nullopt;
  const auto space =
      base ? cotangent_bundle(*base, taken, *system.optional("coordinates")) : std::nullopt;
  if (!space) return std::nullopt;

  vocabulary.coordinates = space->coordinates;
  check_definitions(vocabulary, findings);
  Vocabulary on_base = vocabulary;
  on_base.coordinates = base->coordinates;
  Graph graph;
  const Index N = base->coordinates.size();
  const SymbolTable symbols = on_base.symbols({.x = graph.variables("q", N),
                                               .velocity = graph.variables("v", N),
                                               .t = graph.variable("t")});
  if (!formula || !check(*formula, symbols, findings)) return std::nullopt;

  const Lagrangian::Formula lagrangian = [formula = *formula, on_base, Q = base->manifold](
                                             const ExprVector& q, const ExprVector& w,
                                             const Expr& t) {
    return evaluate(formula,
                    on_base.symbols({.x = q, .velocity = (Q->frame(q) * w).eval(), .t = t}));
  };
  model.description = "Lagrangian system on " + base->manifold->name();
  model.system =
      lagrangian_system(std::dynamic_pointer_cast<const CotangentBundle>(space->manifold),
                        lagrangian, vocabulary.coordinates.element_names());
  return model;
}

}  // namespace courant
