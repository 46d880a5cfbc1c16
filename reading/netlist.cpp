#include "courant/reading/netlist.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "courant/core/formula.hpp"
#include "courant/reading/netlist_sources.hpp"

namespace courant {
namespace {

using namespace netlist;

// k T/e at 27 °C, the temperature of SPICE, and the conductance that it puts beside each diode.
constexpr double kThermalVoltage = 0.02586492;
constexpr double kLeastConductance = 1e-12;

std::string identifier(const std::string& text) {
  std::string result = text;
  for (char& c : result)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return result;
}

// A number where it is one.
Json written_value(const std::string& formula) {
  if (const auto value = number(formula)) return *value;
  return formula;
}

using Assignments = std::vector<std::pair<std::string, std::string>>;

struct Card {
  const Line* line;
  std::vector<std::string> words;  // before the first assignment
  Assignments assigned;

  const std::string& word(std::size_t i, const char* what) const {
    if (i >= words.size())
      throw LineError{line->number, std::string("has no ") + what + "; expected one"};
    return words[i];
  }
  std::optional<std::string> value(const std::string& key) const {
    for (const auto& [name, value] : assigned)
      if (name == key) return value;
    return std::nullopt;
  }
};

Card card_of(const Line& line) {
  Card card{&line, line.words, {}};
  const auto first = std::find(card.words.begin(), card.words.end(), "=");
  if (first == card.words.end()) return card;
  std::size_t i = static_cast<std::size_t>(first - card.words.begin());
  if (i == 0) throw LineError{line.number, "begins with ="};
  for (std::size_t k = i - 1; k < card.words.size(); k += 3) {
    if (k + 2 >= card.words.size() || card.words[k + 1] != "=")
      throw LineError{line.number, "expected name = value at the end"};
    card.assigned.emplace_back(card.words[k], card.words[k + 2]);
  }
  card.words.resize(i - 1);
  return card;
}

struct Subcircuit {
  std::vector<std::string> nodes;
  Assignments parameters;
  std::vector<Line> lines;
};

struct DiodeModel {
  std::string saturation = "1e-14", emission = "1";
};

class Import {
 public:
  explicit Import(std::string_view text) {
    std::vector<Line> lines;
    guard([&] { lines = lines_of(text, title_); });
    collect(lines);
    guard([&] { define(global_, "", parameters_, 0); });
    expand(lines_, "", {}, global_);
    if (!times_.end) problem(0, "has no .tran; expected one, which says how long to go on");
    if (!problems_.empty()) throw ExperimentError(problems_);
  }

  Json experiment() {
    Json system = {{"type", "network"}};
    if (!parameter_values_.empty()) system["parameters"] = parameter_values_;
    system["nodes"] = nodes_;
    system["elements"] = elements_;
    const double longest = largest_step_ > 0.0 ? std::min(largest_step_, times_.step) : times_.step;
    const double steps = std::ceil(times_.end / longest * (1.0 - 1e-12));
    Json observe = Json::object();
    for (std::size_t node = 1; node < nodes_.size(); ++node) {
      const std::string name = "potential_" + nodes_[node].get<std::string>();
      observe[name] = name;
    }
    for (const std::string& name : sources_) observe["i_" + name] = "i_" + name;
    return {{"title", title_.empty() ? "A netlist" : title_},
            {"system", system},
            {"initial", initial()},
            {"method", {{"type", "constrain-first"}, {"discretization", "midpoint"}}},
            {"time", {{"step", times_.end / steps}, {"end", times_.end}}},
            {"observe", observe}};
  }

 private:
  struct Storage {
    std::string name, state, value;
    std::string from, to;
    bool is_capacitor;
    std::optional<std::string> given;
  };

  void problem(int line, const std::string& what) {
    problems_.push_back({line > 0 ? "line " + std::to_string(line) : "the netlist", what});
  }
  template <class Action>
  void guard(const Action& action) {
    try {
      action();
    } catch (const LineError& error) {
      problem(error.line, error.what);
    }
  }

  // Cards that are about the whole; the rest goes to lines_.
  void collect(const std::vector<Line>& lines) {
    Subcircuit* inside = nullptr;
    for (const Line& line : lines)
      guard([&] {
        const std::string& first = line.words[0];
        if (first == ".subckt") {
          const Card card = card_of(line);
          if (inside) throw LineError{line.number, "a .subckt inside another is not supported"};
          inside = &subcircuits_[card.word(1, "name")];
          for (std::size_t i = 2; i < card.words.size(); ++i)
            if (card.words[i] != "params:") inside->nodes.push_back(card.words[i]);
          inside->parameters = card.assigned;
        } else if (first == ".ends") {
          inside = nullptr;
        } else if (first == ".model") {
          add_model(card_of(line));
        } else if (inside) {
          inside->lines.push_back(line);
        } else if (first == ".param") {
          const Card card = card_of(line);
          for (const auto& assignment : card.assigned) parameters_.push_back(assignment);
        } else if (first == ".tran") {
          add_times(card_of(line));
        } else if (first == ".ic") {
          add_initial(line);
        } else if (first == ".print" || first == ".plot" || first == ".save" || first == ".probe" ||
                   first == ".options" || first == ".option") {
          // What to show, and how accurate: the experiment says that in its own way.
        } else if (first[0] == '.') {
          throw LineError{line.number, first + " is not supported"};
        } else {
          lines_.push_back(line);
        }
      });
  }

  void add_times(const Card& card) {
    std::vector<double> values;
    for (std::size_t i = 1; i < card.words.size(); ++i) {
      if (card.words[i] == "uic") {
        from_given_ = true;
        continue;
      }
      const auto value = number(card.words[i]);
      if (!value) throw LineError{card.line->number, "\"" + card.words[i] + "\" is no number"};
      values.push_back(*value);
    }
    if (values.size() < 2 || !(values[0] > 0.0) || !(values[1] > 0.0))
      throw LineError{card.line->number, "expected .tran step end, both greater than 0"};
    times_ = {values[0], values[1]};
    if (values.size() > 3) largest_step_ = values[3];
  }

  void add_initial(const Line& line) {
    for (std::size_t i = 1; i + 3 < line.words.size(); i += 4) {
      if (line.words[i] != "v" || line.words[i + 2] != "=")
        throw LineError{line.number, "expected .ic v(node)=value …"};
      given_[node(line.words[i + 1], "", {})] = line.words[i + 3];
    }
    given_line_ = line.number;
  }

  void add_model(const Card& card) {
    const std::string& name = card.word(1, "name");
    if (card.word(2, "type") != "d")
      throw LineError{card.line->number,
                      "models of the type " + card.words[2] + " are not supported; expected D"};
    DiodeModel& model = models_[name];
    for (const auto& [key, value] : card.assigned) {
      if (key == "is")
        model.saturation = value;
      else if (key == "n")
        model.emission = value;
      else if (number(value) != std::optional(0.0) && key != "bv" && key != "ibv" && key != "tnom")
        throw LineError{card.line->number,
                        "the parameter " + key + " of a diode is not supported; expected is or n"};
    }
  }

  // Adds parameters to a scope, those first that the others need.
  void define(Scope& scope, const std::string& prefix, Assignments list, int line) {
    while (!list.empty()) {
      Assignments left;
      std::optional<LineError> error;
      for (const auto& [name, value] : list) {
        try {
          std::string global = identifier(prefix + name);
          while (name_is_taken(global)) global += "_";
          parameter_values_[global] = written_value(formula(value, scope, line));
          scope[name] = global;
        } catch (const LineError& unknown) {
          error = unknown;
          left.emplace_back(name, value);
        }
      }
      if (left.size() == list.size()) throw *error;
      list = left;
    }
  }
  bool name_is_taken(const std::string& name) const {
    static const std::set<std::string> reserved = {"t", "e", "pi", "h"};
    return reserved.count(name) > 0 || parameter_values_.contains(name);
  }

  using NodeMap = std::map<std::string, std::string>;
  std::string node(const std::string& name, const std::string& prefix, const NodeMap& map) {
    if (name == "0" || name == "gnd") return "0";
    if (const auto outer = map.find(name); outer != map.end()) return outer->second;
    const std::string known = identifier(prefix + name);
    if (std::find(nodes_.begin(), nodes_.end(), known) == nodes_.end()) nodes_.push_back(known);
    return known;
  }

  void expand(const std::vector<Line>& lines, const std::string& prefix, const NodeMap& map,
              const Scope& scope) {
    for (const Line& line : lines)
      guard([&] {
        if (line.words[0] == ".param") {
          Card card = card_of(line);
          throw LineError{line.number, "a .param inside a .subckt is not supported"};
        }
        add_element(line, prefix, map, scope);
      });
  }

  // What the element of this name, written anyhow, is called in the experiment.
  const std::string& element(const std::string& name, const std::string& prefix, int line) const {
    const auto found = names_.find(prefix + name);
    if (found == names_.end())
      throw LineError{line, "needs the element " + name + ", which does not stand before it"};
    return found->second;
  }

  void add_element(const Line& line, const std::string& prefix, const NodeMap& map,
                   const Scope& scope) {
    const char type = line.words[0][0];
    const bool is_source = type == 'v' || type == 'i';
    const Card card = is_source ? Card{&line, line.words, {}} : card_of(line);
    if (type == 'x') return add_instance(card, prefix, map, scope);
    const std::string name = identifier(prefix + line.written[0]);
    const auto nodes = [&](std::size_t first) {
      return std::pair(node(card.word(first, "node"), prefix, map),
                       node(card.word(first + 1, "second node"), prefix, map));
    };
    const auto value = [&](std::size_t i) {
      return formula(card.word(i, "value"), scope, line.number);
    };
    Json element = {{"type", ""}, {"name", name}};
    const auto between = [&] {
      const auto [from, to] = nodes(1);
      element["from"] = from;
      element["to"] = to;
    };
    switch (type) {
      case 'r':
        element["type"] = "resistor";
        between();
        element["value"] = written_value(value(3));
        break;
      case 'c':
      case 'l': {
        const bool is_capacitor = type == 'c';
        element["type"] = is_capacitor ? "capacitor" : "inductor";
        between();
        element["value"] = written_value(value(3));
        std::optional<std::string> given;
        if (const auto ic = card.value("ic")) given = formula(*ic, scope, line.number);
        storages_.push_back({name, (is_capacitor ? "q_" : "phi_") + name, value(3), element["from"],
                             element["to"], is_capacitor, given});
        break;
      }
      case 'v':
      case 'i':
        element["type"] = type == 'v' ? "voltage-source" : "current-source";
        between();
        element["value"] = written_value(
            source({card.words.begin() + 3, card.words.end()}, scope, times_, line.number));
        formulas_.push_back(element["value"]);
        if (type == 'v' && prefix.empty()) sources_.push_back(name);
        break;
      case 'k':
        element["type"] = "mutual-inductance";
        element["inductors"] = {
            this->element(card.word(1, "inductor"), prefix, line.number),
            this->element(card.word(2, "second inductor"), prefix, line.number)};
        element["coupling"] = written_value(value(3));
        break;
      case 'd': {
        element["type"] = "diode";
        between();
        const auto model = models_.find(card.word(3, "model"));
        if (model == models_.end())
          throw LineError{line.number, "unknown model \"" + card.words[3] + "\""};
        std::string saturation = formula(model->second.saturation, scope, line.number);
        if (card.words.size() > 4) saturation += "*" + value(4);
        element["saturation"] = written_value(saturation);
        element["emission"] = written_value(formula(model->second.emission, scope, line.number));
        element["thermal_voltage"] = kThermalVoltage;
        element["leak"] = kLeastConductance;
        break;
      }
      case 'e':
      case 'g': {
        element["type"] = type == 'e' ? "voltage-source" : "current-source";
        between();
        if (card.words.size() != 6)
          throw LineError{line.number,
                          "only linear sources are supported; expected four nodes and "
                          "a number"};
        const auto [plus, minus] = nodes(3);
        const std::string difference = minus == "0" ? "potential_" + plus
                                       : plus == "0"
                                           ? "(-potential_" + minus + ")"
                                           : "(potential_" + plus + " - potential_" + minus + ")";
        element["value"] = value(5) + "*" + difference;
        break;
      }
      case 'f':
      case 'h':
        element["type"] = type == 'h' ? "voltage-source" : "current-source";
        between();
        if (card.words.size() != 5)
          throw LineError{line.number,
                          "only linear sources are supported; expected two nodes, a "
                          "source and a number"};
        element["value"] = value(4) + "*i_" + this->element(card.words[3], prefix, line.number);
        break;
      default:
        throw LineError{line.number, "the element " + line.written[0] +
                                         " is not supported; expected R, L, C, V, I, K, D, E, F, "
                                         "G, H or X"};
    }
    names_[prefix + line.words[0]] = name;
    elements_.push_back(element);
  }

  void add_instance(const Card& card, const std::string& prefix, const NodeMap& map,
                    const Scope& scope) {
    const int line = card.line->number;
    std::vector<std::string> words = card.words;
    std::erase(words, "params:");
    if (words.size() < 2) throw LineError{line, "has no subcircuit; expected one"};
    const auto found = subcircuits_.find(words.back());
    if (found == subcircuits_.end())
      throw LineError{line, "unknown subcircuit \"" + words.back() + "\""};
    const Subcircuit& part = found->second;
    if (words.size() - 2 != part.nodes.size())
      throw LineError{line, "has " + std::to_string(words.size() - 2) + " nodes; the subcircuit " +
                                words.back() + " has " + std::to_string(part.nodes.size())};
    if (std::count(prefix.begin(), prefix.end(), '.') > 20)
      throw LineError{line, "the subcircuit " + words.back() + " contains itself"};
    NodeMap inner;
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      inner[part.nodes[i]] = node(words[i + 1], prefix, map);
    const std::string inside = prefix + words[0] + ".";
    Scope known = scope;
    Assignments values = part.parameters;
    for (auto& [name, value] : values)
      if (const auto given = card.value(name)) value = *given;
    define(known, inside, values, line);
    expand(part.lines, inside, inner, known);
  }

  // Whether all sources are 0 at the start: the states are 0 then.
  bool starts_at_rest() const {
    SymbolTable symbols;
    symbols.add("t", 0.0);
    const auto value = [&](const Json& formula) {
      return formula.is_number() ? formula.get<double>()
                                 : parse_formula(formula.get<std::string>(), symbols).value();
    };
    try {
      for (const auto& [name, formula] : parameter_values_.items())
        symbols.add(name, value(formula));
      return std::all_of(formulas_.begin(), formulas_.end(),
                         [&](const Json& formula) { return value(formula) == 0.0; });
    } catch (const FormulaError&) {  // which the reader of the experiment tells
      return false;
    }
  }

  // States: from `ic` and `.ic`, 0 with uic; otherwise their rates are 0.
  Json initial() const {
    Json initial = Json::object();
    const bool all_zero = from_given_ || starts_at_rest();
    for (const Storage& storage : storages_) {
      std::optional<std::string> given = from_given_ ? storage.given : std::nullopt;
      const auto potential = [&](const std::string& node) -> std::optional<std::string> {
        if (node == "0") return "0";
        const auto found = given_.find(node);
        if (found == given_.end()) return std::nullopt;
        return formula(found->second, global_, given_line_);
      };
      const auto from = potential(storage.from), to = potential(storage.to);
      if (!given && storage.is_capacitor && from && to)
        given = *to == "0" ? *from : "(" + *from + " - " + *to + ")";
      if (given)
        initial[storage.state] = written_value(storage.value + "*" + *given);
      else if (all_zero)
        initial[storage.state] = 0;
      else
        initial[storage.state + "'"] = 0;
    }
    return initial;
  }

  std::string title_;
  std::vector<Problem> problems_;
  std::vector<Line> lines_;
  std::map<std::string, Subcircuit> subcircuits_;
  std::map<std::string, DiodeModel> models_;
  Assignments parameters_;
  Json parameter_values_ = Json::object();
  Scope global_;
  Times times_;
  double largest_step_ = 0.0;
  bool from_given_ = false;
  std::map<std::string, std::string> given_;  // potentials of nodes
  int given_line_ = 0;
  Json nodes_ = Json::array({"0"}), elements_ = Json::array();
  std::map<std::string, std::string> names_;
  std::vector<std::string> sources_;
  std::vector<Json> formulas_;  // of sources
  std::vector<Storage> storages_;
};

}  // namespace

Json import_netlist(std::string_view text) { return Import(text).experiment(); }

}  // namespace courant
