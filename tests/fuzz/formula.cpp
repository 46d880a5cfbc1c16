// Formulas: the parser answers any text with a number or with an error for users.
#include "courant/core/language/formula.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>

#include "courant/core/expressions/expr_vectors.hpp"
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

// Sums and products of a hundred thousand terms are allowed, and take seconds; tests/core holds their bounds.
// They are left out, and so are those of a thousand, which find nothing that short ones do not: of a formula with
// a sum or a product, all numbers together have four digits at most.
bool repeats_often(const std::string& text) {
  if (text.find("sum") == std::string::npos && text.find("prod") == std::string::npos) return false;
  return std::ranges::count_if(text, [](char letter) { return letter >= '0' && letter <= '9'; }) >
         4;
}

// Tells in the end how many texts the parser read: those that are left out do not count.
struct Count {
  long parsed = 0;
  ~Count() { std::cerr << "Formulas that were parsed: " << parsed << '\n'; }
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
  if (courant::fuzz::repeats_often(text)) return 0;
  static courant::fuzz::Count count;
  ++count.parsed;
  try {
    courant::parse_formula(text, courant::fuzz::symbols());
  } catch (const courant::FormulaError& error) {
    courant::fuzz::require_words_for_users(error.what(), text);
  }
  return 0;
}
