#include "courant/reading/network_element.hpp"

#include <array>
#include <cmath>

#include "courant/core/language/declaration.hpp"
#include "courant/core/language/formula.hpp"

namespace courant {
namespace {

// Nodes and weights of the Gauss rule of 16 points on [0, 1]: exact for polynomials of degree 31.
// By Newton's method on the Legendre polynomial.
struct GaussRule {
  static constexpr int n = 16;
  std::array<double, n> node{}, weight{};
  GaussRule() {
    for (int i = 0; i < n; ++i) {
      double x = std::cos(std::acos(-1.0) * (i + 0.75) / (n + 0.5)), slope = 0.0;
      for (int iteration = 0; iteration < 100; ++iteration) {
        double p0 = 1.0, p1 = x;
        for (int k = 2; k <= n; ++k) {
          const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
          p0 = p1;
          p1 = p2;
        }
        slope = n * (x * p1 - p0) / (x * x - 1.0);
        const double step = p1 / slope;
        x -= step;
        if (std::abs(step) < 1e-16) break;
      }
      node[static_cast<std::size_t>(i)] = 0.5 * (1.0 + x);
      weight[static_cast<std::size_t>(i)] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
  }
};

}  // namespace

// With what the formula names alone: a table of everything for every element of a large network
// would take long.
Expr NetworkWords::value(const WrittenFormula& formula, const NetworkVariables& variables) const {
  const auto names = names_used(formula.text);
  SymbolTable symbols = vocabulary.symbols_of(names, variables.x(), variables.t());
  for (const std::string& name : names) {
    if (symbols.find(name)) continue;
    if (const auto current = currents.find(name); current != currents.end())
      symbols.add(name, variables.current(current->second));
    else if (const auto voltage = voltages.find(name); voltage != voltages.end())
      symbols.add(name, variables.voltage(voltage->second));
  }
  return evaluate(formula, symbols);
}

Expr NetworkWords::value(const WrittenFormula& formula, const ExprVector& x, const Expr& t) const {
  return evaluate(formula, vocabulary.symbols_of(names_used(formula.text), x, t));
}

ElementReader::ElementReader(ObjectReader& object, const NetworkSite& site)
    : object_(object), site_(site) {
  element_.pointer = object.place().pointer();
  object.optional("repeat");  // whose turns are read one by one
  const auto name = object.required("name");
  const auto text = name ? name->text() : std::nullopt;
  right_ = text.has_value();
  if (!text) return;
  element_.name = *text;
  try {
    if (parse_declaration("v_" + *text).shape.empty()) return;
    name->problem("has a size; expected a name");
  } catch (const FormulaError&) {
    name->problem("is \"" + *text +
                  "\"; expected letters, digits and _, as names in formulas have");
  }
  right_ = false;
}

NetworkTerminal NetworkElement::terminal(Index number) const {
  if (number == elements::Element::ground) return {"", pointer};
  return terminals[static_cast<std::size_t>(number)];
}

NetworkTerminal ElementReader::node(const std::string& key) {
  const auto given = object_.optional(key);
  if (!given) return {"", element_.pointer};
  const auto name = given->text();
  if (!name) right_ = false;
  return {name.value_or(""), given->pointer()};
}

std::pair<NetworkTerminal, NetworkTerminal> ElementReader::pair(const std::string& key) {
  const auto given = object_.optional(key);
  const auto nodes = given ? given->elements() : std::nullopt;
  if (nodes && nodes->size() == 2) {
    const auto from = (*nodes)[0].text(), to = (*nodes)[1].text();
    if (from && to) return {{*from, (*nodes)[0].pointer()}, {*to, (*nodes)[1].pointer()}};
  } else if (nodes) {
    given->problem("has " + std::to_string(nodes->size()) +
                   (nodes->size() == 1 ? " entry" : " entries") + "; expected two names");
  }
  right_ = false;
  return {{"", element_.pointer}, {"", element_.pointer}};
}

bool ElementReader::has(const std::string& key) const {
  return object_.place().value().contains(key);
}

std::string ElementReader::one_of(const std::vector<std::string>& keys) {
  std::vector<std::string> given;
  std::string list;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (has(keys[i])) given.push_back(keys[i]);
    list += (i == 0 ? "" : i + 1 == keys.size() ? " or " : ", ") + ("\"" + keys[i] + "\"");
  }
  if (given.size() == 1) return given[0];
  object_.place().problem(given.empty() ? "has no law; expected " + list
                                        : "has " + std::to_string(given.size()) +
                                              " laws; expected only one of " + list);
  for (const std::string& key : keys) object_.optional(key);
  right_ = false;
  return keys[0];
}

double ElementReader::constant(const std::string& key) {
  std::optional<WrittenFormula> written;
  if (const auto given = object_.optional(key)) {
    written = read_formula(*given);
  } else if (!has(key)) {
    if (object_.is_required(key)) right_ = false;
    if (!right_) return 1.0;  // what is missing is said already
    const Json& otherwise = object_.declared_default(key);
    object_.default_value(key, otherwise);
    return otherwise.get<double>();
  }
  if (written)
    if (const auto value = evaluate_constants({{1}, {*written}}, site_.vocabulary.symbols({}),
                                              object_.place().findings()))
      return (*value)[0];
  right_ = false;
  return 1.0;
}

double ElementReader::positive(const std::string& key) {
  const double value = constant(key);
  if (value > 0.0 && std::isfinite(value)) return value;
  if (const auto given = object_.optional(key)) given->expected("a number greater than 0");
  right_ = false;
  return 1.0;
}

double ElementReader::nonzero(const std::string& key) {
  const double value = constant(key);
  if (value != 0.0 && std::isfinite(value)) return value;
  if (const auto given = object_.optional(key)) given->expected("a number other than 0");
  right_ = false;
  return 1.0;
}

std::string ElementReader::word(const std::string& key) { return object_.word(key); }

std::optional<WrittenFormula> ElementReader::formula(const std::string& key) {
  const auto given = object_.optional(key);
  auto formula = given ? read_formula(*given) : std::nullopt;
  if (!formula && (given || object_.is_required(key))) right_ = false;
  return formula;
}

elements::Law ElementReader::law_of(const WrittenFormula& formula) {
  element_.formulas.push_back(formula);
  return [formula, words = site_.words](const elements::Variables& own) {
    return words->value(formula, own.network());
  };
}

elements::Law ElementReader::law(const std::string& key) {
  if (const auto written = formula(key)) return law_of(*written);
  right_ = false;
  return elements::constant(1.0);
}

elements::StateLaw ElementReader::state_law(const std::string& key) {
  const auto written = formula(key);
  if (!written) {
    right_ = false;
    return {};
  }
  element_.energy_formulas.push_back(*written);
  return [formula = *written, words = site_.words](const ExprVector&, const ExprVector& x,
                                                   const Expr& t) {
    return words->value(formula, x, t);
  };
}

void ElementReader::take_law_of_state(elements::Element& element, const std::string& key) {
  const elements::StateLaw law = state_law(key);
  element.branches[0].law = [law](const elements::Variables& own) {
    return law({}, own.network().x(), own.t());
  };
  element.energy = [law, words = site_.words, state = element.branches[0].letters + name()](
                       const ExprVector& own, const ExprVector& x, const Expr& t) {
    static const GaussRule rule;
    const Index place = words->vocabulary.coordinates.find({.name = state, .indices = {}}).first;
    Expr sum = 0.0;
    ExprVector at = x;
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      at[place] = rule.node[k] * own[0];
      sum += rule.weight[k] * law({}, at, t);
    }
    return own[0] * sum;
  };
}

std::optional<NetworkElement> ElementReader::result(elements::Element element,
                                                    const std::vector<std::string>& keys) {
  std::vector<NetworkTerminal> terminals;
  for (const std::string& key : keys) terminals.push_back(node(key));
  return result(std::move(element), std::move(terminals));
}

std::optional<NetworkElement> ElementReader::result(elements::Element element,
                                                    std::vector<NetworkTerminal> terminals) {
  if (!right_) return std::nullopt;
  element_.element = std::move(element);
  element_.terminals = std::move(terminals);
  return element_;
}

std::optional<NetworkElement> ElementReader::result(NetworkElement::Mutual mutual) {
  if (!right_) return std::nullopt;
  element_.mutual = std::move(mutual);
  return element_;
}

}  // namespace courant
