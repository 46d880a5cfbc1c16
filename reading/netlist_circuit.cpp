#include "courant/reading/netlist_circuit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "courant/core/language/formula.hpp"
#include "courant/core/words/message.hpp"
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
    if (problems_.empty() && circuit_.storages.empty() && !circuit_.elements.empty()) add_state();
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
    const auto [known, is_new] =
        circuit_.nodes_by_name.emplace(prefix + name, circuit_.nodes.size());
    if (is_new) {
      circuit_.nodes.push_back(names_of_nodes_.of(prefix + name));
      circuit_.node_lines.push_back(line);
    }
    return known->second;
  }
  void expand(const Part& part, const std::string& prefix, const NodeMap& map, const Scope& scope) {
    for (const Line& line : part.elements)
      problems_.guard([&] {
        const auto [known, is_new] =
            names_.try_emplace(prefix + line.words[0],
                               Named{names_of_elements_.of(prefix + line.written[0]), line.number});
        if (!is_new)
          throw LineError{line.number, "the name " + line.written[0] + " is that of line " +
                                           std::to_string(known->second.line) + " again"};
      });
    for (const Line& line : part.elements)
      problems_.guard([&] { add_element(part, line, prefix, map, scope); });
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

  std::pair<const DiodeModel*, const Scope*> model(const std::string& name, const Part& part,
                                                   const Scope& scope, int line) const {
    if (const auto own = part.models.find(name); own != part.models.end())
      return {&own->second, &scope};
    if (const auto found = deck_.whole.models.find(name); found != deck_.whole.models.end())
      return {&found->second, &global_};
    throw LineError{line, "unknown model \"" + name + "\""};
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
    const bool is_source = type == 'v' || type == 'i';
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
        const std::string size = formula(card.value_of(3, key), scope, line.number);
        card.allow(4, type == 'r' ? std::vector{key} : std::vector{key, std::string("ic")});
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
        element["type"] = "mutual-inductance";
        const auto inductor = [&](std::size_t i) {
          return reference(card.word(i, "inductor"), 'l', prefix, line.number);
        };
        const std::string first = inductor(1), second = inductor(2), coupling = value(3);
        card.allow(4, {});
        element["inductors"] = {names_.at(first).name, names_.at(second).name};
        element["coupling"] = written_value(coupling);
        couplings_.push_back({{first, second}, number_of(coupling), named.entry, line.number});
        break;
      }
      case 'd': {
        element["type"] = "diode";
        fixed.kind = StaticElement::Kind::diode;
        between();
        const auto [model, known] = this->model(card.word(3, "model"), part, scope, line.number);
        std::string saturation = formula(model->saturation, *known, model->line);
        const bool is_off = card.words.back() == "off";  // where SPICE is to begin its search
        const bool has_area = card.words.size() > (is_off ? 5u : 4u) || card.value("area");
        card.allow(4 + (has_area ? 1u : 0u) + (is_off ? 1u : 0u), {"area"});
        if (has_area) saturation += "*" + formula(card.value_of(4, "area"), scope, line.number);
        const std::string emission = formula(model->emission, *known, model->line);
        element["saturation"] = written_value(saturation);
        element["emission"] = written_value(emission);
        element["thermal_voltage"] = kThermalVoltage;
        element["leak"] = kLeastConductance;
        fixed.value = number_of(saturation);
        fixed.scale = number_of(emission) * kThermalVoltage;
        fixed.leak = kLeastConductance;
        break;
      }
      case 'e':
      case 'g': {
        drives(type == 'e');
        only_linear(6, "four nodes and a number");
        std::tie(fixed.control_from, fixed.control_to) = nodes(3);
        const std::string gain = value(5);
        element["value"] = gain + "*" + difference(fixed.control_from, fixed.control_to);
        fixed.gain = number_of(gain);
        break;
      }
      case 'f':
      case 'h': {
        drives(type == 'h');
        only_linear(5, "two nodes, a source and a number");
        const std::string by = reference(card.words[3], 'v', prefix, line.number), gain = value(4);
        element["value"] = gain + "*i_" + names_.at(by).name;
        fixed.gain = number_of(gain);
        controls_.emplace_back(circuit_.fixed.elements.size(), by);
        break;
      }
      default:
        throw LineError{line.number, "the element " + line.written[0] +
                                         " is not supported; expected R, L, C, V, I, K, D, E, F, "
                                         "G, H or X"};
    }
    if (type != 'k') {
      named.element = circuit_.fixed.elements.size();
      circuit_.fixed.elements.push_back(fixed);
      circuit_.names.push_back(named.name);
      circuit_.lines.push_back(line.number);
    }
    circuit_.elements.push_back(element);
    circuit_.element_lines.push_back(line.number);
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
    std::vector<std::size_t> gone;
    for (const Coupling& coupling : couplings_) {
      const Named &first = names_.at(coupling.inductors[0]),
                  &second = names_.at(coupling.inductors[1]);
      const double of_first = circuit_.fixed.elements[*first.element].value,
                   of_second = circuit_.fixed.elements[*second.element].value;
      circuit_.fixed.couplings.push_back(
          {*first.element, *second.element, coupling.coupling * std::sqrt(of_first * of_second)});
      if (std::abs(coupling.coupling) != 1.0) continue;
      for (const Coupling& other : couplings_)
        for (const std::string& inductor : other.inductors)
          if (&other != &coupling &&
              (inductor == coupling.inductors[0] || inductor == coupling.inductors[1]))
            throw LineError{coupling.line,
                            "the inductors are coupled wholly, and one of them is coupled with "
                            "others too; expected a coupling between -1 and 1"};
      couple_wholly(coupling, first, second);
      gone.push_back(second.entry);
    }
    std::sort(gone.rbegin(), gone.rend());
    for (const std::size_t entry : gone) {
      circuit_.elements.erase(entry);
      circuit_.element_lines.erase(circuit_.element_lines.begin() + static_cast<Index>(entry));
    }
  }

  // With M² = L₁ L₂ the fluxes are one: φ₂ = M/L₁ φ₁, and φ₁ = L₁ (i₁ + M/L₁ i₂). That is the first
  // inductor beside an ideal transformer.
  void couple_wholly(const Coupling& coupling, const Named& first, const Named& second) {
    const Json primary = circuit_.elements[first.entry],
               secondary = circuit_.elements[second.entry];
    const auto text = [](const Json& value) {
      return value.is_number() ? exact_text(value.get<double>()) : value.get<std::string>();
    };
    const std::string sign = coupling.coupling < 0.0 ? "-" : "";
    Json& element = circuit_.elements[coupling.entry];
    element = {{"type", "ideal-transformer"},
               {"name", element["name"]},
               {"from", primary["from"]},
               {"to", primary["to"]},
               {"secondary", {secondary["from"], secondary["to"]}},
               {"ratio",
                sign + "sqrt(" + text(primary["value"]) + "/(" + text(secondary["value"]) + "))"}};
    const auto storage = [&](const Named& named) {
      return std::find_if(circuit_.storages.begin(), circuit_.storages.end(),
                          [&](const NetlistStorage& each) { return each.name == named.name; });
    };
    const auto of_first = storage(first), of_second = storage(second);
    if (of_second->given)
      of_first->given = "(" + of_first->given.value_or("0") + " + " + *of_second->given + "/(" +
                        element["ratio"].get<std::string>() + "))";
    circuit_.storages.erase(of_second);
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
