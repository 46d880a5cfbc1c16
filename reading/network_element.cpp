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

namespace domains {
const NetworkDomain electrical{"electrical", "i_", "v_", "potential_"};
const NetworkDomain translation{"translational", "F_", "v_", "velocity_"};
const NetworkDomain rotation{"rotational", "tau_", "omega_", "speed_"};
const NetworkDomain hydraulic{"hydraulic", "Q_", "P_", "pressure_"};
const NetworkDomain thermal{"thermal", "s_", "T_", "temperature_"};
}  // namespace domains

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

NetworkTerminal ElementReader::ground() const { return {"", element_.pointer}; }

NetworkTerminal ElementReader::node(const std::string& key) {
  const auto given = object_.optional(key);
  if (!given) return ground();
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
  return {ground(), ground()};
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

void ElementReader::branch(const NetworkDomain& domain, NetworkTerminal from, NetworkTerminal to,
                           Kind kind, Role role, OwnLaw law, const std::string& suffix) {
  Law whole = [law = std::move(law), first = element_.first](const NetworkVariables& variables) {
    return law(variables, *first);
  };
  element_.ports.push_back({.suffix = suffix,
                            .domain = &domain,
                            .from = std::move(from),
                            .to = std::move(to),
                            .kind = kind,
                            .role = role,
                            .law = std::move(whole)});
}

void ElementReader::formula_branch(const NetworkDomain& domain, NetworkTerminal from,
                                   NetworkTerminal to, Kind kind, Role role,
                                   const WrittenFormula& law, const std::string& suffix) {
  branch(domain, std::move(from), std::move(to), kind, role, value_of(law), suffix);
}

ElementReader::OwnLaw ElementReader::value_of(const WrittenFormula& formula) {
  element_.formulas.push_back(formula);
  return [formula, words = site_.words](const NetworkVariables& variables, Index) {
    return words->value(formula, variables);
  };
}

void ElementReader::storage(const NetworkDomain& domain, NetworkTerminal from, NetworkTerminal to,
                            Kind kind, const std::string& letters, const std::string& suffix) {
  element_.ports.push_back({.suffix = suffix,
                            .domain = &domain,
                            .from = std::move(from),
                            .to = std::move(to),
                            .kind = kind,
                            .role = Role::storage,
                            .state = letters});
}

void ElementReader::implicit_storage(const NetworkDomain& domain, NetworkTerminal from,
                                     NetworkTerminal to, const std::string& letters,
                                     const std::string& suffix, ChargeLaw voltage, OwnLaw energy) {
  const std::string state = letters + element_.name;
  storage(domain, std::move(from), std::move(to), Kind::charge, letters, suffix);
  NetworkElement::Port& port = element_.ports.back();
  port.law = [voltage = std::move(voltage), state, words = site_.words,
              first = element_.first](const NetworkVariables& variables) {
    const Index place = words->vocabulary.coordinates.find({.name = state, .indices = {}}).first;
    return voltage(variables, *first, variables.x()[place]);
  };
  port.energy = [energy = std::move(energy), first = element_.first](
                    const NetworkVariables& variables) { return energy(variables, *first); };
}

void ElementReader::port(const NetworkDomain& domain, NetworkTerminal from, NetworkTerminal to,
                         Kind kind) {
  element_.ports.push_back({.suffix = "",
                            .domain = &domain,
                            .from = std::move(from),
                            .to = std::move(to),
                            .kind = kind,
                            .role = Role::port});
}

void ElementReader::energy(const WrittenFormula& formula) {
  element_.energy_formulas.push_back(formula);
  element_.energy = [formula, words = site_.words](const ExprVector&, const ExprVector& x,
                                                   const Expr& t) {
    return words->value(formula, x, t);
  };
}

void ElementReader::quadratic_energy(double value) {
  element_.energy = [value](const ExprVector& own, const ExprVector&, const Expr&) {
    return square(own[0]) / (2.0 * value);
  };
}

void ElementReader::law_of_state(const WrittenFormula& formula) {
  element_.energy_formulas.push_back(formula);
  const auto words = site_.words;
  const std::string state = element_.ports.back().state + element_.name;
  element_.ports.back().law = [formula, words](const NetworkVariables& variables) {
    return words->value(formula, variables.x(), variables.t());
  };
  element_.energy = [formula, words, state](const ExprVector& own, const ExprVector& x,
                                            const Expr& t) {
    static const GaussRule rule;
    const Index place = words->vocabulary.coordinates.find({.name = state, .indices = {}}).first;
    Expr sum = 0.0;
    ExprVector at = x;
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      at[place] = rule.node[k] * own[0];
      sum += rule.weight[k] * words->value(formula, at, t);
    }
    return own[0] * sum;
  };
}

std::optional<NetworkElement> ElementReader::result() {
  if (!right_) return std::nullopt;
  return element_;
}

}  // namespace courant
