#include "courant/reporting/formula_typesetting.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
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
    {"alpha", "α"},  {"beta", "β"},   {"gamma", "γ"}, {"delta", "δ"},   {"epsilon", "ϵ"},
    {"zeta", "ζ"},   {"eta", "η"},    {"theta", "θ"}, {"iota", "ι"},    {"kappa", "κ"},
    {"lambda", "λ"}, {"mu", "μ"},     {"nu", "ν"},    {"xi", "ξ"},      {"pi", "π"},
    {"rho", "ρ"},    {"sigma", "σ"},  {"tau", "τ"},   {"upsilon", "υ"}, {"phi", "φ"},
    {"chi", "χ"},    {"psi", "ψ"},    {"omega", "ω"}, {"Gamma", "Γ"},   {"Delta", "Δ"},
    {"Theta", "Θ"},  {"Lambda", "Λ"}, {"Xi", "Ξ"},    {"Pi", "Π"},      {"Sigma", "Σ"},
    {"Phi", "Φ"},    {"Psi", "Ψ"},    {"Omega", "Ω"}};

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
};

NameParts parts_of(std::string name) {
  NameParts parts;
  while (name.ends_with('\'')) {
    name.pop_back();
    ++parts.dots;
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
  static Piece thin_space() { return element("mo", {}, "\u2062"); }
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
  static Piece comma() { return element("mo", {}, ","); }
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

  static Piece number(const std::string& text) {
    const std::size_t e = text.find_first_of("eE");
    if (e == std::string::npos) return text;
    std::string exponent = text.substr(e + 1);
    if (exponent.starts_with('+')) exponent.erase(0, 1);
    return text.substr(0, e) + "\\cdot 10^{" + exponent + "}";
  }
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
  static Piece thin_space() { return "\\,"; }
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
  static Piece comma() { return ", "; }
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

// The shape of a formula, written by `Out`.
template <class Out>
class Typesetter {
 public:
  using Piece = typename Out::Piece;
  using Kind = FormulaTree::Kind;

  Piece set(const FormulaTree& tree) const {
    switch (tree.kind) {
      case Kind::number:
        return Out::number(tree.text);
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

 private:
  // How tightly a formula holds together as it is set: a fraction has its bar, a root its roof.
  enum Binding { kWeakest, kSum, kProduct, kPower, kAtom };

  static Binding binding(const FormulaTree& tree) {
    if (tree.kind == Kind::sign) return tree.text == "!" ? kPower : kSum;
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

  Piece name(const NameParts& parts, const std::vector<Piece>& indices) const {
    Piece base = Out::word(parts.base);
    if (parts.dots > 0 && parts.dots <= 3) base = Out::dotted(base, parts.dots);
    std::vector<Piece> below;
    for (const std::string& word : parts.below) below.push_back(Out::word(word));
    below.insert(below.end(), indices.begin(), indices.end());
    if (below.empty()) return base;
    Piece all = below.front();
    for (std::size_t i = 1; i < below.size(); ++i) all = all + Out::comma() + below[i];
    return Out::below(base, all);
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
    if (of.size() == 1 && binding(of[0]) == kAtom && of[0].kind != Kind::call)
      return Out::function(function) + Out::thin_space() + arguments;
    return Out::function(function) + Out::fenced("(", arguments, ")");
  }

  Piece operation(const FormulaTree& tree) const {
    const FormulaTree &a = tree.operands[0], &b = tree.operands[1];
    if (tree.text == "/") return Out::fraction(set(a), set(b));
    if (tree.text == "^") {
      // sin² x is ambiguous to some readers, (sin x)² to none.
      return Out::power(
          inside(a, a.kind == Kind::call && a.text != "sqrt" && a.text != "abs" ? kNever : kAtom),
          set(b));
    }
    // A minus in the middle of a formula stands in parentheses; at the beginning it needs none.
    const auto later = [this](const FormulaTree& operand, Binding least) {
      return begins_with_sign(operand) || binding(operand) < least
                 ? Out::fenced("(", set(operand), ")")
                 : set(operand);
    };
    if (tree.text == "*")
      return (a.kind == Kind::sign ? set(a) : inside(a, kProduct)) +
             (begins_with_digit(b) ? Out::sign("*") : Out::thin_space()) + later(b, kProduct);
    const Binding own = binding(tree);
    const bool ends = tree.text == "-" && binding(b) == own;
    return inside(a, own) + Out::sign(tree.text) + later(b, ends ? kProduct : own);
  }
  static constexpr Binding kNever = static_cast<Binding>(kAtom + 1);

  static bool begins_with_sign(const FormulaTree& tree) {
    const FormulaTree* first = &tree;
    while (first->kind == Kind::operation && first->text != "/" && first->text != "^")
      first = &first->operands[0];
    return first->kind == Kind::sign;
  }
  static bool begins_with_digit(const FormulaTree& tree) {
    const FormulaTree* first = &tree;
    while (first->kind == Kind::operation && first->text != "/") first = &first->operands[0];
    return first->kind == Kind::number;
  }
};

}  // namespace

Markup math(std::string_view formula, bool displayed) {
  const auto tree = formula_tree(formula);
  const Markup content = tree ? Typesetter<MathMl>().set(*tree) : element("mtext", {}, formula);
  const Markup row = element("mrow", {}, content);
  return displayed ? element("math", {{"display", "block"}}, row) : element("math", {}, row);
}

std::string latex_math(std::string_view formula) {
  const auto tree = formula_tree(formula);
  return tree ? Typesetter<Latex>().set(*tree) : "\\text{" + latex_text(formula) + "}";
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
