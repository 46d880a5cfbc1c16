#include "courant/reading/symmetries.hpp"

#include <optional>

#include "courant/core/language/declaration.hpp"

namespace courant {
namespace {

// The words of generators: the coordinates of Q, and the names of tangent components where these
// are others than those of coordinates.
struct ConfigurationWords {
  ConfigurationWords(const Vocabulary& whole, const Manifold& Q) : vocabulary(whole) {
    vocabulary.coordinates = vocabulary.unknowns = NameList();
    const auto& declarations = whole.coordinates.declarations();
    const std::size_t half = declarations.size() / 2;
    const bool named = !Q.has_velocities_as_vectors();
    for (std::size_t i = 0; i < half; ++i) {
      vocabulary.coordinates.append(declarations[i]);
      const Shape& shape = declarations[half + i].shape;
      if (named)
        components.append({"v_" + declarations[i].name, shape});
      else
        components.append_unnamed(element_count(shape));
    }
  }
  Vocabulary vocabulary;
  NameList components;
};

// Formulas of some entries of a vector.
struct FormulaPart {
  Index first;
  bool is_component;  // of the tangent vector
  WrittenFormulas formulas;
};

std::optional<FormulaPart> read_formula_part(const std::string& name, const JsonReader& value,
                                             const ConfigurationWords& words,
                                             const SymbolTable& symbols) {
  const auto formulas = read_formulas(value);
  if (!formulas || !check(*formulas, symbols, value.findings())) return std::nullopt;
  try {
    const Reference reference = parse_reference(name);
    const bool is_component = words.components.contains(reference.name) &&
                              !words.vocabulary.coordinates.contains(reference.name);
    const auto [first, count] =
        (is_component ? words.components : words.vocabulary.coordinates).find(reference);
    if (const auto given = static_cast<Index>(formulas->formulas.size()); given != count) {
      value.problem("has " + std::to_string(given) + " formulas; expected " +
                    std::to_string(count) + " for \"" + name + "\"");
      return std::nullopt;
    }
    return FormulaPart{first, is_component, *formulas};
  } catch (const FormulaError& error) {
    value.problem(std::string("key, ") + error.what());
    return std::nullopt;
  }
}

std::optional<Symmetry> read_symmetry(const JsonReader& value, const ConfigurationWords& words,
                                      const std::shared_ptr<const CotangentBundle>& phase_space) {
  const auto entries = value.entries();
  if (!entries) return std::nullopt;
  const Manifold& Q = *phase_space->base();
  Graph graph;
  const SymbolTable symbols =
      words.vocabulary.symbols({.x = graph.variables("q", Q.ambient_dimension())});
  std::vector<FormulaPart> parts;
  bool right = true;
  std::vector<std::pair<bool, Index>> given;
  for (const auto& [name, entry] : *entries) {
    const auto part = read_formula_part(name, entry, words, symbols);
    right = right && part;
    if (!part) continue;
    for (Index i = 0; i < std::ssize(part->formulas.formulas); ++i) {
      const std::pair<bool, Index> place{part->is_component, part->first + i};
      if (std::ranges::find(given, place) != given.end()) {
        entry.problem("key, \"" + name + "\" is given twice");
        right = false;
        break;
      }
      given.push_back(place);
    }
    parts.push_back(*part);
  }
  if (right && parts.empty()) {
    value.problem(
        "moves nothing; expected formulas by coordinate, such as {\"x\": \"-y\", "
        "\"y\": \"x\"}");
    right = false;
  }
  if (!right) return std::nullopt;
  return Symmetry(phase_space, [parts, words, base = phase_space->base()](const ExprVector& q) {
    const SymbolTable at = words.vocabulary.symbols({.x = q});
    ExprVector rates = ExprVector::Zero(q.size());
    ExprVector components = ExprVector::Zero(base->tangent_dimension());
    for (const FormulaPart& part : parts) {
      const ExprVector values = evaluate(part.formulas, at);
      (part.is_component ? components : rates).segment(part.first, values.size()) += values;
    }
    return ExprVector(rates + base->frame(q) * components);
  });
}

}  // namespace

std::vector<DeclaredSymmetry> read_symmetries(const JsonReader& symmetries, const Model& model) {
  std::vector<DeclaredSymmetry> list;
  const auto entries = symmetries.entries();
  if (!entries) return list;
  const auto& manifold = model.system->manifold();
  const auto phase_space = std::dynamic_pointer_cast<const CotangentBundle>(manifold);
  const auto structure = model.system->structure();
  if (!phase_space || !structure || !structure->is_canonical()) {
    symmetries.problem("need a cotangent bundle with its canonical structure, but the system is " +
                       model.description + "; expected none");
    return list;
  }
  const ConfigurationWords words(model.vocabulary, *phase_space->base());
  const ImplicitSystem& system = *model.system;
  Graph graph;
  SymbolTable taken =
      model.symbols(graph.variables("x", manifold->ambient_dimension()),
                    graph.variables("v", manifold->tangent_dimension()),
                    graph.variables("z", system.auxiliary_size()), graph.variable("t"));
  for (const char* name : {"H", "constraint"})
    if (taken.find(name) == nullptr) taken.add(name, 0.0);
  for (const auto& [name, value] : *entries) {
    try {
      const Declaration declaration = parse_declaration(name, taken);
      if (!declaration.shape.empty())
        throw FormulaError(1, "\"" + name + "\" has a size; expected a name");
      taken.add(name, 0.0);
    } catch (const FormulaError& error) {
      value.problem(std::string("key, ") + error.what());
      continue;
    }
    if (auto symmetry = read_symmetry(value, words, phase_space))
      list.push_back({name, value.pointer(), std::move(*symmetry)});
  }
  return list;
}

}  // namespace courant
