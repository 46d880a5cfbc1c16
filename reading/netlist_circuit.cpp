#include "courant/reading/netlist_circuit.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>
#include <sstream>
#include <tuple>

#include "courant/core/expressions/function.hpp"
#include "courant/core/language/formula.hpp"
#include "courant/core/words/message.hpp"
#include "courant/reading/netlist_behaviour.hpp"
#include "courant/reading/netlist_names.hpp"
#include "courant/reading/netlist_parameters.hpp"

namespace courant::netlist {
namespace {

// k T/e at 27 °C, the temperature of SPICE, and the conductance that it puts beside each diode.
constexpr double kThermalVoltage = 0.02586492;
constexpr double kLeastConductance = 1e-12;

// Elements, those of all instances of subcircuits. A few lines of nested ones make more than any
// memory holds.
constexpr std::size_t kMostElements = 100'000;

std::set<std::string> words_in(const Deck& deck, bool as_written) {
  std::set<std::string> words;
  for (const Line& line : deck.lines)
    for (const std::string& word : as_written ? line.written : line.words) words.insert(word);
  return words;
}

class CircuitReader {
 public:
  CircuitReader(const Deck& deck, LineProblems& problems)
      : deck_(deck),
        problems_(problems),
        names_of_nodes_(words_in(deck, false)),
        names_of_elements_(words_in(deck, true)) {}

  NetlistCircuit read() {
    circuit_.values.add("t", 0.0);
    parameters_.define(global_, "", deck_.whole.parameters);
    if (deck_.transient)
      problems_.guard([&] { read_times(*deck_.transient); });
    else
      problems_.add(0, "has no .tran; expected one, which says how long to go on");
    expand(deck_.whole, "", {}, global_);
    if (problems_.empty()) problems_.guard([&] { connect(); });
    if (problems_.empty() && circuit_.storages.empty() && circuit_.junctions.empty() &&
        !circuit_.elements.empty())
      add_state();
    circuit_.scope = global_;
    return std::move(circuit_);
  }

 private:
  using NodeMap = std::map<std::string, std::size_t>;

  struct Named {
    std::string name;  // in the experiment
    int line;
    std::optional<std::size_t> element = std::nullopt;  // of circuit_.fixed
    std::size_t entry = 0;                              // of circuit_.elements
  };
  struct Coupling {
    std::array<std::string, 2> inductors;  // keys of names_
    double coupling;
    std::size_t entry;  // of circuit_.elements
    int line;
  };

  void read_times(const Card& card) {
    const int line = card.line->number;
    std::vector<double> values;
    for (std::size_t i = 1; i < card.words.size(); ++i) {
      if (card.words[i] == "uic")
        circuit_.from_given = true;
      else
        values.push_back(circuit_.value_of(formula(card.words[i], global_, line), line));
    }
    if (values.size() < 2 || !(values[0] > 0.0) || !(values[1] > 0.0))
      throw LineError{line, "expected .tran step end, both greater than 0"};
    circuit_.times = {values[0], values[1]};
    if (values.size() > 3) circuit_.largest_step = values[3];
  }

  std::size_t node(const std::string& name, const std::string& prefix, const NodeMap& map,
                   int line) {
    if (name == "0" || name == "gnd") return 0;
    if (const auto outer = map.find(name); outer != map.end()) return outer->second;
    const std::string whole = deck_.globals.contains(name) ? name : prefix + name;
    const auto [known, is_new] = circuit_.nodes_by_name.emplace(whole, circuit_.nodes.size());
    if (is_new) {
      circuit_.nodes.push_back(names_of_nodes_.of(whole));
      circuit_.node_lines.push_back(line);
    }
    return known->second;
  }
  void expand(const Part& part, const std::string& prefix, const NodeMap& map, const Scope& scope) {
    for (const Line& line : part.elements)
      problems_.guard(
          [&] {
            const auto [known, is_new] = names_.try_emplace(
                prefix + line.words[0],
                Named{names_of_elements_.of(prefix + line.written[0]), line.number});
            if (!is_new)
              throw LineError{line.number, "the name " + line.written[0] + " is that of line " +
                                               std::to_string(known->second.line) + " again"};
          },
          line.origin);
    for (const Line& line : part.elements)
      problems_.guard([&] { add_element(part, line, prefix, map, scope); }, line.origin);
  }

  // The key of an element that another one refers to.
  std::string reference(const std::string& name, char type, const std::string& prefix,
                        int line) const {
    const std::string key = prefix + name;
    if (name[0] == type && names_.contains(key)) return key;
    throw LineError{line, std::string("needs the ") +
                              (type == 'v' ? "voltage source " : "inductor ") + name +
                              ", which is not there"};
  }

  // A model of one of the types, and where its formulas find parameters.
  struct UsedModel {
    const DeviceModel* model;
    const Scope* scope;

    std::string formula(const std::string& key, const std::string& otherwise) const {
      return netlist::formula(model->value(key, otherwise), *scope, model->line);
    }
  };
  UsedModel model(const std::string& name, const std::vector<std::string>& types, const Part& part,
                  const Scope& scope, int line) const {
    UsedModel found{nullptr, &scope};
    if (const auto own = part.models.find(name); own != part.models.end()) {
      found.model = &own->second;
    } else if (const auto outer = deck_.whole.models.find(name);
               outer != deck_.whole.models.end()) {
      found = {&outer->second, &global_};
    } else {
      throw LineError{line, "unknown model \"" + name + "\""};
    }
    if (std::ranges::find(types, found.model->type) == types.end())
      throw LineError{line, "the model " + name + " is of the type " + found.model->type +
                                "; expected " + in_words(types)};
    return found;
  }
  // Throws LineError for parameters of the model that are neither read nor without effect here.
  void allow(const UsedModel& used, const std::set<std::string>& read,
             const std::set<std::string>& without_effect) const {
    std::vector<std::string> wrong;
    for (const auto& [key, value] : used.model->values)
      if (!read.contains(key) && !without_effect.contains(key) &&
          number(value) != std::optional(0.0))
        wrong.push_back(key);
    if (!wrong.empty())
      throw LineError{used.model->line,
                      std::string(wrong.size() == 1 ? "the parameter " : "the parameters ") +
                          in_words(wrong) + " of a model of the type " + used.model->type +
                          (wrong.size() == 1 ? " is" : " are") + " not supported"};
  }

  // The difference of the potentials of two nodes as a formula.
  std::string difference(std::size_t plus, std::size_t minus) const {
    const std::string from = "potential_" + circuit_.name_of(plus),
                      to = "potential_" + circuit_.name_of(minus);
    return minus == 0 ? from : plus == 0 ? "(-" + to + ")" : "(" + from + " - " + to + ")";
  }

  void add_element(const Part& part, const Line& line, const std::string& prefix,
                   const NodeMap& map, const Scope& scope) {
    const char type = line.words[0][0];
    const bool is_source = type == 'v' || type == 'i' || type == 'b';
    const Card card = is_source ? Card{&line, line.words, {}} : card_of(line);
    if (type == 'x') return add_instance(card, prefix, map, scope);
    Named& named = names_.at(prefix + line.words[0]);
    named.entry = circuit_.elements.size();
    const auto number_of = [&](const std::string& formula) {
      return circuit_.value_of(formula, line.number);
    };
    const auto value = [&](std::size_t i) {
      return formula(card.word(i, "value"), scope, line.number);
    };
    Json element = {{"type", ""}, {"name", named.name}};
    StaticElement fixed;
    const auto nodes = [&](std::size_t first) {
      const std::size_t from = node(card.word(first, "node"), prefix, map, line.number);
      return std::pair(from, node(card.word(first + 1, "second node"), prefix, map, line.number));
    };
    const auto between = [&] {
      std::tie(fixed.from, fixed.to) = nodes(1);
      element["from"] = circuit_.nodes[fixed.from];
      element["to"] = circuit_.nodes[fixed.to];
    };
    const auto drives = [&](bool voltage) {
      element["type"] = voltage ? "voltage-source" : "current-source";
      fixed.kind = voltage ? StaticElement::Kind::voltage : StaticElement::Kind::current;
      between();
    };
    const auto only_linear = [&](std::size_t words, const char* expected) {
      if (card.words.size() != words || !card.assigned.empty())
        throw LineError{line.number,
                        std::string("only linear sources are supported; expected ") + expected};
    };
    switch (type) {
      case 'r':
      case 'c':
      case 'l': {
        element["type"] = type == 'r' ? "resistor" : type == 'c' ? "capacitor" : "inductor";
        fixed.kind = type == 'r'   ? StaticElement::Kind::resistor
                     : type == 'c' ? StaticElement::Kind::capacitor
                                   : StaticElement::Kind::inductor;
        between();
        const std::string key(1, type);
        const std::string size = size_of(card, key, part, scope);
        element["value"] = written_value(size);
        fixed.value = number_of(size);
        if (type == 'r') break;
        std::optional<std::string> given;
        if (const auto ic = card.value("ic")) given = formula(*ic, scope, line.number);
        circuit_.storages.push_back({named.name, (type == 'c' ? "q_" : "phi_") + named.name, size,
                                     circuit_.fixed.elements.size(), type == 'c', given,
                                     line.number});
        break;
      }
      case 'v':
      case 'i':
        drives(type == 'v');
        element["value"] =
            written_value(source({card.words.begin() + 3, card.words.end()}, scope, circuit_.times,
                                 line.number, circuit_.values, &circuit_.corners));
        fixed.value = element["value"].is_number() ? element["value"].get<double>()
                                                   : number_of(element["value"].get<std::string>());
        circuit_.at_rest = circuit_.at_rest && fixed.value == 0.0;
        if (type == 'v' && prefix.empty()) circuit_.sources.push_back(named.name);
        break;
      case 'k': {
        const auto inductor = [&](std::size_t i) {
          return reference(card.word(i, "inductor"), 'l', prefix, line.number);
        };
        if (card.words.size() < 4) card.word(3, "coupling");
        const std::size_t count = card.words.size() - 2;
        const std::string coupling = value(count + 1);
        card.allow(count + 2, {});
        // Of several inductors, each with each.
        for (std::size_t i = 1; i <= count; ++i)
          for (std::size_t j = i + 1; j <= count; ++j) {
            const std::string first = inductor(i), second = inductor(j);
            const std::string name =
                count == 2 ? named.name
                           : names_of_elements_.of(prefix + line.written[0] + "_" +
                                                   std::to_string(i) + std::to_string(j));
            couplings_.push_back(
                {{first, second}, number_of(coupling), circuit_.elements.size(), line.number});
            circuit_.elements.push_back(
                {{"type", "mutual-inductance"},
                 {"name", name},
                 {"inductors", {names_.at(first).name, names_.at(second).name}},
                 {"coupling", written_value(coupling)}});
            circuit_.element_lines.push_back(line.number);
          }
        return;
      }
      case 'd':
        return add_diode(card, part, prefix, map, scope);
      case 's':
      case 'w':
        return add_switch(card, part, prefix, map, scope);
      case 'b': {
        const std::string& key = card.word(3, "law");
        const bool voltage = key == "v";
        if ((!voltage && key != "i") || card.word(4, "law") != "=")
          throw LineError{line.number, "has no law; expected v=… or i=…"};
        drives(voltage);
        law_of(element, fixed, expression_after(line, voltage ? "v" : "i"), scope, prefix, map,
               line.number);
        break;
      }
      case 'e':
      case 'g':
      case 'f':
      case 'h': {
        drives(type == 'e' || type == 'h');
        const bool by_voltage = type == 'e' || type == 'g';
        const std::string third = card.words.size() > 3 ? card.words[3] : "";
        if (third == "poly") {
          law_of(element, fixed, polynomial_of(card, by_voltage, prefix, map, scope), prefix,
                 line.number);
        } else if (third == "table" || third == "value" || card.value("value") ||
                   card.value("vol") || card.value("cur")) {
          const std::string key = card.value("vol") ? "vol" : card.value("cur") ? "cur" : "value";
          if (third == "table")
            law_of(element, fixed, table_after(line), scope, prefix, map, line.number);
          else
            law_of(element, fixed, expression_after(line, key), scope, prefix, map, line.number);
        } else if (by_voltage) {
          only_linear(6, "four nodes and a number, POLY, VALUE or TABLE");
          std::tie(fixed.control_from, fixed.control_to) = nodes(3);
          const std::string gain = value(5);
          element["value"] = gain + "*" + difference(fixed.control_from, fixed.control_to);
          fixed.gain = number_of(gain);
        } else {
          only_linear(5, "two nodes, a source and a number, or POLY");
          const std::string by = reference(card.words[3], 'v', prefix, line.number),
                            gain = value(4);
          element["value"] = gain + "*i_" + names_.at(by).name;
          fixed.gain = number_of(gain);
          controls_.emplace_back(circuit_.fixed.elements.size(), by);
        }
        break;
      }
      default:
        throw LineError{line.number, "the element " + line.written[0] +
                                         " is not supported; expected R, L, C, V, I, K, D, E, F, "
                                         "G, H, B, S, W or X"};
    }
    named.element = put(element, fixed, line.number);
  }

  // Both of an element; the index among the static ones.
  std::size_t put(const Json& element, const StaticElement& fixed, int line) {
    circuit_.fixed.elements.push_back(fixed);
    circuit_.names.push_back(element["name"].get<std::string>());
    circuit_.lines.push_back(line);
    circuit_.elements.push_back(element);
    circuit_.element_lines.push_back(line);
    return circuit_.fixed.elements.size() - 1;
  }

  // The value of R, C or L: a number, key=value, or that of a model. What belongs to temperatures other than the nominal one
  // has no effect.
  std::string size_of(const Card& card, const std::string& key, const Part& part,
                      const Scope& scope) {
    const int line = card.line->number;
    static const std::vector<std::string> without_effect = {"tc", "tc1",   "tc2",   "temp", "dtemp",
                                                            "ac", "noisy", "noise", "w",    "l"};
    std::vector<std::string> allowed = {key, "ic", "m", "scale"};
    std::vector<std::string> passed;
    for (const Assignment& assignment : card.assigned)
      if (assignment.name != key &&
          std::ranges::find(without_effect, assignment.name) != without_effect.end()) {
        allowed.push_back(assignment.name);
        passed.push_back(assignment.name);
      }
    if (key == "r") std::erase(allowed, "ic");
    std::string size;
    std::size_t words = 4;
    if (card.words.size() > 3 && !number(card.words[3]) && card.words[3][0] != '{' &&
        !scope.contains(card.words[3])) {
      const UsedModel used = model(card.words[3],
                                   {key, key == "r"   ? "res"
                                         : key == "c" ? "cap"
                                                      : "ind"},
                                   part, scope, line);
      const std::string name = key == "r" ? "r" : key == "c" ? "c" : "l";
      if (card.value(key))
        size = formula(*card.value(key), scope, line);
      else if (used.model->values.contains(name))
        size = used.formula(name, "0");
      else
        throw LineError{line, "has a model without a value of its own; expected a number"};
      words = 4;
    } else {
      size = formula(card.value_of(3, key), scope, line);
      // A model behind the value, whose coefficients are of the temperature.
      if (card.words.size() > 4 && !number(card.words[4])) words = 5;
    }
    card.allow(words, allowed);
    if (!passed.empty())
      circuit_.notes.emplace_back(line,
                                  in_words(passed) + " has no effect at the nominal temperature");
    if (const auto m = card.value("m"))
      size = key == "c" ? size + "*" + formula(*m, scope, line)
                        : "(" + size + ")/" + formula(*m, scope, line);
    if (const auto scale = card.value("scale"))
      size = "(" + size + ")*" + formula(*scale, scope, line);
    return size;
  }

  // What stands behind `key =` in a line as it is written, without braces or quotes around it; up to the next
  // assignment.
  static std::string expression_after(const Line& line, const std::string& key) {
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

  // TABLE {x} = (x₁, y₁) (x₂, y₂) …, as table(x, x₁, y₁, …).
  static std::string table_after(const Line& line) {
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

  // The law of a source from an expression of SPICE.
  void law_of(Json& element, StaticElement& fixed, const std::string& expression,
              const Scope& scope, const std::string& prefix, const NodeMap& map, int line) {
    const BehaviourWords words{[&](const std::string& name) {
                                 const std::size_t place = node(name, prefix, map, line);
                                 return place == 0 ? std::string("0")
                                                   : "potential_" + circuit_.name_of(place);
                               },
                               [&](const std::string& name) {
                                 return "i_" + names_.at(reference(name, 'v', prefix, line)).name;
                               }};
    law_of(element, fixed, behaviour(expression, scope, line, words), prefix, line);
  }

  // … from a formula of potentials and currents.
  void law_of(Json& element, StaticElement& fixed, const std::string& law,
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

  std::string polynomial_of(const Card& card, bool by_voltage, const std::string& prefix,
                            const NodeMap& map, const Scope& scope) {
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
    for (; at < card.words.size(); ++at)
      coefficients.push_back(formula(card.words[at], scope, line));
    return polynomial(controls, coefficients, line);
  }

  // A node of the importer's own.
  std::size_t own_node(const std::string& name, int line) {
    circuit_.nodes.push_back(names_of_nodes_.of(name));
    circuit_.node_lines.push_back(line);
    return circuit_.nodes.size() - 1;
  }
  void add_own(const char* type, const std::string& name, std::size_t from, std::size_t to,
               const std::string& value, StaticElement fixed, int line) {
    fixed.from = from;
    fixed.to = to;
    put({{"type", type},
         {"name", names_of_elements_.of(name)},
         {"from", circuit_.nodes[from]},
         {"to", circuit_.nodes[to]},
         {"value", written_value(value)}},
        fixed, line);
  }

  void add_diode(const Card& card, const Part& part, const std::string& prefix, const NodeMap& map,
                 const Scope& scope) {
    const int line = card.line->number;
    Named& named = names_.at(prefix + card.words[0]);
    const auto number_of = [&](const std::string& formula) {
      return circuit_.value_of(formula, line);
    };
    StaticElement fixed{.kind = StaticElement::Kind::diode};
    fixed.from = node(card.word(1, "node"), prefix, map, line);
    fixed.to = node(card.word(2, "second node"), prefix, map, line);
    const UsedModel used = model(card.word(3, "model"), {"d"}, part, scope, line);
    allow(used,
          {"is", "n", "rs", "cjo", "cj0", "cj", "tt", "bv", "ibv", "vj", "pb", "m", "mj", "fc"},
          {"tnom", "tref", "eg",  "xti",  "kf",  "af",   "nbv",      "level",
           "trs",  "trs1", "mfg", "iave", "vpk", "type", "icrating", "vrev",
           "irms", "cta",  "ctc", "trs2", "tm1", "tm2",  "tbv1"});
    const bool is_off = card.words.back() == "off";  // where SPICE is to begin its search
    const bool has_area = card.words.size() > (is_off ? 5u : 4u) || card.value("area");
    card.allow(4 + (has_area ? 1u : 0u) + (is_off ? 1u : 0u), {"area", "ic", "temp", "m"});
    std::string area;
    if (has_area) area = formula(card.value_of(4, "area"), scope, line);
    if (const auto m = card.value("m"))
      area += (area.empty() ? "" : "*") + formula(*m, scope, line);
    const auto per_area = [&](const std::string& value) {
      return area.empty() ? value : value + "*" + area;
    };
    const std::string saturation = per_area(used.formula("is", "1e-14")),
                      emission = used.formula("n", "1");
    // The series resistance, with a node of its own behind it.
    const std::string series = used.formula("rs", "0");
    if (number_of(series) > 0.0) {
      const std::size_t inside = own_node(prefix + card.words[0] + "_inside", line);
      const std::string value = area.empty() ? series : "(" + series + ")/(" + area + ")";
      add_own("resistor", prefix + card.line->written[0] + "_rs", fixed.from, inside, value,
              {.kind = StaticElement::Kind::resistor, .value = number_of(value)}, line);
      fixed.from = inside;
    }
    Json element = {{"type", "diode"},
                    {"name", named.name},
                    {"from", circuit_.nodes[fixed.from]},
                    {"to", circuit_.nodes[fixed.to]},
                    {"saturation", written_value(saturation)},
                    {"emission", written_value(emission)},
                    {"thermal_voltage", kThermalVoltage},
                    {"leak", kLeastConductance}};
    fixed.value = number_of(saturation);
    fixed.scale = number_of(emission) * kThermalVoltage;
    fixed.leak = kLeastConductance;
    if (used.model->values.contains("bv")) {
      const std::string voltage = used.formula("bv", "0"),
                        current = per_area(used.formula("ibv", "1e-3"));
      fixed.breakdown_voltage = std::abs(number_of(voltage));
      fixed.breakdown = number_of(current);
      element["breakdown"] = fixed.breakdown_voltage;
      element["breakdown_current"] = written_value(current);
    }
    const auto first_of = [&](std::initializer_list<const char*> keys, const char* otherwise) {
      for (const char* key : keys)
        if (used.model->values.contains(key)) return used.formula(key, otherwise);
      return std::string(otherwise);
    };
    const std::string capacitance = per_area(first_of({"cjo", "cj0", "cj"}, "0")),
                      transit = used.formula("tt", "0");
    if (number_of(capacitance) > 0.0 || number_of(transit) > 0.0) {
      element["capacitance"] = written_value(capacitance);
      element["transit"] = written_value(transit);
      element["junction"] = written_value(first_of({"vj", "pb"}, "1"));
      element["grading"] = written_value(first_of({"m", "mj"}, "0.5"));
      element["forward"] = written_value(used.formula("fc", "0.5"));
      circuit_.junctions.push_back({"q_" + named.name,
                                    circuit_.fixed.elements.size(),
                                    {.capacitance = number_of(capacitance),
                                     .junction = number_of(first_of({"vj", "pb"}, "1")),
                                     .grading = number_of(first_of({"m", "mj"}, "0.5")),
                                     .forward = number_of(used.formula("fc", "0.5")),
                                     .transit = number_of(transit),
                                     .saturation = fixed.value,
                                     .scale = fixed.scale}});
    }
    named.entry = circuit_.elements.size();
    named.element = put(element, fixed, line);
  }

  // A resistor whose conductance goes from off to on by the control, geometrically over 2 vh or, where that is 0, over a
  // thousandth of vt.
  void add_switch(const Card& card, const Part& part, const std::string& prefix, const NodeMap& map,
                  const Scope& scope) {
    const int line = card.line->number;
    const bool by_voltage = card.words[0][0] == 's';
    const std::size_t place = by_voltage ? 5 : 4;
    const UsedModel used =
        by_voltage ? model(card.word(place, "model"), {"sw", "vswitch"}, part, scope, line)
                   : model(card.word(place, "model"), {"csw", "iswitch"}, part, scope, line);
    allow(used, {"vt", "vh", "it", "ih", "ron", "roff", "von", "voff", "ion", "ioff"}, {});
    if (card.words.size() > place + 1 && (card.words.back() == "on" || card.words.back() == "off"))
      card.allow(place + 2, {});
    else
      card.allow(place + 1, {});
    const std::string letter = by_voltage ? "v" : "i";
    std::string middle = used.formula(letter + "t", "0"), half = used.formula(letter + "h", "0");
    const std::string on = letter + "on", off = letter + "off";
    if (used.model->values.contains(on) || used.model->values.contains(off)) {
      const std::string at_on = used.formula(on, "1"), at_off = used.formula(off, "0");
      middle = "((" + at_on + " + " + at_off + ")/2)";
      half = "((" + at_on + " - " + at_off + ")/2)";
    } else if (circuit_.value_of(half, line) > 0.0) {
      circuit_.notes.emplace_back(
          line, "the hysteresis of the switch has no memory here: it goes over between " + letter +
                    "t - " + letter + "h and " + letter + "t + " + letter + "h, both ways alike");
    }
    double width = circuit_.value_of(half, line);
    if (width == 0.0) {
      width = 1e-3 * std::max(std::abs(circuit_.value_of(middle, line)), 1e-3);
      half = exact_text(width);
    }
    std::string control;
    if (by_voltage) {
      const std::size_t plus = node(card.word(3, "node"), prefix, map, line);
      control = difference(plus, node(card.word(4, "node"), prefix, map, line));
    } else {
      control = "i_" + names_.at(reference(card.word(3, "source"), 'v', prefix, line)).name;
    }
    const std::string s =
        "min(max((" + control + " - (" + middle + "))/(2*(" + half + ")) + 0.5, 0), 1)";
    const std::string smooth = s + "^2*(3 - 2*" + s + ")";
    const std::string off_value = used.formula("roff", "1e12"), on_value = used.formula("ron", "1");
    Named& named = names_.at(prefix + card.words[0]);
    Json element = {{"type", "resistor"}, {"name", named.name}};
    StaticElement fixed{.kind = StaticElement::Kind::current};
    fixed.from = node(card.word(1, "node"), prefix, map, line);
    fixed.to = node(card.word(2, "second node"), prefix, map, line);
    element["from"] = circuit_.nodes[fixed.from];
    element["to"] = circuit_.nodes[fixed.to];
    const std::string conductance =
        "exp(-log(" + off_value + ") + log((" + off_value + ")/(" + on_value + "))*" + smooth + ")";
    law_of(element, fixed, difference(fixed.from, fixed.to) + "*" + conductance, prefix, line);
    element.erase("value");
    element["current"] = "v_" + named.name + "*" + conductance;
    named.entry = circuit_.elements.size();
    named.element = put(element, fixed, line);
  }

  void add_instance(const Card& card, const std::string& prefix, const NodeMap& map,
                    const Scope& scope) {
    const int line = card.line->number;
    if (names_.size() >= kMostElements)
      throw LineError{
          line, "makes more than " + std::to_string(kMostElements) +
                    " elements of the netlist, with those of its subcircuits; expected fewer"};
    std::vector<std::string> words = card.words;
    std::erase(words, "params:");
    if (words.size() < 2) throw LineError{line, "has no subcircuit; expected one"};
    const std::string& name = words.back();
    const auto found = deck_.subcircuits.find(name);
    if (found == deck_.subcircuits.end())
      throw LineError{line, "unknown subcircuit \"" + name + "\""};
    const Part& part = found->second;
    if (words.size() - 2 != part.nodes.size())
      throw LineError{line, "has " + std::to_string(words.size() - 2) + " nodes; the subcircuit " +
                                name + " has " + std::to_string(part.nodes.size())};
    if (std::find(inside_.begin(), inside_.end(), &part) != inside_.end())
      throw LineError{line, "the subcircuit " + name + " contains itself"};
    NodeMap inner;
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      inner[part.nodes[i]] = node(words[i + 1], prefix, map, line);
    const std::string inside = prefix + words[0] + ".";
    Scope known = scope;
    Assignments defaults;
    for (const Assignment& assignment : part.header)
      if (!card.value(assignment.name)) defaults.push_back(assignment);
    for (const Assignment& given : card.assigned) {
      if (std::none_of(part.header.begin(), part.header.end(),
                       [&](const Assignment& parameter) { return parameter.name == given.name; }))
        throw LineError{line, "the subcircuit " + name + " has no parameter " + given.name};
      parameters_.define(known, inside, given.name, formula(given.value, scope, line), line);
    }
    defaults.insert(defaults.end(), part.parameters.begin(), part.parameters.end());
    parameters_.define(known, inside, defaults);
    inside_.push_back(&part);
    expand(part, inside, inner, known);
    inside_.pop_back();
  }

  // What elements say of others.
  void connect() {
    circuit_.fixed.nodes = circuit_.nodes.size();
    for (const auto& [element, by] : controls_)
      circuit_.fixed.elements[element].control = names_.at(by).element;
    for (const auto& [law, control, by] : law_controls_)
      law->controls[control].element = names_.at(by).element;
    std::vector<std::size_t> gone;
    for (const Coupling& coupling : couplings_) {
      const Named &first = names_.at(coupling.inductors[0]),
                  &second = names_.at(coupling.inductors[1]);
      const double of_first = circuit_.fixed.elements[*first.element].value,
                   of_second = circuit_.fixed.elements[*second.element].value;
      circuit_.fixed.couplings.push_back(
          {*first.element, *second.element, coupling.coupling * std::sqrt(of_first * of_second)});
    }
    for (const std::vector<std::string>& group : wholly_coupled()) couple_wholly(group, gone);
    std::sort(gone.rbegin(), gone.rend());
    for (const std::size_t entry : gone) {
      circuit_.elements.erase(entry);
      circuit_.element_lines.erase(circuit_.element_lines.begin() + static_cast<Index>(entry));
    }
  }

  // The coupling of two inductors; null if there is none.
  const Coupling* coupling_of(const std::string& first, const std::string& second) const {
    for (const Coupling& coupling : couplings_)
      if ((coupling.inductors[0] == first && coupling.inductors[1] == second) ||
          (coupling.inductors[0] == second && coupling.inductors[1] == first))
        return &coupling;
    return nullptr;
  }

  // Inductors that share one flux, those of each core in the order of the netlist. Throws LineError where one of them is coupled with
  // another one in part.
  std::vector<std::vector<std::string>> wholly_coupled() const {
    std::vector<std::vector<std::string>> groups;
    for (const Coupling& coupling : couplings_) {
      if (std::abs(coupling.coupling) != 1.0) continue;
      std::vector<std::string> joined;
      for (const std::string& inductor : coupling.inductors) {
        const auto found = std::ranges::find_if(groups, [&](const auto& group) {
          return std::ranges::find(group, inductor) != group.end();
        });
        if (found == groups.end()) {
          joined.push_back(inductor);
        } else {
          joined.insert(joined.end(), found->begin(), found->end());
          groups.erase(found);
        }
      }
      std::vector<std::string> once;
      for (const std::string& inductor : joined)
        if (std::ranges::find(once, inductor) == once.end()) once.push_back(inductor);
      groups.push_back(once);
    }
    for (const auto& group : groups)
      for (const Coupling& coupling : couplings_) {
        const auto inside = [&](const std::string& name) {
          return std::ranges::find(group, name) != group.end();
        };
        const bool first = inside(coupling.inductors[0]), second = inside(coupling.inductors[1]);
        if (first != second || (first && std::abs(coupling.coupling) != 1.0))
          throw LineError{coupling.line,
                          "the inductors are coupled wholly, and one of them is coupled with "
                          "others in part; expected a coupling between -1 and 1"};
      }
    return groups;
  }

  // With M² = L₁ L₂ the fluxes are one: φ₂ = M/L₁ φ₁, and φ₁ = L₁ (i₁ + M/L₁ i₂ + …). That is the first
  // inductor beside ideal transformers, one for each other inductor.
  void couple_wholly(const std::vector<std::string>& group, std::vector<std::size_t>& gone) {
    const Named& first = names_.at(group[0]);
    const Json primary = circuit_.elements[first.entry];
    const auto text = [](const Json& value) {
      return value.is_number() ? exact_text(value.get<double>()) : value.get<std::string>();
    };
    const auto storage = [&](const Named& named) {
      return std::find_if(circuit_.storages.begin(), circuit_.storages.end(),
                          [&](const NetlistStorage& each) { return each.name == named.name; });
    };
    const auto of_first = storage(first);
    std::map<std::string, double> sign = {{group[0], 1.0}};
    std::set<std::size_t> used;
    for (std::size_t k = 1; k < group.size(); ++k) {
      const Named& second = names_.at(group[k]);
      const Json secondary = circuit_.elements[second.entry];
      const Coupling* coupling = coupling_of(group[0], group[k]);
      if (!coupling)
        throw LineError{second.line, "the inductor " + second.name + " shares a core with " +
                                         first.name +
                                         ", but is not coupled with it; expected a coupling of 1"};
      sign[group[k]] = coupling->coupling;
      used.insert(coupling->entry);
      Json& element = circuit_.elements[coupling->entry];
      element = {{"type", "ideal-transformer"},
                 {"name", element["name"]},
                 {"from", primary["from"]},
                 {"to", primary["to"]},
                 {"secondary", {secondary["from"], secondary["to"]}},
                 {"ratio", (coupling->coupling < 0.0 ? "-sqrt(" : "sqrt(") +
                               text(primary["value"]) + "/(" + text(secondary["value"]) + "))"}};
      const auto of_second = storage(second);
      if (of_second->given)
        of_first->given = "(" + of_first->given.value_or("0") + " + " + *of_second->given + "/(" +
                          element["ratio"].get<std::string>() + "))";
      gone.push_back(second.entry);
    }
    for (const Coupling& coupling : couplings_) {
      if (!sign.contains(coupling.inductors[0]) || used.contains(coupling.entry)) continue;
      if (coupling.coupling != sign[coupling.inductors[0]] * sign[coupling.inductors[1]])
        throw LineError{coupling.line,
                        "the signs of the couplings on one core contradict each other"};
      gone.push_back(coupling.entry);
    }
    std::erase_if(circuit_.storages, [&](const NetlistStorage& each) {
      return each.name != first.name && std::ranges::any_of(group, [&](const std::string& name) {
               return names_.at(name).name == each.name;
             });
    });
  }

  void add_state() {
    std::string node = "rest";
    for (int i = 2; circuit_.nodes_by_name.contains(node) || names_.contains("r_" + node) ||
                    names_.contains("c_" + node);
         ++i)
      node = "rest_" + std::to_string(i);
    circuit_.resting = circuit_.nodes.size();
    circuit_.nodes.push_back(node);
    circuit_.node_lines.push_back(0);
    for (const char* type : {"capacitor", "resistor"}) {
      const std::string name = std::string(type[0] == 'c' ? "C_" : "R_") + node;
      circuit_.elements.push_back(
          {{"type", type}, {"name", name}, {"from", node}, {"to", "0"}, {"value", 1.0}});
      circuit_.element_lines.push_back(0);
    }
  }

  const Deck& deck_;
  LineProblems& problems_;
  NetlistCircuit circuit_;
  NetlistParameters parameters_{circuit_, problems_};
  Scope global_;
  DifferentNames names_of_nodes_, names_of_elements_;
  std::map<std::string, Named> names_;  // of elements, by instance and lower case
  std::vector<const Part*> inside_;     // which instances are being read
  std::vector<Coupling> couplings_;
  std::vector<std::pair<std::size_t, std::string>> controls_;  // elements of circuit_.fixed, keys
  struct LawControl {
    std::shared_ptr<StaticLaw> law;
    std::size_t control;
    std::string by;
  };
  std::vector<LawControl> law_controls_;
};

}  // namespace

double NetlistCircuit::value_of(const std::string& formula, int line) const {
  try {
    const double value = parse_formula(formula, values).value();
    if (std::isfinite(value)) return value;
    throw LineError{line, "\"" + formula + "\" is not finite; expected a number"};
  } catch (const FormulaError& error) {
    throw LineError{line, "\"" + formula + "\": " + error.what()};
  }
}

Json written_value(const std::string& formula) {
  if (const auto value = number(formula)) return *value;
  return formula;
}

NetlistCircuit read_circuit(const Deck& deck, LineProblems& problems) {
  return CircuitReader(deck, problems).read();
}

}  // namespace courant::netlist
