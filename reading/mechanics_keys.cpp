#include "courant/reading/mechanics_keys.hpp"

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"

namespace courant {
namespace {

// The variables that a formula of x, w and t is looked into at.
struct Trial {
  explicit Trial(const PhaseWords& words, Index N)
      : x(graph.variables("x", N)),
        w(graph.variables("w", words.bundle() ? words.force_size() : 0)),
        t(graph.variable("t")) {}
  Graph graph;
  ExprVector x, w;
  Expr t;
};

std::optional<Mechanics::Constraints> read_holonomic(const JsonReader& value,
                                                     const PhaseWords& words, const Trial& at) {
  const auto formulas = read_formulas(value);
  if (!formulas || !check(*formulas, words.at_rest(at.x, at.t), value.findings()))
    return std::nullopt;
  const ExprVector values = evaluate(*formulas, words.at_rest(at.x, at.t));
  const std::vector<bool> contains_coordinate = each_depends(values, at.x);
  bool right = true;
  for (Index i = 0; i < values.size(); ++i) {
    if (contains_coordinate[static_cast<std::size_t>(i)]) continue;
    value.findings().problem(formulas->formulas[static_cast<std::size_t>(i)].pointer,
                             "contains no coordinate; expected a function of the coordinates, "
                             "which is zero along the motion");
    right = false;
  }
  if (!right) return std::nullopt;
  return Mechanics::Constraints{
      texts(*formulas),
      [formulas = *formulas, words](const ExprVector& x, const ExprVector&, const Expr& t) {
        return evaluate(formulas, words.at_rest(x, t));
      }};
}

std::optional<Mechanics::Constraints> read_nonholonomic(const JsonReader& value,
                                                        const PhaseWords& words, const Trial& at) {
  const auto formulas = read_one_forms(value, words.at(at.x, at.w, at.t), at.w, "x'");
  if (!formulas) return std::nullopt;
  return Mechanics::Constraints{
      texts(*formulas),
      [formulas = *formulas, words](const ExprVector& x, const ExprVector& w, const Expr& t) {
        return evaluate(formulas, words.at(x, w, t));
      }};
}

// Formulas for all components, or an object of them by coordinate.
std::optional<WrittenFormulas> read_forces(const JsonReader& value, const PhaseWords& words) {
  const Index n = words.force_size();
  if (!value.value().is_object()) {
    const auto formulas = read_formulas(value);
    if (!formulas) return std::nullopt;
    if (static_cast<Index>(formulas->formulas.size()) == n) return formulas;
    value.problem("has " + std::to_string(formulas->formulas.size()) + " formulas; expected " +
                  std::to_string(n) +
                  ", one for each momentum, or an object of them by coordinate");
    return std::nullopt;
  }
  WrittenFormulas all{{n},
                      std::vector<WrittenFormula>(static_cast<std::size_t>(n),
                                                  WrittenFormula{"0", value.pointer()})};
  std::vector<bool> given(static_cast<std::size_t>(n), false);
  bool right = true;
  const auto entries = value.entries();
  if (!entries) return std::nullopt;
  for (const auto& [name, entry] : *entries) {
    const auto formulas = read_formulas(entry);
    if (!formulas) {
      right = false;
      continue;
    }
    try {
      const auto [first, count] = words.forces().find(parse_reference(name));
      if (static_cast<Index>(formulas->formulas.size()) != count)
        throw FormulaError(1, "has " + std::to_string(formulas->formulas.size()) +
                                  " formulas; expected " + std::to_string(count) + " for \"" +
                                  name + "\"");
      for (Index i = 0; i < count; ++i) {
        const auto place = static_cast<std::size_t>(first + i);
        if (given[place]) throw FormulaError(1, "\"" + name + "\" is given twice");
        given[place] = true;
        all.formulas[place] = formulas->formulas[static_cast<std::size_t>(i)];
      }
    } catch (const FormulaError& error) {
      entry.problem(std::string("key, ") + error.what());
      right = false;
    }
  }
  if (!right) return std::nullopt;
  return all;
}

// F = -∂R/∂w for a Rayleigh function R(x, w, t), differentiated at fresh variables.
ExprVector rayleigh_force(const WrittenFormula& formula, const PhaseWords& words,
                          const ExprVector& x, const ExprVector& w, const Expr& t) {
  const Graph graph = fresh_graph({x, w, ExprVector::Constant(1, t)});
  const ExprVector from = graph.variables("xwt", x.size() + w.size() + 1);
  const ExprVector velocity = from.segment(x.size(), w.size());
  const Expr R = evaluate(formula, words.at(from.head(x.size()), velocity, from[from.size() - 1]));
  ExprVector to(from.size());
  to << x, w, t;
  return -substitute(gradient(R, velocity), from, to);
}

// A Rayleigh function if there is a velocity in it, else a coefficient or a matrix.
std::optional<Mechanics::Formula> read_damping(const JsonReader& value, const PhaseWords& words,
                                               const Trial& at) {
  const auto formulas = read_formulas(value);
  if (!formulas) return std::nullopt;
  if (formulas->shape.empty()) {
    const SymbolTable symbols = words.at(at.x, at.w, at.t);
    if (!check(*formulas, symbols, value.findings())) return std::nullopt;
    if (depends(evaluate(*formulas, symbols), at.w))
      return [formula = formulas->formulas.front(), words](const ExprVector& x, const ExprVector& w,
                                                           const Expr& t) {
        return rayleigh_force(formula, words, x, w, t);
      };
  }
  const Index n = words.force_size();
  const auto matrix = read_square(value, n);
  if (!matrix || !check(*matrix, words.at_rest(at.x, at.t), value.findings())) return std::nullopt;
  return [matrix = *matrix, words, n](const ExprVector& x, const ExprVector& w, const Expr& t) {
    const ExprVector entries = evaluate(matrix, words.at_rest(x, t));
    ExprVector force = ExprVector::Zero(n);
    for (Index i = 0; i < n; ++i) force[i] = -entries.segment(i * n, n).dot(w);
    return force;
  };
}

}  // namespace

PhaseWords::PhaseWords(const Space& space, Vocabulary& vocabulary, SymbolTable& taken,
                       Findings& findings)
    : manifold_(space.manifold),
      bundle_(std::dynamic_pointer_cast<const CotangentBundle>(manifold_)) {
  const auto& declarations = space.coordinates.declarations();
  const std::size_t half = bundle_ ? declarations.size() / 2 : declarations.size();
  const bool named = bundle_ && !bundle_->base()->has_velocities_as_vectors();
  for (std::size_t i = half; i < declarations.size(); ++i) {
    const Declaration& momentum = declarations[i];
    momenta_.append(momentum);
    forces_.append({declarations[i - half].name, momentum.shape});
    Declaration velocity{"v_" + declarations[i - half].name, momentum.shape};
    if (!named || taken.find(velocity.name)) {
      velocities_.append_unnamed(velocity.size());
    } else {
      taken.add(velocity.name, velocity.shape, ExprVector::Ones(velocity.size()));
      velocities_.append(std::move(velocity));
    }
  }
  vocabulary.coordinates = space.coordinates;
  vocabulary.unknowns = velocities_;
  check_definitions(vocabulary, findings);
  base_ = vocabulary;
  base_.coordinates = base_.unknowns = NameList();
  for (std::size_t i = 0; i < half; ++i) base_.coordinates.append(declarations[i]);
}

SymbolTable PhaseWords::at(const ExprVector& x, const ExprVector& w, const Expr& t) const {
  if (!bundle_) return at_rest(x, t);
  const ExprVector q = bundle_->position(x);
  return table({.x = q, .velocity = (bundle_->base()->frame(q) * w).eval(), .t = t},
               bundle_->momentum(x), w);
}

SymbolTable PhaseWords::at_rest(const ExprVector& x, const Expr& t) const {
  if (!bundle_) return table({.x = x, .t = t}, std::nullopt, std::nullopt);
  return table({.x = bundle_->position(x).eval(), .t = t}, bundle_->momentum(x), std::nullopt);
}

SymbolTable PhaseWords::on_base(const ExprVector& q, const ExprVector& w, const Expr& t) const {
  return table({.x = q, .velocity = (bundle_->base()->frame(q) * w).eval(), .t = t}, std::nullopt,
               w);
}

SymbolTable PhaseWords::on_base_at_rest(const ExprVector& q, const std::optional<Expr>& t) const {
  return table({.x = q, .t = t}, std::nullopt, std::nullopt);
}

// Momenta and components of velocities are unknowns to the vocabulary, so that definitions may use
// them.
SymbolTable PhaseWords::table(Vocabulary::Arguments arguments, const std::optional<ExprVector>& p,
                              const std::optional<ExprVector>& w) const {
  Vocabulary words = base_;
  ExprVector values(0);
  if (p) {
    for (const Declaration& declaration : momenta_.declarations())
      words.unknowns.append(declaration);
    values = joined(values, *p);
  }
  if (w) {
    for (const Declaration& declaration : velocities_.declarations())
      words.unknowns.append(declaration);
    values = joined(values, *w);
  }
  arguments.z = values;
  return words.symbols(arguments);
}

std::vector<Key> mechanics_keys() {
  return {optional_key("holonomic", takes::formulas(),
                       "constraints: functions of the coordinates and t that are zero; multipliers "
                       "lambda"),
          optional_key("nonholonomic", takes::formulas(),
                       "constraints: one-forms in velocities such as \"z' - y*x'\" that are zero, "
                       "with reactions along them; multipliers lambda"),
          optional_key("forces", takes::components(),
                       "added to the rates of the momenta: formulas of coordinates, momenta, "
                       "velocities and t"),
          optional_key("damping", takes::formulas(),
                       "C: a force -C q', by a matrix, its diagonal or a number; or a Rayleigh "
                       "function R of velocities, a force -dR/dq'")};
}

std::optional<Mechanics> read_mechanics(ObjectReader& system, const PhaseWords& words) {
  const auto holonomic = system.optional("holonomic");
  const auto nonholonomic = system.optional("nonholonomic");
  const auto forces = system.optional("forces");
  const auto damping = system.optional("damping");
  const Trial at(words, words.manifold()->ambient_dimension());
  Mechanics mechanics;
  bool right = true;
  if (!words.bundle())
    for (const auto& key : {nonholonomic, forces, damping}) {
      if (!key) continue;
      key->problem("is about velocities of configurations, which " + words.manifold()->name() +
                   " does not have; expected a cotangent bundle as manifold");
      right = false;
    }
  if (holonomic) {
    const auto constraints = read_holonomic(*holonomic, words, at);
    if (constraints) mechanics.holonomic = *constraints;
    right = right && constraints;
  }
  if (!words.bundle()) return right ? std::optional(mechanics) : std::nullopt;
  if (nonholonomic) {
    const auto constraints = read_nonholonomic(*nonholonomic, words, at);
    if (constraints) mechanics.nonholonomic = *constraints;
    right = right && constraints;
  }
  std::optional<WrittenFormulas> written;
  if (forces) {
    written = read_forces(*forces, words);
    if (!written || !check(*written, words.at(at.x, at.w, at.t), forces->findings())) right = false;
  }
  std::optional<Mechanics::Formula> damped;
  if (damping) {
    damped = read_damping(*damping, words, at);
    right = right && damped;
  }
  if (!right) return std::nullopt;
  const auto projected = [base = words.bundle()->base(), words](Mechanics::Formula force) {
    return [base, words, force = std::move(force)](const ExprVector& x, const ExprVector& w,
                                                   const Expr& t) {
      const ExprVector q = words.bundle()->position(x);
      return ExprVector(base->tangent_projector(q).transpose() * force(x, w, t));
    };
  };
  if (written)
    mechanics.force = projected(
        [written = *written, words](const ExprVector& x, const ExprVector& w, const Expr& t) {
          return evaluate(written, words.at(x, w, t));
        });
  if (damped) mechanics.damping = projected(*damped);
  return mechanics;
}

std::string described(const Mechanics& mechanics) {
  std::string text;
  const auto add = [&](const std::string& part) {
    text += (text.empty() ? " with " : ", ") + part;
  };
  if (const Index m = mechanics.holonomic.count(); m > 0) add(counted(m, "holonomic constraint"));
  if (const Index m = mechanics.nonholonomic.count(); m > 0)
    add(counted(m, mechanics.vakonomic ? "vakonomic constraint" : "nonholonomic constraint"));
  if (mechanics.force || mechanics.damping) add("forces");
  return text;
}

void append_multipliers(NameList& unknowns, Index count, SymbolTable& taken) {
  if (count == 0 || taken.find("lambda")) {
    unknowns.append_unnamed(count);
    return;
  }
  Declaration declaration{"lambda", {}};
  if (count > 1) declaration.shape = {count};
  taken.add(declaration.name, declaration.shape, ExprVector::Ones(count));
  unknowns.append(std::move(declaration));
}

std::optional<WrittenFormulas> read_one_forms(const JsonReader& value, const SymbolTable& symbols,
                                              const ExprVector& velocities,
                                              const std::string& velocity) {
  const auto formulas = read_formulas(value);
  if (!formulas || !check(*formulas, symbols, value.findings())) return std::nullopt;
  const ExprVector values = evaluate(*formulas, symbols);
  bool right = true;
  for (Index i = 0; i < values.size(); ++i) {
    const std::string& pointer = formulas->formulas[static_cast<std::size_t>(i)].pointer;
    const SparseExprMatrix form = jacobian(values.segment(i, 1), velocities);
    if (form.values.size() == 0) {
      value.findings().problem(
          pointer, "contains no velocity such as " + velocity + "; expected a one-form" +
                       (velocity.ends_with("'") ? " such as \"z' - y*x'\" (functions of the "
                                                  "coordinates are \"holonomic\")"
                                                : ""));
      right = false;
    } else if (depends(form.values, velocities)) {
      value.findings().problem(
          pointer,
          "is not linear in the velocities; expected a one-form. What is not linear is an "
          "equation of the type \"implicit\", beside x' - v and the balance of momenta "
          "with a reaction of your choice");
      right = false;
    }
  }
  return right ? formulas : std::nullopt;
}

std::optional<WrittenFormulas> read_square(const JsonReader& value, Index n) {
  const auto formulas = read_formulas(value);
  if (!formulas) return std::nullopt;
  if (formulas->shape.size() == 2) {
    if (formulas->shape[0] == n && formulas->shape[1] == n) return formulas;
    value.problem("is a " + size_text(formulas->shape[0], formulas->shape[1]) +
                  " matrix; expected " + size_text(n, n));
    return std::nullopt;
  }
  const bool scalar = formulas->shape.empty();
  if (!scalar && formulas->shape[0] != n) {
    value.problem("has " + std::to_string(formulas->shape[0]) + " entries; expected " +
                  std::to_string(n) + ", the diagonal of a matrix, or a matrix");
    return std::nullopt;
  }
  WrittenFormulas matrix{{n, n}, {}};
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      matrix.formulas.push_back(i == j
                                    ? formulas->formulas[scalar ? 0 : static_cast<std::size_t>(i)]
                                    : WrittenFormula{"0", value.pointer()});
  return matrix;
}

}  // namespace courant
