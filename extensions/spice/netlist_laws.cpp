// Sources and switches by formulas.
#include <cctype>
#include <sstream>
#include <string_view>

#include "courant/core/expressions/function.hpp"
#include "courant/core/language/formula.hpp"
#include "courant/extensions/spice/netlist_behaviour.hpp"
#include "courant/extensions/spice/netlist_circuit_reader.hpp"

namespace courant::netlist {

std::string CircuitReader::expression_after(const Line& line, const std::string& key) {
  std::string lowered = line.text;
  for (char& c : lowered) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (std::size_t at = lowered.find(key); at != std::string::npos;
       at = lowered.find(key, at + 1)) {
    const char before = at == 0 ? ' ' : lowered[at - 1];
    std::size_t next = lowered.find_first_not_of(" \t", at + key.size());
    if (next == std::string::npos || std::isspace(static_cast<unsigned char>(before)) == 0)
      continue;
    if (lowered[next] == '=')
      next = lowered.find_first_not_of(" \t", next + 1);
    else if (key != "value" || lowered[next] != '{')
      continue;
    if (next == std::string::npos) break;
    const char opening = lowered[next];
    if (opening == '{' || opening == '\'') {
      const std::size_t end = lowered.find(opening == '{' ? '}' : '\'', next + 1);
      return line.text.substr(next + 1,
                              (end == std::string::npos ? line.text.size() : end) - next - 1);
    }
    return line.text.substr(next);
  }
  throw LineError{line.number, "has no " + key + "=…; expected one"};
}

std::string CircuitReader::table_after(const Line& line) {
  const std::size_t open = line.text.find('{'), close = line.text.find('}');
  if (open == std::string::npos || close == std::string::npos)
    throw LineError{line.number, "has no {expression} behind TABLE; expected one"};
  std::string rest = line.text.substr(close + 1);
  for (char& c : rest)
    if (std::string_view("=(),").find(c) != std::string_view::npos) c = ' ';
  std::istringstream words(rest);
  std::string text = "table(" + line.text.substr(open + 1, close - open - 1);
  for (std::string word; words >> word;) text += ", " + word;
  return text + ")";
}

std::string CircuitReader::behaviour_of(const std::string& expression, const Scope& scope,
                                        const std::string& prefix, const NodeMap& map, int line) {
  const BehaviourWords words{
      [&](const std::string& name) {
        const std::size_t place = node(name, prefix, map, line);
        return place == 0 ? std::string("0") : "potential_" + circuit_.name_of(place);
      },
      [&](const std::string& name) {
        return "i_" + names_.at(reference(name, 'v', prefix, line)).name;
      },
      [&](const std::string& of) { return derivative_of(of, prefix, line); }};
  return behaviour(expression, scope, line, words);
}

std::string CircuitReader::derivative_of(const std::string& formula, const std::string& prefix,
                                         int line) {
  const std::string name =
      names_of_elements_.of(prefix + "ddt_" + std::to_string(circuit_.elements.size()));
  const std::size_t at = own_node(name, line);
  Json source = {{"type", "voltage-source"},
                 {"name", name},
                 {"from", circuit_.nodes[at]},
                 {"to", circuit_.nodes[0]}};
  StaticElement fixed{.kind = StaticElement::Kind::voltage, .from = at};
  law_of(source, fixed, formula, prefix, line);
  names_.insert_or_assign(" " + name, Named{name, line, put(source, fixed, line)});
  circuit_.storages.push_back(
      {"C_" + name, "q_C_" + name, "1", circuit_.fixed.elements.size(), true, std::nullopt, line});
  put({{"type", "capacitor"},
       {"name", "C_" + name},
       {"from", circuit_.nodes[at]},
       {"to", circuit_.nodes[0]},
       {"value", 1.0}},
      {.kind = StaticElement::Kind::capacitor, .from = at, .value = 1.0}, line);
  return "(-i_" + name + ")";
}

bool CircuitReader::depends_on_circuit(const Card& card) {
  const auto given = card.value("r");
  const std::string value = card.words.size() > 3 ? card.words[3] : given.value_or("");
  if (value.empty() || value[0] != '{') return false;
  for (std::size_t i = 1; i < value.size(); ++i)
    if (value[i] == '(' && (value[i - 1] == 'v' || value[i - 1] == 'i') &&
        (i < 2 ||
         (std::isalnum(static_cast<unsigned char>(value[i - 2])) == 0 && value[i - 2] != '_')))
      return true;
  return false;
}

void CircuitReader::law_of(Json& element, StaticElement& fixed, const std::string& expression,
                           const Scope& scope, const std::string& prefix, const NodeMap& map,
                           int line) {
  law_of(element, fixed, behaviour_of(expression, scope, prefix, map, line), prefix, line);
}

void CircuitReader::law_of(Json& element, StaticElement& fixed, const std::string& law,
                           const std::string& prefix, int line) {
  element["value"] = written_value(law);
  Graph graph;
  SymbolTable symbols = circuit_.values;
  const auto made = std::make_shared<StaticLaw>();
  std::vector<Expr> variables;
  std::vector<std::pair<std::size_t, std::string>> sources;
  try {
    for (const std::string& name : names_used(law)) {
      if (symbols.find(name)) continue;
      variables.push_back(graph.variable(name));
      symbols.add(name, variables.back());
      StaticLaw::Control control;
      if (name.starts_with("potential_")) {
        for (std::size_t k = 1; k < circuit_.nodes.size(); ++k)
          if (circuit_.name_of(k) == name.substr(10)) control.node = k;
      } else {
        for (const auto& [key, named] : names_)
          if ("i_" + named.name == name) sources.emplace_back(made->controls.size(), key);
      }
      made->controls.push_back(control);
    }
    const Expr value = parse_formula(law, symbols);
    fixed.value = 0.0;
    if (variables.empty()) {
      fixed.value = value.value();
      circuit_.at_rest = circuit_.at_rest && fixed.value == 0.0;
      return;
    }
    ExprVector u(static_cast<Index>(variables.size()));
    for (Index k = 0; k < u.size(); ++k) u[k] = variables[static_cast<std::size_t>(k)];
    const Function function("law", {{"u", u}}, ExprVector{{value}}, {.differentiate = {"u"}});
    made->value = [function](const VectorXd& at) {
      return std::pair(function({at})[0], VectorXd(function.jacobian({at}).row(0)));
    };
    circuit_.at_rest = circuit_.at_rest && function({VectorXd::Zero(u.size())})[0] == 0.0;
  } catch (const FormulaError& error) {
    throw LineError{line, "\"" + law + "\": " + error.what()};
  }
  fixed.law = made;
  for (const auto& [control, key] : sources) law_controls_.push_back({made, control, key});
  (void)prefix;
}

std::string CircuitReader::polynomial_of(const Card& card, bool by_voltage,
                                         const std::string& prefix, const NodeMap& map,
                                         const Scope& scope) {
  const int line = card.line->number;
  const auto order = number(card.word(4, "order of POLY"));
  const auto n = static_cast<std::size_t>(order.value_or(0.0));
  if (n < 1 || n > 10) throw LineError{line, "POLY has no order; expected POLY(1), POLY(2), …"};
  std::size_t at = 5;
  std::vector<std::string> controls, coefficients;
  for (std::size_t k = 0; k < n; ++k) {
    if (by_voltage) {
      const std::size_t plus = node(card.word(at, "node"), prefix, map, line);
      controls.push_back(difference(plus, node(card.word(at + 1, "node"), prefix, map, line)));
      at += 2;
    } else {
      controls.push_back("i_" +
                         names_.at(reference(card.word(at, "source"), 'v', prefix, line)).name);
      at += 1;
    }
  }
  for (; at < card.words.size(); ++at) coefficients.push_back(formula(card.words[at], scope, line));
  return polynomial(controls, coefficients, line);
}

}  // namespace courant::netlist
