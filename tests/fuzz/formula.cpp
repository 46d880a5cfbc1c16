// Formulas: the parser answers any text with a number or with an error for users.
#include "courant/core/formula.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "courant/core/expr_vectors.hpp"
#include "long_number.hpp"
#include "words.hpp"

namespace courant::fuzz {

namespace {

// Names such as experiments have, in a graph of their own.
struct Names {
  Graph graph;
  SymbolTable symbols;

  Names() {
    for (const char* name : {"x", "y", "p_x", "t"}) symbols.add(name, graph.variable(name));
    symbols.add_velocity("x", graph.variable("x'"));
    symbols.add("q", {3}, graph.variables("q", 3));
    symbols.add("R", {2, 3}, graph.variables("R", 6));
    symbols.add("m", Expr(2.5));
    symbols.add("n", Expr(4.0));
  }
};

// The graph grows with every formula, so it is made anew from time to time; answers do not depend
// on it.
const SymbolTable& symbols() {
  static std::optional<Names> names;
  static int age = 0;
  if (age++ % 1000 == 0) names.emplace();
  return names->symbols;
}

}  // namespace

}  // namespace courant::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (courant::fuzz::has_long_number(text)) return 0;
  try {
    courant::parse_formula(text, courant::fuzz::symbols());
  } catch (const courant::FormulaError& error) {
    courant::fuzz::require_words_for_users(error.what(), text);
  }
  return 0;
}
