// Diodes and switches.
#include <algorithm>
#include <cmath>

#include "courant/core/words/message.hpp"
#include "courant/extensions/spice/netlist_circuit_reader.hpp"

namespace courant::netlist {
void CircuitReader::add_diode(const Card& card, const Part& part, const std::string& prefix,
                              const NodeMap& map, const Scope& scope) {
  const int line = card.line->number;
  Named& named = names_.at(prefix + card.words[0]);
  const auto number_of = [&](const std::string& formula) {
    return circuit_.value_of(formula, line);
  };
  OwnJunction junction{.name = named.name};
  junction.from = node(card.word(1, "node"), prefix, map, line);
  junction.to = node(card.word(2, "second node"), prefix, map, line);
  const UsedModel used = model(card.word(3, "model"), {"d"}, part, scope, line);
  allow(used, {"is", "n", "rs", "cjo", "cj0", "cj", "tt", "bv", "ibv", "vj", "pb", "m", "mj", "fc"},
        {"tnom", "tref", "eg",  "xti",  "kf",  "af",   "nbv",      "level",
         "trs",  "trs1", "mfg", "iave", "vpk", "type", "icrating", "vrev",
         "irms", "cta",  "ctc", "trs2", "tm1", "tm2",  "tbv1"});
  const bool is_off = card.words.back() == "off";  // where SPICE is to begin its search
  const bool has_area = card.words.size() > (is_off ? 5u : 4u) || card.value("area");
  card.allow(4 + (has_area ? 1u : 0u) + (is_off ? 1u : 0u), {"area", "ic", "temp", "m"});
  std::string area;
  if (has_area) area = formula(card.value_of(4, "area"), scope, line);
  if (const auto m = card.value("m")) area += (area.empty() ? "" : "*") + formula(*m, scope, line);
  const auto per_area = [&](const std::string& value) {
    return area.empty() ? value : value + "*" + area;
  };
  const auto first_of = [&](std::initializer_list<const char*> keys, const char* otherwise) {
    for (const char* key : keys)
      if (used.model->values.contains(key)) return used.formula(key, otherwise);
    return std::string(otherwise);
  };
  junction.saturation = per_area(used.formula("is", "1e-14"));
  junction.emission = used.formula("n", "1");
  junction.leak = kLeastConductance;
  if (used.model->values.contains("bv")) {
    junction.breakdown = exact_text(std::abs(number_of(used.formula("bv", "0"))));
    junction.breakdown_current = per_area(used.formula("ibv", "1e-3"));
  }
  junction.capacitance = per_area(first_of({"cjo", "cj0", "cj"}, "0"));
  junction.transit = used.formula("tt", "0");
  junction.voltage = first_of({"vj", "pb"}, "1");
  junction.grading = first_of({"m", "mj"}, "0.5");
  junction.forward = used.formula("fc", "0.5");
  // The series resistance, with a node of its own behind it.
  const std::string series = used.formula("rs", "0");
  junction.from = behind_resistance(
      junction.from, area.empty() ? series : "(" + series + ")/(" + area + ")",
      prefix + card.line->written[0] + "_rs", line, prefix + card.words[0] + "_inside");
  named.entry = circuit_.elements.size();
  named.element = add_junction(junction, line);
}

void CircuitReader::add_switch(const Card& card, const Part& part, const std::string& prefix,
                               const NodeMap& map, const Scope& scope) {
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
  }
  const bool has_memory = !used.model->values.contains(on) && !used.model->values.contains(off) &&
                          circuit_.value_of(half, line) > 0.0;
  double width = circuit_.value_of(half, line);
  if (width == 0.0) {
    width = 1e-3 * std::max(std::abs(circuit_.value_of(middle, line)), 1e-3);
    half = exact_text(width);
  }
  NetlistSwitch hysteresis;
  std::string source;
  if (by_voltage) {
    hysteresis.plus = node(card.word(3, "node"), prefix, map, line);
    hysteresis.minus = node(card.word(4, "node"), prefix, map, line);
    hysteresis.control = difference(hysteresis.plus, hysteresis.minus);
  } else {
    source = reference(card.word(3, "source"), 'v', prefix, line);
    hysteresis.control = "i_" + names_.at(source).name;
  }
  const std::string& control = hysteresis.control;
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
  if (has_memory) {
    hysteresis.name = named.name;
    hysteresis.low = "(" + middle + " - (" + half + "))";
    hysteresis.high = "(" + middle + " + (" + half + "))";
    hysteresis.begins_on = card.words.back() == "on";
    if (!by_voltage) switch_controls_.emplace_back(circuit_.switches.size(), source);
    named.entry = circuit_.elements.size();
    named.element = circuit_.fixed.elements.size();
    return add_hysteresis(hysteresis, std::move(element), fixed, off_value, on_value, line);
  }
  const std::string conductance =
      "exp(-log(" + off_value + ") + log((" + off_value + ")/(" + on_value + "))*" + smooth + ")";
  law_of(element, fixed, difference(fixed.from, fixed.to) + "*" + conductance, prefix, line);
  element.erase("value");
  element["current"] = "v_" + named.name + "*" + conductance;
  named.entry = circuit_.elements.size();
  named.element = put(element, fixed, line);
}

void CircuitReader::add_hysteresis(const NetlistSwitch& hysteresis, Json element,
                                   const StaticElement& fixed, const std::string& off,
                                   const std::string& on, int line) {
  NetlistSwitch& made = circuit_.switches.emplace_back(hysteresis);
  made.off = circuit_.value_of(off, line);
  made.on = circuit_.value_of(on, line);
  made.below = circuit_.value_of(made.low, line);
  made.above = circuit_.value_of(made.high, line);
  made.element = circuit_.fixed.elements.size();
  circuit_.at_rest = circuit_.at_rest && !made.begins_on && made.above >= 0.0;
  const std::string memory = names_of_elements_.of(made.name + "_on");
  made.state = "q_" + memory;
  element["current"] = "v_" + made.name + "/if(" + made.state + " > 0.5, " + on + ", " + off + ")";
  StaticElement resistor = fixed;
  resistor.kind = StaticElement::Kind::resistor;
  resistor.value = made.begins_on ? made.on : made.off;
  put(element, resistor, line);
  const std::size_t own = made.memory = own_node(memory, line);
  put({{"type", "capacitor"},
       {"name", memory},
       {"from", circuit_.nodes[own]},
       {"to", circuit_.nodes[0]},
       {"energy", "0"}},
      {.kind = StaticElement::Kind::capacitor, .from = own, .value = 1.0}, line);
}

}  // namespace courant::netlist
