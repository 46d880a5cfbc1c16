// Systems with a Lagrangian: in formulas, or of a metric and a potential; nonholonomic and vakonomic.
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/reading/mechanics_keys.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/lagrangian_system.hpp"

namespace courant {
namespace {

// What a kind of system takes, and the keys that have been found.
struct LagrangianKeys {
  bool formula = false;  // a Lagrangian in formulas; else a metric and a potential
  bool structure = false;
  bool vakonomic = false;
  std::optional<JsonReader> lagrangian = {}, metric = {}, potential = {};
};

std::optional<Lagrangian::Formula> read_formula_of_lagrangian(const JsonReader& key,
                                                              const PhaseWords& words) {
  const auto formula = read_formula(key);
  const Manifold& Q = *words.bundle()->base();
  Graph graph;
  const SymbolTable symbols =
      words.on_base(graph.variables("q", Q.ambient_dimension()),
                    graph.variables("w", Q.tangent_dimension()), graph.variable("t"));
  if (!formula || !check(*formula, symbols, key.findings())) return std::nullopt;
  return [formula = *formula, words](const ExprVector& q, const ExprVector& w, const Expr& t) {
    return evaluate(formula, words.on_base(q, w, t));
  };
}

// Whether g(q) is symmetric at some random points; a problem where not.
bool is_symmetric(const Manifold& Q, const MatrixField& metric, const JsonReader& place) {
  for (const MatrixXd& g : sampled(Q, metric))
    if ((g - g.transpose()).cwiseAbs().maxCoeff() > 1e-12 * g.cwiseAbs().maxCoeff()) {
      place.problem("is not symmetric at a random point; expected a metric");
      return false;
    }
  return true;
}

std::optional<Lagrangian::Formula> read_metric_and_potential(const LagrangianKeys& keys,
                                                             const PhaseWords& words) {
  const Manifold& Q = *words.bundle()->base();
  const Index N = Q.ambient_dimension(), n = Q.tangent_dimension();
  Graph graph;
  const ExprVector q = graph.variables("q", N);
  bool right = true;
  MatrixField metric = [n](const ExprVector&) { return ExprMatrix(ExprMatrix::Identity(n, n)); };
  if (keys.metric) {
    const auto formulas = read_square(*keys.metric, n);
    // Of the coordinates alone, without t.
    if (formulas && check(*formulas, words.on_base_at_rest(q), keys.metric->findings())) {
      metric = [formulas = *formulas, words, n](const ExprVector& at) {
        const ExprVector entries = evaluate(formulas, words.on_base_at_rest(at));
        ExprMatrix g(n, n);
        for (Index i = 0; i < n; ++i) g.row(i) = entries.segment(i * n, n);
        return g;
      };
      right = is_symmetric(Q, metric, *keys.metric);
    } else {
      right = false;
    }
  }
  std::optional<WrittenFormula> potential;
  if (keys.potential) {
    potential = read_formula(*keys.potential);
    if (!potential || !check(*potential, words.on_base_at_rest(q, graph.variable("t")),
                             keys.potential->findings()))
      right = false;
  }
  if (!right) return std::nullopt;
  return mechanical_lagrangian(metric, [potential, words](const ExprVector& at, const Expr& t) {
    return potential ? evaluate(*potential, words.on_base_at_rest(at, t)) : Expr(0.0);
  });
}

std::optional<Model> read(ObjectReader& system, const LagrangianKeys& keys) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto base = read_space(system, vocabulary, taken);
  const auto space =
      base ? cotangent_bundle(*base, taken, *system.optional("coordinates")) : std::nullopt;
  if (!space) return std::nullopt;

  const PhaseWords words(*space, vocabulary, taken, findings);
  const auto lagrangian = !keys.formula     ? read_metric_and_potential(keys, words)
                          : keys.lagrangian ? read_formula_of_lagrangian(*keys.lagrangian, words)
                                            : std::nullopt;
  auto mechanics = read_mechanics(system, words);
  std::shared_ptr<const DiracStructure> structure;
  if (keys.structure) {
    Vocabulary at_point = vocabulary;
    at_point.unknowns = NameList();
    const auto read_structure =
        structure_kinds().read_key(system, "structure", {space->manifold, at_point});
    if (!read_structure) return std::nullopt;
    structure = *read_structure;
    if (*structure->manifold() != *space->manifold) {
      system.optional("structure")
          ->problem("is on " + structure->manifold()->name() + "; expected a structure on " +
                    space->manifold->name());
      return std::nullopt;
    }
    if (std::dynamic_pointer_cast<const CanonicalSymplectic>(structure)) structure = nullptr;
  }
  if (!lagrangian || !mechanics) return std::nullopt;
  mechanics->vakonomic = keys.vakonomic;
  append_multipliers(vocabulary.unknowns,
                     mechanics->holonomic.count() + mechanics->nonholonomic.count(), taken);
  if (structure) vocabulary.unknowns.append_unnamed(structure->port_size());

  model.description = (keys.vakonomic ? "vakonomic system on "
                       : keys.formula ? "Lagrangian system on "
                                      : "mechanical system on ") +
                      base->manifold->name() + described(*mechanics);
  model.system = lagrangian_system(words.bundle(), *lagrangian,
                                   vocabulary.coordinates.element_names(), *mechanics, structure);
  if (!structure)
    if (const auto D = nonholonomic_structure(words.bundle(), *mechanics))
      model.structures = {{"nonholonomic", D}};
  return model;
}

}  // namespace

// `coordinates` and `manifold` are those of Q; points of the system are (q, p) ∈ T*Q.
std::optional<Model> read_lagrangian(ObjectReader& system) {
  return read(system,
              {.formula = true, .structure = true, .lagrangian = system.required("lagrangian")});
}

std::optional<Model> read_mechanical(ObjectReader& system) {
  return read(system,
              {.metric = system.optional("metric"), .potential = system.optional("potential")});
}

std::optional<Model> read_vakonomic(ObjectReader& system) {
  const auto lagrangian = system.optional("lagrangian"), metric = system.optional("metric"),
             potential = system.optional("potential");
  for (const auto& key : {metric, potential})
    if (lagrangian && key) {
      key->problem("is there beside a \"lagrangian\"; expected one of the two");
      return std::nullopt;
    }
  return read(system, {.formula = lagrangian.has_value(),
                       .vakonomic = true,
                       .lagrangian = lagrangian,
                       .metric = metric,
                       .potential = potential});
}

}  // namespace courant
