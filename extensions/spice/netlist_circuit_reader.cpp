#include "courant/extensions/spice/netlist_circuit_reader.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <tuple>

#include "courant/core/words/message.hpp"

namespace courant::netlist {
namespace {

// Elements, those of all instances of subcircuits. A few lines of nested ones make more than any
// memory holds.
constexpr std::size_t kMostElements = 100'000;
// How long an experiment goes on whose netlist does not say it, in s.
constexpr double kDefaultEnd = 1e-3;

std::set<std::string> words_in(const Deck& deck, bool as_written) {
  std::set<std::string> words;
  for (const Line& line : deck.lines)
    for (const std::string& word : as_written ? line.written : line.words) words.insert(word);
  return words;
}

// Of what is no model, as 4k7 where 4.7k is meant: simulators read 4 kΩ, 4.7 kΩ or nothing.
std::string number_that_is_meant(const std::string& word) {
  const std::size_t letter = word.find_first_not_of("0123456789");
  if (letter == 0 || letter == std::string::npos || letter + 1 == word.size() ||
      word.find_first_not_of("0123456789", letter + 1) != std::string::npos)
    return "";
  const std::string digits = word.substr(0, letter) + "." + word.substr(letter + 1);
  const std::string unit(1, word[letter]);
  if (unit == "r") return ", and no number; expected " + digits;
  if (unit == "m")
    return ", and no number; expected " + digits + "m for 10⁻³ or " + digits + "meg for 10⁶";
  if (!number("1" + unit) || number("1" + unit) == std::optional(1.0)) return "";
  return ", and no number; expected " + digits + unit;
}

bool mentions(const std::string& text, const std::string& name) {
  const auto is_of_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !is_of_name(text[at - 1])) && (end == text.size() || !is_of_name(text[end])))
      return true;
  }
  return false;
}

// Whether a subcircuit declares the parameter, or uses it.
bool mentions(const Part& part, const std::string& name) {
  const auto assigns = [&](const Assignment& each) {
    return each.name == name || mentions(each.value, name);
  };
  return std::ranges::any_of(part.header, assigns) ||
         std::ranges::any_of(part.parameters, assigns) ||
         std::ranges::any_of(part.elements,
                             [&](const Line& line) {
                               return std::ranges::any_of(line.words, [&](const std::string& word) {
                                 return mentions(word, name);
                               });
                             }) ||
         std::ranges::any_of(part.models, [&](const auto& model) {
           return std::ranges::any_of(model.second.values, [&](const auto& value) {
             return mentions(value.second, name);
           });
         });
}

}  // namespace

CircuitReader::CircuitReader(const Deck& deck, LineProblems& problems)
    : deck_(deck),
      problems_(problems),
      names_of_nodes_(words_in(deck, false)),
      names_of_elements_(words_in(deck, true)) {}

NetlistCircuit CircuitReader::read() {
  circuit_.values.add("t", 0.0);
  parameters_.define(global_, "", deck_.whole.parameters);
  if (deck_.transient)
    problems_.guard([&] { read_times(*deck_.transient); });
  else
    circuit_.times = {kDefaultEnd / 100.0, kDefaultEnd};
  circuit_.from_given = circuit_.from_given || deck_.from_given;
  expand(deck_.whole, "", {}, global_);
  if (problems_.empty()) problems_.guard([&] { connect(); });
  if (problems_.empty() && circuit_.storages.empty() && circuit_.junctions.empty() &&
      circuit_.switches.empty() && !circuit_.elements.empty())
    add_state();
  circuit_.scope = global_;
  return std::move(circuit_);
}

void CircuitReader::read_times(const Card& card) {
  const int line = card.line->number;
  std::vector<double> values;
  std::vector<std::string> options;  // of Gnucap: trace all, skip 2
  for (std::size_t i = 1; i < card.words.size(); ++i) {
    if (card.words[i] == "uic")
      circuit_.from_given = true;
    else if (!options.empty() || card.words[i] == "trace" || card.words[i] == "skip")
      options.push_back(card.words[i]);
    else
      values.push_back(circuit_.value_of(formula(card.words[i], global_, line), line));
  }
  const auto note = [&](const std::string& what) { circuit_.notes.emplace_back(line, what); };
  if (!options.empty()) {
    std::string words;
    for (const std::string& option : options) words += (words.empty() ? "" : " ") + option;
    note("\"" + words + "\" says what to show, and has no effect");
  }
  // Gnucap has the start first, which in SPICE is a step, and the end before a step.
  if (values.size() > 1 && values[0] == 0.0)
    values = {values.size() > 2 ? values[2] : values[1] / 100.0, values[1]};
  else if (values.size() == 2 && values[0] > values[1])
    std::swap(values[0], values[1]);
  if (values.size() < 2 || !(values[0] > 0.0) || !(values[1] > 0.0))
    throw LineError{line, "expected .tran step end, both greater than 0"};
  circuit_.times = {std::min(values[0], values[1]), values[1]};
  if (values.size() > 2 && values[2] > 0.0)
    note("rows begin at t = 0: that SPICE would show them from " + exact_text(values[2]) +
         " s on has no effect");
  if (values.size() > 3) circuit_.largest_step = values[3];
}

std::size_t CircuitReader::node(const std::string& name, const std::string& prefix,
                                const NodeMap& map, int line) {
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

void CircuitReader::expand(const Part& part, const std::string& prefix, const NodeMap& map,
                           const Scope& scope) {
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

std::string CircuitReader::reference(const std::string& name, char type, const std::string& prefix,
                                     int line) const {
  const std::string key = prefix + name;
  if (name[0] == type && names_.contains(key)) return key;
  throw LineError{line, std::string("needs the ") +
                            (type == 'v' ? "voltage source " : "inductor ") + name +
                            ", which is not there"};
}

CircuitReader::UsedModel CircuitReader::find_model(const std::string& name, const Part& part,
                                                   const Scope& scope) const {
  const DeviceModel* model = in_scope(part.path, [&](const std::string& path) {
    const Part& around = path.empty() ? deck_.whole : deck_.subcircuits.at(path);
    const auto found = around.models.find(name);
    return found == around.models.end() ? nullptr : &found->second;
  });
  const auto outside = deck_.whole.models.find(name);
  const bool is_outside = outside != deck_.whole.models.end() && model == &outside->second;
  return {model, is_outside ? &global_ : &scope};
}

CircuitReader::UsedModel CircuitReader::model(const std::string& name,
                                              const std::vector<std::string>& types,
                                              const Part& part, const Scope& scope,
                                              int line) const {
  const UsedModel found = find_model(name, part, scope);
  if (!found.model)
    throw LineError{line, "unknown model \"" + name + "\"" + number_that_is_meant(name)};
  if (std::ranges::find(types, found.model->type) == types.end())
    throw LineError{line, "the model " + name + " is of the type " + found.model->type +
                              "; expected " + in_words(types)};
  return found;
}

void CircuitReader::allow(const UsedModel& used, const std::set<std::string>& read,
                          const std::set<std::string>& without_effect) const {
  std::vector<std::string> wrong;
  for (const auto& [key, value] : used.model->values)
    if (!read.contains(key) && !without_effect.contains(key) && number(value) != std::optional(0.0))
      wrong.push_back(key);
  if (!wrong.empty())
    throw LineError{used.model->line,
                    std::string(wrong.size() == 1 ? "the parameter " : "the parameters ") +
                        in_words(wrong) + " of a model of the type " + used.model->type +
                        (wrong.size() == 1 ? " is" : " are") + " not supported"};
}

std::string CircuitReader::difference(std::size_t plus, std::size_t minus) const {
  const std::string from = "potential_" + circuit_.name_of(plus),
                    to = "potential_" + circuit_.name_of(minus);
  if (plus == minus) return "0";
  return minus == 0 ? from : plus == 0 ? "(-" + to + ")" : "(" + from + " - " + to + ")";
}

void CircuitReader::add_element(const Part& part, const Line& line, const std::string& prefix,
                                const NodeMap& map, const Scope& scope) {
  const char type = line.words[0][0];
  const bool is_source = type == 'v' || type == 'i' || type == 'b';
  const Card card = is_source ? Card{&line, line.words, {}} : card_of(line);
  card.word(0, "name");  // "m=0" assigns something, and names nothing
  if (type == 'x') return add_instance(card, part, prefix, map, scope);
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
  if (std::string_view("rcdigf").find(type) != std::string_view::npos) {
    const auto [from, to] = nodes(1);
    if (from == to) {
      circuit_.notes.emplace_back(line.number, named.name + " is passed over: both its ends are " +
                                                   "at the node " + card.words[1]);
      return;
    }
  }
  switch (type) {
    case 'r':
    case 'c':
    case 'l': {
      if (type == 'r' && depends_on_circuit(card)) {
        element["type"] = "resistor";
        fixed.kind = StaticElement::Kind::current;
        between();
        const std::string resistance =
            behaviour_of(card.words.size() > 3 ? card.words[3] : *card.value("r"), scope, prefix,
                         map, line.number);
        law_of(element, fixed, difference(fixed.from, fixed.to) + "/(" + resistance + ")", prefix,
               line.number);
        element["value"] = resistance;
        break;
      }
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
    case 'q':
      return add_bipolar(card, part, prefix, map, scope);
    case 'm':
      return add_mos(card, part, prefix, map, scope);
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
      } else if (third == "table" || third == "value" || card.value("value") || card.value("vol") ||
                 card.value("cur")) {
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
        const std::string by = reference(card.words[3], 'v', prefix, line.number), gain = value(4);
        element["value"] = gain + "*i_" + names_.at(by).name;
        fixed.gain = number_of(gain);
        controls_.emplace_back(circuit_.fixed.elements.size(), by);
      }
      break;
    }
    default:
      throw LineError{line.number, "the element " + line.written[0] +
                                       " is not supported; expected R, L, C, V, I, K, D, E, F, "
                                       "G, H, B, S, W, Q, M or X"};
  }
  named.element = put(element, fixed, line.number);
}

std::size_t CircuitReader::add_static(const StaticElement& fixed, const std::string& name,
                                      int line) {
  circuit_.fixed.elements.push_back(fixed);
  circuit_.names.push_back(name);
  circuit_.lines.push_back(line);
  return circuit_.fixed.elements.size() - 1;
}

std::size_t CircuitReader::put(const Json& element, const StaticElement& fixed, int line) {
  circuit_.elements.push_back(element);
  circuit_.element_lines.push_back(line);
  return add_static(fixed, element["name"].get<std::string>(), line);
}

std::string CircuitReader::size_by_geometry(const Card& card, const std::string& key,
                                            const UsedModel& used, const Scope& scope) {
  const int line = card.line->number;
  const auto side = [&](const char* name, const char* otherwise) {
    const auto given = card.value(name);
    const std::string size = given ? formula(*given, scope, line) : used.formula(otherwise, "0");
    return "(" + size + " - " + used.formula("narrow", "0") + ")";
  };
  const auto is_given = [&](const char* name) { return used.model->values.contains(name); };
  const bool has_length = card.value("l") || is_given("defl");
  if (key == "r" && is_given("rsh") && has_length && (card.value("w") || is_given("defw")))
    return "(" + used.formula("rsh", "0") + ")*" + side("l", "defl") + "/" + side("w", "defw");
  if (key == "c" && (is_given("cj") || is_given("cjsw")) && has_length &&
      (card.value("w") || is_given("defw"))) {
    const std::string l = side("l", "defl"), w = side("w", "defw");
    return "((" + used.formula("cj", "0") + ")*" + l + "*" + w + " + 2*(" +
           used.formula("cjsw", "0") + ")*(" + l + " + " + w + "))";
  }
  throw LineError{line, "has a model without a value of its own; expected a number"};
}

std::string CircuitReader::size_of(const Card& card, const std::string& key, const Part& part,
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
    if (card.words.size() > 4) {  // the value behind its model
      size = formula(card.words[4], scope, line);
      words = 5;
    } else if (card.value(key)) {
      size = formula(*card.value(key), scope, line);
    } else if (used.model->values.contains(key)) {
      size = used.formula(key, "0");
    } else {
      size = size_by_geometry(card, key, used, scope);
      std::erase(passed, "l");
      std::erase(passed, "w");
    }
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

std::size_t CircuitReader::own_node(const std::string& name, int line) {
  circuit_.nodes.push_back(names_of_nodes_.of(name));
  circuit_.node_lines.push_back(line);
  return circuit_.nodes.size() - 1;
}

void CircuitReader::add_own(const char* type, const std::string& name, std::size_t from,
                            std::size_t to, const std::string& value, StaticElement fixed,
                            int line) {
  fixed.from = from;
  fixed.to = to;
  put({{"type", type},
       {"name", names_of_elements_.of(name)},
       {"from", circuit_.nodes[from]},
       {"to", circuit_.nodes[to]},
       {"value", written_value(value)}},
      fixed, line);
}

void CircuitReader::add_instance(const Card& card, const Part& around, const std::string& prefix,
                                 const NodeMap& map, const Scope& scope) {
  const int line = card.line->number;
  if (names_.size() >= kMostElements)
    throw LineError{line,
                    "makes more than " + std::to_string(kMostElements) +
                        " elements of the netlist, with those of its subcircuits; expected fewer"};
  std::vector<std::string> words = card.words;
  std::erase(words, "params:");
  if (words.size() < 2) throw LineError{line, "has no subcircuit; expected one"};
  const std::string& name = words.back();
  const Part* found = in_scope(around.path, [&](const std::string& path) {
    const auto inner = deck_.subcircuits.find(path.empty() ? name : path + "/" + name);
    return inner == deck_.subcircuits.end() ? nullptr : &inner->second;
  });
  if (!found) throw LineError{line, "unknown subcircuit \"" + name + "\""};
  const Part& part = *found;
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
  for (const Assignments& list : {part.header, part.parameters})
    for (const Assignment& assignment : list)
      if (!card.value(assignment.name)) defaults.push_back(assignment);
  for (const Assignment& given : card.assigned) {
    if (!mentions(part, given.name))
      throw LineError{line, "the subcircuit " + name + " has no parameter " + given.name};
    parameters_.define(known, inside, given.name, formula(given.value, scope, line), line);
  }
  parameters_.define(known, inside, defaults);
  inside_.push_back(&part);
  expand(part, inside, inner, known);
  inside_.pop_back();
}

void CircuitReader::add_state() {
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

NetlistCircuit read_circuit(const Deck& deck, LineProblems& problems) {
  return CircuitReader(deck, problems).read();
}

}  // namespace courant::netlist
