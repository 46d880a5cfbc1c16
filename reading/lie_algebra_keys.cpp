#include "courant/reading/lie_algebra_keys.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/language/declaration.hpp"
#include "courant/core/words/message.hpp"
#include "courant/manifolds/matrix_algebra.hpp"
#include "courant/reading/vocabulary.hpp"
#include "courant/reading/written_formula.hpp"

namespace courant {

namespace {

// The algebras with a name, each with the size that it takes or without one.
struct NamedAlgebra {
  const char* word;
  bool is_sized;
  LieAlgebra (*make)(Index n);
};
constexpr NamedAlgebra kNamed[] = {
    {"so3", false, [](Index) { return LieAlgebra::so3(); }},
    {"se3", false, [](Index) { return LieAlgebra::se3(); }},
    {"so", true, [](Index n) { return LieAlgebra::so(n); }},
    {"abelian", true, [](Index n) { return LieAlgebra::abelian(n); }},
    {"se2", false, [](Index) { return LieAlgebra(MatrixAlgebra::se2()); }},
    {"su2", false, [](Index) { return LieAlgebra(MatrixAlgebra::su2()); }},
    {"sl", true, [](Index n) { return LieAlgebra(MatrixAlgebra::sl(n)); }},
    {"gl", true, [](Index n) { return LieAlgebra(MatrixAlgebra::gl(n)); }},
    {"sp", true, [](Index n) { return LieAlgebra(MatrixAlgebra::sp(n)); }},
    {"heisenberg", true, [](Index n) { return LieAlgebra(MatrixAlgebra::heisenberg(n)); }},
    {"galilei", false, [](Index) { return LieAlgebra(MatrixAlgebra::galilei()); }}};

std::vector<std::string> algebra_words() {
  std::vector<std::string> words;
  for (const NamedAlgebra& named : kNamed) words.push_back(named.word);
  return words;
}

std::optional<LieAlgebra> named_algebra(const JsonReader& word_key,
                                        const std::optional<JsonReader>& n_key) {
  const auto word = word_key.word(algebra_words());
  if (!word) return std::nullopt;
  const NamedAlgebra& named =
      *std::ranges::find_if(kNamed, [&](const NamedAlgebra& one) { return one.word == *word; });
  if (named.is_sized != n_key.has_value()) {
    word_key.problem(named.is_sized ? "needs its size; expected \"n\" beside it"
                                    : "has a size of its own; expected no \"n\" beside it");
    return std::nullopt;
  }
  const auto n = named.is_sized ? n_key->integer(0) : std::optional<Index>(0);
  if (!n) return std::nullopt;
  return named.make(*n);
}

// The names of the e_i, which formulas of brackets are made of.
std::optional<NameList> basis_names(const JsonReader& key) {
  SymbolTable taken;
  NameList names;
  if (!read_names(key, taken, names)) return std::nullopt;
  for (const Declaration& declaration : names.declarations())
    if (!declaration.shape.empty()) {
      key.problem("has an array, \"" + declaration.name + "\"; expected one name for each e_i");
      return std::nullopt;
    }
  return names;
}

// The places of the two names of "H, E" in the basis.
std::optional<std::pair<Index, Index>> bracket_pair(const std::string& text, const NameList& basis,
                                                    const JsonReader& place) {
  const auto comma = text.find(',');
  const auto index_of = [&](std::string name) -> Index {
    std::erase(name, ' ');
    const auto names = basis.element_names();
    return std::ranges::find(names, name) - names.begin();
  };
  if (comma != std::string::npos) {
    const Index i = index_of(text.substr(0, comma)), j = index_of(text.substr(comma + 1));
    if (i < basis.size() && j < basis.size() && i != j) return std::pair(i, j);
  }
  place.problem(
      "is the bracket of no pair; expected two different names of \"basis\" with a comma "
      "between them");
  return std::nullopt;
}

// constants[k](i, j) of {"H,E": "2*E", …}; brackets that are not given are zero.
std::optional<std::vector<MatrixXd>> constants_of_brackets(const JsonReader& key,
                                                           const NameList& basis) {
  const auto entries = key.entries();
  if (!entries) return std::nullopt;
  const Index n = basis.size();
  std::vector<MatrixXd> constants(static_cast<std::size_t>(n), MatrixXd::Zero(n, n));
  MatrixXd is_given = MatrixXd::Zero(n, n);
  bool right = true;
  for (const auto& [pair, value] : *entries) {
    const auto at = bracket_pair(pair, basis, value);
    const auto formula = read_formula(value);
    if (!at || !formula) {
      right = false;
      continue;
    }
    const auto [i, j] = *at;
    if (is_given(i, j) != 0.0) {
      value.problem("is given twice, in one order or the other; expected each bracket once");
      right = false;
      continue;
    }
    is_given(i, j) = is_given(j, i) = 1.0;
    Graph graph;
    const ExprVector e = graph.variables("e", n);
    SymbolTable symbols;
    basis.add_to(symbols, e);
    if (!check(*formula, symbols, key.findings())) {
      right = false;
      continue;
    }
    const ExprVector bracket = ExprVector::Constant(1, evaluate(*formula, symbols));
    if (!is_affine(bracket, e) || values(substitute(bracket, e, ExprVector::Zero(n)))[0] != 0.0) {
      value.problem("is not linear in the basis; expected a formula such as \"2*e1 - e2\"");
      right = false;
      continue;
    }
    for (Index k = 0; k < n; ++k) {
      const double c = values(substitute(bracket, e, ExprVector::Unit(n, k)))[0];
      constants[static_cast<std::size_t>(k)](i, j) = c;
      constants[static_cast<std::size_t>(k)](j, i) = -c;
    }
  }
  if (!right) return std::nullopt;
  return constants;
}

}  // namespace

std::vector<Key> lie_algebra_keys() {
  return {optional_key("algebra", takes::word(algebra_words()), "one with a name"),
          optional_key("n", takes::integer(0),
                       "of so(n), Rⁿ, sl(n), gl(n), sp(2n) and Heisenberg's of dimension 2n + 1"),
          optional_key("constants", takes::number_matrices(),
                       "constants[k][i][j]: the part of [e_i, e_j] along e_k"),
          optional_key("brackets", takes::brackets(),
                       "by pairs of names of the basis, {\"H,E\": \"2*E\"}; those not given are 0"),
          optional_key("basis", takes::names(), "the names of the e_i in brackets"),
          optional_key("matrices", takes::number_matrices(),
                       "a basis of an algebra of matrices, with the commutator")};
}

const std::vector<std::string>& lie_algebra_choice() {
  static const std::vector<std::string> keys = {"algebra", "constants", "brackets", "matrices"};
  return keys;
}

std::optional<std::vector<MatrixXd>> read_matrices(const JsonReader& value) {
  const auto elements = value.elements();
  if (!elements) return std::nullopt;
  std::vector<MatrixXd> result;
  for (const JsonReader& element : *elements) {
    const auto rows = element.elements();
    if (!rows) return std::nullopt;
    const auto n = static_cast<Index>(rows->size());
    MatrixXd A(n, n);
    for (Index i = 0; i < n; ++i) {
      const auto entries = (*rows)[static_cast<std::size_t>(i)].elements();
      if (!entries) return std::nullopt;
      if (static_cast<Index>(entries->size()) != n) {
        element.expected("a square matrix of numbers");
        return std::nullopt;
      }
      for (Index j = 0; j < n; ++j) {
        const auto entry = (*entries)[static_cast<std::size_t>(j)].number();
        if (!entry) return std::nullopt;
        A(i, j) = *entry;
      }
    }
    result.push_back(std::move(A));
  }
  return result;
}

std::optional<LieAlgebra> read_lie_algebra(ObjectReader& object) {
  const auto n_key = object.optional("n"), basis_key = object.optional("basis");
  std::vector<std::pair<std::string, JsonReader>> given;
  for (const std::string& key : lie_algebra_choice())
    if (const auto value = object.optional(key)) given.emplace_back(key, *value);
  if (given.size() != 1) {
    object.place().problem(
        "has " + std::string(given.empty() ? "no Lie algebra" : "several Lie algebras") +
        "; expected one of \"algebra\", \"constants\", \"brackets\" and \"matrices\"");
    return std::nullopt;
  }
  const auto& [key, place] = given.front();
  if ((key == "brackets") != basis_key.has_value()) {
    place.problem(basis_key ? "stands beside \"basis\"; expected it beside \"brackets\" alone"
                            : "need names; expected \"basis\", the names of the e_i, beside them");
    return std::nullopt;
  }
  try {
    if (key == "algebra") return named_algebra(place, n_key);
    if (n_key) {
      n_key->problem("is for algebras with a name; expected it beside \"algebra\" alone");
      return std::nullopt;
    }
    if (key == "brackets") {
      const auto basis = basis_names(*basis_key);
      const auto constants = basis ? constants_of_brackets(place, *basis) : std::nullopt;
      if (!constants) return std::nullopt;
      return LieAlgebra("g", *constants, basis->element_names());
    }
    const auto matrices = read_matrices(place);
    if (!matrices) return std::nullopt;
    if (key == "matrices") return LieAlgebra(MatrixAlgebra("g", *matrices));
    return LieAlgebra("g", *matrices);
  } catch (const std::exception& error) {
    place.problem(without_place(error.what()));
    return std::nullopt;
  }
}

std::optional<LieAlgebra> semidirect(const LieAlgebra& g, const std::vector<MatrixXd>& rho,
                                     const JsonReader& place) {
  try {
    return LieAlgebra::semidirect(g, rho);
  } catch (const std::exception& error) {
    place.problem(without_place(error.what()));
    return std::nullopt;
  }
}

}  // namespace courant
