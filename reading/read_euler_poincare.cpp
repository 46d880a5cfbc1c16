#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/language/declaration.hpp"
#include "courant/reading/lie_algebra_keys.hpp"
#include "courant/reading/mechanics_keys.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/euler_poincare.hpp"
#include "courant/structures/lie_group.hpp"
#include "courant/structures/representation.hpp"

namespace courant {
namespace {

// The words of formulas: μ, a, ξ and t.
struct ReducedWords {
  Vocabulary vocabulary;  // parameters and definitions
  NameList momentum, velocity, advected;

  SymbolTable at(const std::optional<ExprVector>& mu, const std::optional<ExprVector>& xi,
                 const ExprVector& a, const Expr& t) const {
    Vocabulary words = vocabulary;
    words.coordinates = words.unknowns = NameList();
    ExprVector values(0);
    const auto add = [&](const NameList& names, const ExprVector& more) {
      for (const Declaration& declaration : names.declarations())
        words.unknowns.append(declaration);
      values = joined(values, more);
    };
    if (mu) add(momentum, *mu);
    if (xi) add(velocity, *xi);
    add(advected, a);
    return words.symbols({.z = values, .t = t});
  }
};

// An array of n numbers of the name that a key has.
std::optional<NameList> read_array_name(ObjectReader& system, const std::string& key, Index n,
                                        SymbolTable& taken) {
  const auto given = system.optional(key);
  const std::string text = system.text(key);
  const JsonReader place = given.value_or(system.place());
  try {
    Declaration declaration = parse_declaration(text, taken);
    if (!declaration.shape.empty() && declaration.size() != n)
      throw FormulaError(1, "\"" + text + "\" has " + std::to_string(declaration.size()) +
                                " entries; expected " + std::to_string(n));
    declaration.shape = {n};
    taken.add(declaration.name, declaration.shape, ExprVector::Ones(n));
    NameList names;
    names.append(std::move(declaration));
    return names;
  } catch (const FormulaError& error) {
    place.problem(error.what());
    return std::nullopt;
  }
}

// The defining representation of so(n) on Rⁿ, in the basis of LieAlgebra; nothing for others.
std::vector<MatrixXd> defining_representation(const LieAlgebra& g) {
  const auto matrix = [](Index n, Index i, Index j) {
    MatrixXd E = MatrixXd::Zero(n, n);
    E(i, j) = 1.0;
    E(j, i) = -1.0;
    return E;
  };
  std::vector<MatrixXd> rho;
  if (g.name() == "so(3)" && g.constants()[0](1, 2) == 1.0) {  // a × x
    for (Index k = 0; k < 3; ++k) rho.push_back(matrix(3, (k + 2) % 3, (k + 1) % 3));
    return rho;
  }
  for (Index n = 2; n * (n - 1) / 2 <= g.dimension(); ++n) {
    if (g.name() != "so(" + std::to_string(n) + ")") continue;
    for (Index i = 0; i < n; ++i)
      for (Index j = i + 1; j < n; ++j) rho.push_back(matrix(n, i, j));
  }
  return rho;
}

// That of a word, on V for parameters a ∈ V*: vectors and tensors as they are seen from the body, and
// momenta; nothing where the word says nothing of this algebra.
std::vector<MatrixXd> named_representation(const std::string& word, const LieAlgebra& g) {
  if (word == "adjoint") return adjoint_representation(g);
  Representation vectors = defining_representation(g);
  if (word == "symmetric-matrices") return dual(symmetric_square(dual(vectors)));
  if (word == "two-forms") return dual(exterior_square(dual(vectors)));
  return vectors;
}

std::optional<std::vector<MatrixXd>> given_representation(const std::optional<JsonReader>& key,
                                                          const LieAlgebra& g) {
  if (!key) return defining_representation(g);
  if (!key->value().is_string()) return read_matrices(*key);
  const auto word = key->word({"vectors", "symmetric-matrices", "two-forms", "adjoint"});
  if (!word) return std::nullopt;
  return named_representation(*word, g);
}

// ρ on all advected parameters: as given, the same on each of several arrays.
std::optional<std::vector<MatrixXd>> read_representation(ObjectReader& system, const LieAlgebra& g,
                                                         const NameList& advected,
                                                         const std::optional<JsonReader>& names) {
  const auto key = system.optional("representation");
  if (advected.size() == 0) {
    if (key) key->problem("acts on nothing; expected \"advected\", the names of what it acts on");
    return key ? std::nullopt : std::optional(std::vector<MatrixXd>());
  }
  const auto given = given_representation(key, g);
  if (!given) return std::nullopt;
  const JsonReader& place = key ? *key : *names;
  if (given->empty()) {
    place.problem("need to know how " + g.name() +
                  " acts on them; expected a \"representation\", a matrix for each e_i");
    return std::nullopt;
  }
  const Index d = given->front().rows();
  if (static_cast<Index>(given->size()) != g.dimension() || !semidirect(g, *given, place))
    return std::nullopt;
  bool same = advected.size() == d;
  bool each = true;
  for (const Declaration& declaration : advected.declarations())
    each = each && declaration.size() == d;
  if (!same && !each) {
    place.problem("acts on " + std::to_string(d) + " numbers, but \"advected\" names " +
                  std::to_string(advected.size()) + "; expected as many, or arrays of " +
                  std::to_string(d));
    return std::nullopt;
  }
  const Index copies = advected.size() / d;
  std::vector<MatrixXd> rho;
  for (const MatrixXd& matrix : *given) {
    MatrixXd all = MatrixXd::Zero(copies * d, copies * d);
    for (Index c = 0; c < copies; ++c) all.block(c * d, c * d, d, d) = matrix;
    rho.push_back(std::move(all));
  }
  return rho;
}

// The group of an algebra, and names for the coordinates of its points.
struct Attitude {
  std::shared_ptr<const Manifold> group;
  NameList names;
};
std::optional<Attitude> read_attitude(const JsonReader& key, const LieAlgebra& g, bool plus,
                                      SymbolTable& taken) {
  Attitude attitude{group_of(g), {}};
  if (!read_names(key, taken, attitude.names)) return std::nullopt;
  if (!attitude.group) {
    key.problem("no group is known for the Lie algebra " + g.name() +
                ", by its matrices or those of its adjoint representation; expected an algebra "
                "with a name, or "
                "one of \"matrices\"");
    return std::nullopt;
  }
  if (plus) {
    key.problem("is for left-invariant systems; expected the sign \"minus\"");
    return std::nullopt;
  }
  if (const Index N = attitude.group->ambient_dimension(); attitude.names.size() != N) {
    key.problem("names " + std::to_string(attitude.names.size()) + " numbers; expected " +
                std::to_string(N) + ", those of a point of " + attitude.group->name());
    return std::nullopt;
  }
  return attitude;
}

}  // namespace

// (μ, a) ∈ (g ⋉ V)*.
std::optional<Model> read_euler_poincare(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto algebra = read_lie_algebra(system);
  const auto lagrangian_key = system.optional("lagrangian");
  const auto hamiltonian_key = system.optional("hamiltonian");
  const auto inputs_key = system.optional("inputs");
  const auto nonholonomic_key = system.optional("nonholonomic");
  const bool plus = system.word("sign") == "plus";
  if (!lagrangian_key == !hamiltonian_key) {
    system.place().problem(
        "has both a \"lagrangian\" and a \"hamiltonian\", or none; expected one of the two");
    return std::nullopt;
  }
  if (!algebra) return std::nullopt;
  const Index n = algebra->dimension();
  ReducedWords words;
  const auto momentum = read_array_name(system, "momentum", n, taken);
  const auto velocity = read_array_name(system, "velocity", n, taken);
  const auto advected_key = system.optional("advected");
  const auto attitude_key = system.optional("attitude");
  const bool named = !advected_key || read_names(*advected_key, taken, words.advected);
  if (!momentum || !velocity || !named) return std::nullopt;
  words.momentum = *momentum;
  words.velocity = *velocity;
  const auto representation = read_representation(system, *algebra, words.advected, advected_key);
  const auto attitude = attitude_key ? read_attitude(*attitude_key, *algebra, plus, taken)
                                     : std::optional(Attitude());
  if (!representation || !attitude) return std::nullopt;

  vocabulary.coordinates = words.momentum;
  for (const Declaration& declaration : words.advected.declarations())
    vocabulary.coordinates.append(declaration);
  for (const Declaration& declaration : attitude->names.declarations())
    vocabulary.coordinates.append(declaration);
  vocabulary.unknowns = words.velocity;
  check_definitions(vocabulary, findings);
  words.vocabulary = vocabulary;
  if (!lagrangian_key) vocabulary.unknowns = NameList();

  Graph graph;
  const ExprVector mu = graph.variables("mu", n), xi = graph.variables("xi", n),
                   a = graph.variables("a", words.advected.size());
  const Expr t = graph.variable("t");
  EulerPoincare problem{.algebra = *algebra,
                        .representation = *representation,
                        .sign = plus ? LiePoisson::Sign::plus : LiePoisson::Sign::minus,
                        .group = attitude->group};
  bool right = true;
  const JsonReader& energy_key = lagrangian_key ? *lagrangian_key : *hamiltonian_key;
  const auto energy = read_formula(energy_key);
  if (!energy ||
      !check(*energy, lagrangian_key ? words.at({}, xi, a, t) : words.at(mu, {}, a, t), findings))
    right = false;
  else if (lagrangian_key)
    problem.lagrangian = [formula = *energy, words](const ExprVector& at, const ExprVector& b,
                                                    const Expr& time) {
      return evaluate(formula, words.at({}, at, b, time));
    };
  else
    problem.hamiltonian = [formula = *energy, words](const ExprVector& at, const ExprVector& b,
                                                     const Expr& time) {
      return evaluate(formula, words.at(at, {}, b, time));
    };
  if (inputs_key) {
    const auto inputs = read_formulas(*inputs_key);
    if (inputs && static_cast<Index>(inputs->formulas.size()) != n) {
      inputs_key->problem("has " + std::to_string(inputs->formulas.size()) +
                          " formulas; expected " + std::to_string(n) + ", one for each momentum");
      right = false;
    } else if (!inputs || !check(*inputs, words.at(mu, xi, a, t), findings)) {
      right = false;
    } else {
      problem.input = [formulas = *inputs, words](const ExprVector& m, const ExprVector& b,
                                                  const ExprVector& y, const Expr& time) {
        return evaluate(formulas, words.at(m, y, b, time));
      };
    }
  }
  if (nonholonomic_key) {
    const auto constraints = read_one_forms(*nonholonomic_key, words.at({}, xi, a, t), xi,
                                            words.velocity.element_names().front());
    if (constraints) {
      problem.constraint = [formulas = *constraints, words](const ExprVector& b,
                                                            const ExprVector& y, const Expr& time) {
        return evaluate(formulas, words.at({}, y, b, time));
      };
      for (const WrittenFormula& formula : constraints->formulas)
        problem.constraint_names.push_back(formula.text);
    } else {
      right = false;
    }
  }
  if (!right) return std::nullopt;
  append_multipliers(vocabulary.unknowns, static_cast<Index>(problem.constraint_names.size()),
                     taken);
  model.description =
      std::string(lagrangian_key ? "Euler–Poincaré" : "Lie–Poisson") + " system on the dual of " +
      algebra->name() + (problem.group ? " with the attitude" : "") +
      (problem.constraint ? " with constraints" : "") + (problem.input ? " with inputs" : "");
  model.system = euler_poincare_system(
      problem, {vocabulary.coordinates.element_names(), words.velocity.element_names()});
  return model;
}

}  // namespace courant
