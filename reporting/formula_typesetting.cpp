#include "courant/reporting/formula_typesetting.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "courant/core/language/formula_tree.hpp"

namespace courant {
namespace {

using plot::element;
using plot::Markup;

// The letter as MathML shows it and the command of LaTeX.
struct Letter {
  std::string_view name, character;
};
constexpr Letter greek[] = {
    {"alpha", "α"},      {"beta", "β"},   {"gamma", "γ"},  {"delta", "δ"}, {"epsilon", "ϵ"},
    {"varepsilon", "ε"}, {"zeta", "ζ"},   {"eta", "η"},    {"theta", "θ"}, {"iota", "ι"},
    {"kappa", "κ"},      {"lambda", "λ"}, {"mu", "μ"},     {"nu", "ν"},    {"xi", "ξ"},
    {"pi", "π"},         {"rho", "ρ"},    {"sigma", "σ"},  {"tau", "τ"},   {"upsilon", "υ"},
    {"phi", "φ"},        {"chi", "χ"},    {"psi", "ψ"},    {"omega", "ω"}, {"Gamma", "Γ"},
    {"Delta", "Δ"},      {"Theta", "Θ"},  {"Lambda", "Λ"}, {"Xi", "Ξ"},    {"Pi", "Π"},
    {"Sigma", "Σ"},      {"Phi", "Φ"},    {"Psi", "Ψ"},    {"Omega", "Ω"}};

const Letter* letter(std::string_view name) {
  const auto found = std::ranges::find(greek, name, &Letter::name);
  return found == std::end(greek) ? nullptr : &*found;
}

// A piece that is not ASCII: a Greek letter that was typed as such.
const Letter* typed_letter(std::string_view name) {
  const auto found = std::ranges::find(greek, name, &Letter::character);
  return found == std::end(greek) ? nullptr : &*found;
}

// A name in its parts: x_1' is x, below 1, one dot.
struct NameParts {
  std::string base;
  std::vector<std::string> below;
  int dots = 0;
  bool is_change = false;  // δx
};

NameParts parts_of(std::string name) {
  NameParts parts;
  while (name.ends_with('\'')) {
    name.pop_back();
    ++parts.dots;
  }
  constexpr std::string_view delta = "δ";
  if (name.starts_with(delta) && name.size() > delta.size() && name[delta.size()] != '_') {
    name.erase(0, delta.size());
    parts.is_change = true;
  }
  // theta1: what is a letter of the Greek alphabet, or one letter, and digits.
  std::size_t begin = 0;
  std::vector<std::string> pieces;
  while (begin <= name.size()) {
    const std::size_t end = std::min(name.find('_', begin), name.size());
    if (end > begin) pieces.push_back(name.substr(begin, end - begin));
    begin = end + 1;
  }
  if (pieces.empty()) pieces.push_back(name);
  parts.base = pieces.front();
  parts.below.assign(pieces.begin() + 1, pieces.end());
  const std::size_t letters = parts.base.find_last_not_of("0123456789") + 1;
  const std::string_view head = std::string_view(parts.base).substr(0, letters);
  if (letters > 0 && letters < parts.base.size() &&
      (letters == 1 || letter(head) || typed_letter(head))) {
    parts.below.insert(parts.below.begin(), parts.base.substr(letters));
    parts.base = parts.base.substr(0, letters);
  }
  return parts;
}

// How MathML writes what a formula is made of.
struct MathMl {
  using Piece = Markup;

  static Piece number(const std::string& text) { return element("mn", {}, text); }
  // One letter is italic by itself, a word upright.
  static Piece word(const std::string& text) {
    if (const Letter* found = letter(text)) return element("mi", {}, found->character);
    const bool digits =
        std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
    return element(digits ? "mn" : "mi", {}, text);
  }
  static Piece function(const std::string& name) {
    return element("mi", {}, name) + element("mo", {}, "\u2061");
  }
  static Piece sign(const std::string& text) {
    static const std::map<std::string, std::string> shown = {{"-", "−"},  {"*", "·"},  {"<=", "≤"},
                                                             {">=", "≥"}, {"==", "="}, {"!=", "≠"},
                                                             {"&&", "∧"}, {"||", "∨"}, {"!", "¬"}};
    const auto found = shown.find(text);
    return element("mo", {}, found == shown.end() ? text : found->second);
  }
  static Piece prefix(const std::string& text) { return sign(text); }
  // At the beginning of a line it stands between two terms still.
  static Piece infix(const std::string& text) {
    return element("mo", {{"form", "infix"}}, text == "-" ? "−" : text);
  }
  static Piece times() { return element("mo", {}, "\u2062"); }
  static Piece change() { return word("δ"); }
  static Piece space() { return element("mspace", {{"width", "0.17em"}}); }
  static Piece row(const Piece& inner) { return element("mrow", {}, inner); }
  static Piece fraction(const Piece& above, const Piece& below) {
    return element("mfrac", {}, row(above) + row(below));
  }
  static Piece power(const Piece& base, const Piece& exponent) {
    return element("msup", {}, row(base) + row(exponent));
  }
  static Piece below(const Piece& base, const Piece& index) {
    return element("msub", {}, row(base) + row(index));
  }
  static Piece dotted(const Piece& base, int dots) {
    static const std::array<std::string, 3> accents = {"˙", "¨", "⃛"};
    return element("mover", {{"accent", "true"}},
                   row(base) + element("mo", {}, accents[static_cast<std::size_t>(dots - 1)]));
  }
  static Piece root(const Piece& inner) { return element("msqrt", {}, inner); }
  static Piece fenced(std::string_view left, const Piece& inner, std::string_view right) {
    return row(element("mo", {}, left) + inner + element("mo", {}, right));
  }
  // Parentheses that are in two lines, both of one size.
  static Piece open() {
    return element("mo", {{"form", "prefix"}, {"minsize", "1.7em"}, {"maxsize", "1.7em"}}, "(");
  }
  static Piece close() {
    return element("mo", {{"form", "postfix"}, {"minsize", "1.7em"}, {"maxsize", "1.7em"}}, ")");
  }
  static Piece comma() { return element("mo", {}, ","); }
  static Piece matrix(const std::vector<std::vector<Piece>>& rows) {
    Piece all;
    for (const auto& entries : rows) {
      Piece cells;
      for (const Piece& entry : entries) cells += element("mtd", {}, entry);
      all += element("mtr", {}, cells);
    }
    return fenced("(", element("mtable", {}, all), ")");
  }
  static Piece summed(bool product, const Piece& index, const Piece& first, const Piece& last,
                      const Piece& term) {
    return row(element("munderover", {},
                       element("mo", {}, product ? "∏" : "∑") +
                           row(index + element("mo", {}, "=") + first) + row(last)) +
               row(term));
  }
  static Piece cases(const Piece& yes, const Piece& condition, const Piece& no) {
    const auto line = [](const Piece& value, const Piece& when) {
      return element("mtr", {}, element("mtd", {}, value) + element("mtd", {}, when));
    };
    return row(element("mo", {}, "{") + element("mtable", {},
                                                line(yes, element("mtext", {}, "if ") + condition) +
                                                    line(no, element("mtext", {}, "otherwise"))));
  }
};

// How LaTeX does.
struct Latex {
  using Piece = std::string;

  static Piece number(const std::string& text) { return text; }
  static Piece word(const std::string& text) {
    if (letter(text)) return "\\" + text;
    if (const Letter* found = typed_letter(text)) return "\\" + std::string(found->name);
    const bool digits =
        std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
    return text.size() == 1 || digits ? text : "\\mathrm{" + latex_text(text) + "}";
  }
  static Piece function(const std::string& name) {
    static constexpr std::string_view known[] = {"exp",  "log",  "sin",  "cos", "tan",
                                                 "sinh", "cosh", "tanh", "min", "max"};
    if (std::ranges::count(known, name) > 0) return "\\" + name;
    return "\\operatorname{" + latex_text(name) + "}";
  }
  static Piece sign(const std::string& text) {
    static const std::map<std::string, std::string> shown = {
        {"*", "\\cdot "}, {"<=", "\\le "},    {">=", "\\ge "},  {"==", "="},
        {"!=", "\\ne "},  {"&&", "\\wedge "}, {"||", "\\vee "}, {"!", "\\neg "}};
    const auto found = shown.find(text);
    return found == shown.end() ? " " + text + " " : " " + found->second;
  }
  static Piece prefix(const std::string& text) { return text == "!" ? "\\neg " : text; }
  static Piece infix(const std::string& text) { return "{} " + text + " "; }
  static Piece times() { return "\\,"; }
  static Piece change() { return "\\delta "; }
  static Piece space() { return " "; }
  static Piece row(const Piece& inner) { return inner; }
  static Piece fraction(const Piece& above, const Piece& below) {
    return "\\frac{" + above + "}{" + below + "}";
  }
  static Piece power(const Piece& base, const Piece& exponent) {
    return "{" + base + "}^{" + exponent + "}";
  }
  static Piece below(const Piece& base, const Piece& index) { return base + "_{" + index + "}"; }
  static Piece dotted(const Piece& base, int dots) {
    static const std::array<std::string, 3> accents = {"\\dot", "\\ddot", "\\dddot"};
    return accents[static_cast<std::size_t>(dots - 1)] + "{" + base + "}";
  }
  static Piece root(const Piece& inner) { return "\\sqrt{" + inner + "}"; }
  static Piece fenced(std::string_view left, const Piece& inner, std::string_view right) {
    return "\\left" + std::string(left) + " " + inner + "\\right" + std::string(right);
  }
  static Piece open() { return "\\bigl( "; }
  static Piece close() { return "\\bigr)"; }
  static Piece comma() { return ", "; }
  static Piece matrix(const std::vector<std::vector<Piece>>& rows) {
    Piece all;
    for (const auto& entries : rows) {
      for (std::size_t j = 0; j < entries.size(); ++j) all += (j == 0 ? "" : " & ") + entries[j];
      all += " \\\\ ";
    }
    return "\\begin{pmatrix} " + all + "\\end{pmatrix}";
  }
  static Piece summed(bool product, const Piece& index, const Piece& first, const Piece& last,
                      const Piece& term) {
    return std::string(product ? "\\prod" : "\\sum") + "_{" + index + "=" + first + "}^{" + last +
           "} " + term;
  }
  static Piece cases(const Piece& yes, const Piece& condition, const Piece& no) {
    return "\\begin{cases}" + yes + " & \\text{if } " + condition + " \\\\ " + no +
           " & \\text{otherwise}\\end{cases}";
  }
};

constexpr double kLettersOfLine = 58.0;  // letters

// 2.5e-06 is 2.5 · 10⁻⁶: a factor, "" where that is 1, and the exponent.
struct PowerOfTen {
  std::string factor, exponent;
};
std::optional<PowerOfTen> power_of_ten(const std::string& number) {
  const std::size_t e = number.find_first_of("eE");
  if (e == std::string::npos) return std::nullopt;
  const std::string_view written = std::string_view(number).substr(e + 1);
  const std::size_t digits = std::min(written.find_first_not_of("+-0"), written.size() - 1);
  const std::string factor = number.substr(0, e);
  return PowerOfTen{factor == "1" ? "" : factor,
                    (written.starts_with('-') ? "-" : "") + std::string(written.substr(digits))};
}

bool is_sum(const FormulaTree& tree) {
  return tree.kind == FormulaTree::Kind::operation && (tree.text == "+" || tree.text == "-");
}

// (a - b)/c as a/c - b/c.
FormulaTree divided(const FormulaTree& above, const FormulaTree& below) {
  const auto fraction = [&](const FormulaTree& one) {
    return FormulaTree{FormulaTree::Kind::operation, "/", {one, below}};
  };
  if (!is_sum(above)) return fraction(above);
  return {above.kind, above.text, {divided(above.operands[0], below), fraction(above.operands[1])}};
}

// How wide a formula is set, in letters.
double extent(const FormulaTree& tree) {
  using Kind = FormulaTree::Kind;
  const std::vector<FormulaTree>& of = tree.operands;
  double all = 0.0;
  switch (tree.kind) {
    case Kind::number:
      if (const auto power = power_of_ten(tree.text))
        return static_cast<double>(power->factor.size()) + 3.0 +
               0.7 * static_cast<double>(power->exponent.size());
      return static_cast<double>(tree.text.size());
    case Kind::name: {
      const NameParts parts = parts_of(tree.text);
      const auto letters = [](const std::string& word) {
        return letter(word) || typed_letter(word) ? 1.0 : static_cast<double>(word.size());
      };
      for (const std::string& word : parts.below) all += 0.7 * letters(word);
      return all + letters(parts.base);
    }
    case Kind::element:
      return extent(of[0]) + 0.7 * extent(of[1]);
    case Kind::call:
      for (const FormulaTree& argument : of) all += 1.0 + extent(argument);
      return all + static_cast<double>(tree.text.size());
    case Kind::sign:
      return 1.5 + extent(of[0]);
    case Kind::equation:
      return extent(of[0]) + 3.0 + extent(of[1]);
    case Kind::operation:
      if (tree.text == "/") return 0.5 + std::max(extent(of[0]), extent(of[1]));
      if (tree.text == "^")
        return extent(of[0]) + 0.7 * extent(of[1]) + (is_sum(of[0]) ? 2.0 : 0.0);
      if (tree.text != "*") return extent(of[0]) + 3.0 + extent(of[1]);
      for (const FormulaTree& factor : of) all += extent(factor) + (is_sum(factor) ? 2.0 : 0.0);
      return all;
  }
  return all;
}

// The shape of a formula, written by `Out`.
template <class Out>
class Typesetter {
 public:
  using Piece = typename Out::Piece;
  using Kind = FormulaTree::Kind;

  Piece set(const FormulaTree& tree) const {
    switch (tree.kind) {
      case Kind::number:
        return number(tree.text);
      case Kind::name:
        return name(parts_of(tree.text), {});
      case Kind::element:
        return element(tree);
      case Kind::call:
        return call(tree);
      case Kind::sign:
        return Out::prefix(tree.text) +
               (begins_with_sign(tree.operands[0])
                    ? Out::fenced("(", set(tree.operands[0]), ")")
                    : inside(tree.operands[0], tree.text == "!" ? kAtom : kProduct));
      case Kind::operation:
        return operation(tree);
      case Kind::equation:
        return set(tree.operands[0]) + Out::sign("=") + set(tree.operands[1]);
    }
    return {};
  }

  struct Part {
    Piece piece;
    double extent;
  };
  // Between which a line may end: of a - b = c + d these are a, -b = c, and +d.
  std::vector<Part> parts(const FormulaTree& tree) const {
    if (tree.kind != Kind::equation) return terms(tree);
    std::vector<Part> all = terms(tree.operands[0]);
    bool is_first = true;
    for (const Part& part : terms(tree.operands[1])) {
      if (!is_first) {
        all.push_back(part);
        continue;
      }
      all.back().piece = all.back().piece + Out::sign("=") + part.piece;
      all.back().extent += 3 + part.extent;
      is_first = false;
    }
    return all;
  }

 private:
  // Of a sum, or of one over something, where that is wider than a line.
  std::vector<Part> terms(const FormulaTree& tree) const {
    if (tree.kind == Kind::operation && tree.text == "/" && is_sum(tree.operands[0]) &&
        extent(tree) >= kLettersOfLine)
      return terms(divided(tree.operands[0], tree.operands[1]));
    if (auto opened = product_with_sum(tree)) return *std::move(opened);
    if (!is_sum(tree)) return {{set(tree), extent(tree)}};
    std::vector<Part> all = terms(tree.operands[0]);
    if (auto opened = product_with_sum(tree.operands[1])) {
      opened->front().piece = Out::infix(tree.text) + opened->front().piece;
      opened->front().extent += 3;
      all.insert(all.end(), opened->begin(), opened->end());
    } else {
      all.push_back({Out::infix(tree.text) + last_term(tree), 3 + extent(tree.operands[1])});
    }
    return all;
  }
  // P (a + b)/D that is wider than a line as P/D (a + b), where a line may end in the parentheses.
  std::optional<std::vector<Part>> product_with_sum(const FormulaTree& tree) const {
    if (extent(tree) < kLettersOfLine) return std::nullopt;
    if (tree.kind == Kind::sign && tree.text == "-") {
      auto opened = product_with_sum(tree.operands[0]);
      if (opened) opened->front().piece = Out::prefix("-") + opened->front().piece;
      return opened;
    }
    if (tree.kind != Kind::operation || (tree.text != "*" && tree.text != "/")) return std::nullopt;
    const bool is_over = tree.text == "/";
    std::vector<const FormulaTree*> factors;
    const FormulaTree* rest = is_over ? &tree.operands[0] : &tree;
    for (; rest->kind == Kind::operation && rest->text == "*"; rest = &rest->operands[0])
      factors.insert(factors.begin(), &rest->operands[1]);
    factors.insert(factors.begin(), rest);
    const FormulaTree* sum = nullptr;
    for (const FormulaTree* factor : factors)
      if (is_sum(*factor) && (!sum || extent(*factor) > extent(*sum))) sum = factor;
    if (!sum) return std::nullopt;
    std::optional<FormulaTree> before;
    for (const FormulaTree* factor : factors)
      if (factor != sum)
        before = before ? FormulaTree{Kind::operation, "*", {*before, *factor}} : *factor;
    if (is_over)
      before = FormulaTree{Kind::operation,
                           "/",
                           {before.value_or(FormulaTree{Kind::number, "1"}), tree.operands[1]}};
    std::vector<Part> all = terms(*sum);
    if (before) {
      all.insert(all.begin(),
                 {inside(*before, kProduct) +
                      (ends_with_argument(*before) ? Out::sign("*") : Out::times()) + Out::open(),
                  extent(*before) + 1});
      all.back().piece = all.back().piece + Out::close();
    }
    return all;
  }

  // How tightly a formula holds together as it is set: a fraction has its bar, a root its roof.
  enum Binding { kWeakest, kSum, kProduct, kPower, kAtom };

  static Binding binding(const FormulaTree& tree) {
    if (tree.kind == Kind::sign) return tree.text == "!" ? kPower : kSum;
    if (tree.kind == Kind::number) {
      const auto power = power_of_ten(tree.text);
      return !power ? kAtom : power->factor.empty() ? kPower : kProduct;
    }
    if (tree.kind == Kind::call && (tree.text == "sum" || tree.text == "prod" || tree.text == "if"))
      return kSum;
    if (tree.kind == Kind::equation) return kWeakest;
    if (tree.kind != Kind::operation) return kAtom;
    if (tree.text == "+" || tree.text == "-") return kSum;
    if (tree.text == "*" || tree.text == "/") return kProduct;
    return tree.text == "^" ? kPower : kWeakest;
  }

  Piece inside(const FormulaTree& tree, Binding least) const {
    return binding(tree) < least ? Out::fenced("(", set(tree), ")") : set(tree);
  }

  static Piece number(const std::string& text) {
    const auto power = power_of_ten(text);
    if (!power) return Out::number(text);
    const bool is_below_one = power->exponent.starts_with('-');
    const Piece digits = Out::number(power->exponent.substr(is_below_one ? 1 : 0));
    const Piece all =
        Out::power(Out::number("10"), is_below_one ? Out::prefix("-") + digits : digits);
    return power->factor.empty() ? all : Out::number(power->factor) + Out::sign("*") + all;
  }

  Piece name(NameParts parts, const std::vector<Piece>& indices) const {
    if (std::exchange(parts.is_change, false))
      return Out::change() + name(std::move(parts), indices);
    Piece base = Out::word(parts.base);
    if (parts.dots > 0 && parts.dots <= 3) base = Out::dotted(base, parts.dots);
    std::vector<Piece> below;
    for (const std::string& word : parts.below) below.push_back(subscript(word));
    below.insert(below.end(), indices.begin(), indices.end());
    if (below.empty()) return base;
    Piece all = below.front();
    for (std::size_t i = 1; i < below.size(); ++i) all = all + Out::comma() + below[i];
    return Out::below(base, all);
  }

  // x1 of p_x1 has a subscript of its own.
  static Piece subscript(const std::string& word) {
    const NameParts parts = parts_of(word);
    if (parts.below.size() != 1 || parts.is_change || parts.dots > 0) return Out::word(word);
    return Out::below(Out::word(parts.base), Out::word(parts.below[0]));
  }

  Piece element(const FormulaTree& tree) const {
    std::vector<Piece> indices;
    const FormulaTree* array = &tree;
    for (; array->kind == Kind::element; array = &array->operands[0])
      indices.insert(indices.begin(), set(array->operands[1]));
    if (array->kind == Kind::name) return name(parts_of(array->text), indices);
    Piece all = indices.front();
    for (std::size_t i = 1; i < indices.size(); ++i) all = all + Out::comma() + indices[i];
    return Out::below(Out::fenced("(", set(*array), ")"), all);
  }

  Piece call(const FormulaTree& tree) const {
    const std::string& function = tree.text;
    const std::vector<FormulaTree>& of = tree.operands;
    if (function == "sqrt" && of.size() == 1) return Out::root(set(of[0]));
    if (function == "abs" && of.size() == 1) return Out::fenced("|", set(of[0]), "|");
    if (function == "norm" && of.size() == 1) return Out::fenced("|", set(of[0]), "|");
    if (function == "pow" && of.size() == 2) return Out::power(inside(of[0], kAtom), set(of[1]));
    if (function == "dot" && of.size() == 2)
      return inside(of[0], kProduct) + Out::sign("*") + inside(of[1], kProduct);
    if ((function == "sum" || function == "prod") && of.size() == 4)
      return Out::summed(function == "prod", set(of[0]), set(of[1]), set(of[2]),
                         inside(of[3], kProduct));
    if (function == "if" && of.size() == 3) return Out::cases(set(of[1]), set(of[0]), set(of[2]));
    Piece arguments;
    for (std::size_t i = 0; i < of.size(); ++i)
      arguments = i == 0 ? set(of[i]) : arguments + Out::comma() + set(of[i]);
    // sin x, but sin (x + y).
    if (has_bare_argument(tree)) return Out::function(function) + Out::space() + arguments;
    return Out::function(function) + Out::fenced("(", arguments, ")");
  }

  Piece operation(const FormulaTree& tree) const {
    const FormulaTree &a = tree.operands[0], &b = tree.operands[1];
    // A sign stands before the line of a fraction, not above it.
    if (tree.text == "/" && begins_with_sign(tree))
      return Out::prefix("-") + Out::fraction(set(without_sign(a)), set(b));
    if (tree.text == "/") return Out::fraction(set(a), set(b));
    if (tree.text == "^") {
      // sin² x is ambiguous to some readers, (sin x)² to none.
      return Out::power(
          inside(a, a.kind == Kind::call && a.text != "sqrt" && a.text != "abs" ? kNever : kAtom),
          set(b));
    }
    if (tree.text == "*") {
      // cos f · v, where cos f v could be read as the cosine of a product.
      const bool has_digit = begins_with_digit(b) && binding(b) >= kProduct;
      const Piece between = begins_with_word(b)                  ? Out::space()
                            : has_digit || ends_with_argument(a) ? Out::sign("*")
                                                                 : Out::times();
      return (a.kind == Kind::sign ? set(a) : inside(a, kProduct)) + between + later(b, kProduct);
    }
    return inside(a, binding(tree)) + Out::sign(tree.text) + last_term(tree);
  }
  // A minus in the middle of a formula stands in parentheses; at the beginning it needs none.
  Piece later(const FormulaTree& operand, Binding least) const {
    return begins_with_sign(operand) || binding(operand) < least
               ? Out::fenced("(", set(operand), ")")
               : set(operand);
  }
  // b of a - b.
  Piece last_term(const FormulaTree& tree) const {
    const FormulaTree& b = tree.operands[1];
    const Binding own = binding(tree);
    return later(b, tree.text == "-" && binding(b) == own ? kProduct : own);
  }
  static constexpr Binding kNever = static_cast<Binding>(kAtom + 1);

  static bool begins_with_sign(const FormulaTree& tree) {
    const FormulaTree* first = &tree;
    bool is_above = false;  // a fraction line, where the sign of a sum stays
    while (first->kind == Kind::operation && first->text != "^") {
      if (is_above && first->text != "*" && first->text != "/") return false;
      is_above = is_above || first->text == "/";
      first = &first->operands[0];
    }
    return first->kind == Kind::sign && (!is_above || first->text == "-");
  }
  // Of a product or a quotient that begins with one.
  static FormulaTree without_sign(FormulaTree tree) {
    if (tree.kind == Kind::sign) return std::move(tree.operands[0]);
    tree.operands[0] = without_sign(std::move(tree.operands[0]));
    return tree;
  }
  // A function whose name is written out.
  static bool is_word(const FormulaTree& tree) {
    return tree.kind == Kind::call && tree.text != "sqrt" && tree.text != "abs" &&
           tree.text != "norm" && tree.text != "pow" && tree.text != "dot";
  }
  static bool begins_with_word(const FormulaTree& tree) {
    const FormulaTree* first = &tree;
    while (first->kind == Kind::operation && first->text == "*") first = &first->operands[0];
    return is_word(*first);
  }
  // sin x, without parentheses.
  static bool has_bare_argument(const FormulaTree& tree) {
    return is_word(tree) && tree.operands.size() == 1 && binding(tree.operands[0]) == kAtom &&
           tree.operands[0].kind != Kind::call;
  }
  static bool ends_with_argument(const FormulaTree& tree) {
    const FormulaTree* last = &tree;
    while (true) {
      if (last->kind == Kind::operation && last->text == "*")
        last = &last->operands[1];
      else if (last->kind == Kind::sign)
        last = &last->operands[0];
      else
        return has_bare_argument(*last);
    }
  }
  static bool begins_with_digit(const FormulaTree& tree) {
    const FormulaTree* first = &tree;
    while (first->kind == Kind::operation && first->text != "/") first = &first->operands[0];
    return first->kind == Kind::number;
  }
};

// An array of formulas in JSON as a row in parentheses or a matrix; nothing if it is none.
template <class Out>
std::optional<typename Out::Piece> set_array(const nlohmann::ordered_json& value) {
  using Piece = typename Out::Piece;
  const auto entry = [](const nlohmann::ordered_json& one) -> std::optional<Piece> {
    if (!one.is_string() && !one.is_number()) return std::nullopt;
    const auto tree = formula_tree(one.is_string() ? one.get<std::string>() : one.dump());
    return tree ? std::optional(Typesetter<Out>().set(*tree)) : std::nullopt;
  };
  if (!value.is_array() || value.empty()) return std::nullopt;
  std::vector<std::vector<Piece>> rows;
  const bool is_matrix = value.front().is_array();
  for (const nlohmann::ordered_json& row :
       is_matrix ? value : nlohmann::ordered_json::array({value})) {
    rows.emplace_back();
    if (!row.is_array() || row.size() != (is_matrix ? value.front().size() : value.size()))
      return std::nullopt;
    for (const nlohmann::ordered_json& one : row) {
      auto piece = entry(one);
      if (!piece) return std::nullopt;
      rows.back().push_back(std::move(*piece));
    }
  }
  if (is_matrix) return Out::matrix(rows);
  Piece all = rows[0][0];
  for (std::size_t i = 1; i < rows[0].size(); ++i) all = all + Out::comma() + rows[0][i];
  return Out::fenced("(", all, ")");
}

Markup set_text(std::string_view text, MathMl) { return element("mtext", {}, text); }
std::string set_text(std::string_view text, Latex) { return "\\text{" + latex_text(text) + "}"; }

// A formula, an equation, a name = an array; else a text.
template <class Out>
typename Out::Piece set_by(std::string_view formula) {
  if (const auto tree = formula_tree(formula)) return Typesetter<Out>().set(*tree);
  constexpr std::string_view equals = " = ";
  const std::size_t at = formula.find(equals);
  if (at == std::string_view::npos) return set_text(formula, Out());
  const auto name = formula_tree(formula.substr(0, at));
  const auto value =
      nlohmann::ordered_json::parse(formula.substr(at + equals.size()), nullptr, false);
  const auto entries = name ? set_array<Out>(value) : std::nullopt;
  if (!entries) return set_text(formula, Out());
  return Typesetter<Out>().set(*name) + Out::sign("=") + *entries;
}

}  // namespace

Markup math(std::string_view formula) {
  return element("math", {}, element("mrow", {}, set_by<MathMl>(formula)));
}

Markup displayed_math(std::string_view formula) {
  const auto line = [](const Markup& content) {
    return element("math", {{"displaystyle", "true"}}, element("mrow", {}, content));
  };
  const auto tree = formula_tree(formula);
  if (!tree || extent(*tree) < kLettersOfLine) return line(set_by<MathMl>(formula));
  Markup all;
  for (const auto& part : Typesetter<MathMl>().parts(*tree))
    all += (all.str().empty() ? "" : " ") + line(part.piece);
  return all;
}

std::string latex_math(std::string_view formula) { return set_by<Latex>(formula); }

std::string latex_displayed(std::string_view formula) {
  const auto tree = formula_tree(formula);
  if (!tree || extent(*tree) < kLettersOfLine) return latex_math(formula);
  std::string all;
  double filled = 0.0;
  for (const auto& [piece, letters] : Typesetter<Latex>().parts(*tree)) {
    const bool begins = all.empty() || filled + letters > kLettersOfLine;
    if (begins) all += all.empty() ? "& " : " \\\\\n& \\quad ";
    filled = begins ? letters : filled + letters;
    all += piece;
  }
  return "\\begin{aligned}\n" + all + "\n\\end{aligned}";
}

bool is_long_formula(std::string_view formula) {
  const auto tree = formula_tree(formula);
  return tree && extent(*tree) >= kLettersOfLine;
}

std::string latex_text(std::string_view text) {
  static const std::map<char, std::string_view> commands = {{'\\', "\\textbackslash{}"},
                                                            {'{', "\\{"},
                                                            {'}', "\\}"},
                                                            {'$', "\\$"},
                                                            {'&', "\\&"},
                                                            {'#', "\\#"},
                                                            {'%', "\\%"},
                                                            {'_', "\\_"},
                                                            {'^', "\\textasciicircum{}"},
                                                            {'~', "\\textasciitilde{}"}};
  std::string result;
  for (const char c : text) {
    const auto found = commands.find(c);
    if (found == commands.end())
      result += c;
    else
      result += found->second;
  }
  return result;
}

}  // namespace courant
