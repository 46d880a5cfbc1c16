// Bipolar transistors and those of level 1 with an insulated gate.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "courant/core/expressions/function.hpp"
#include "courant/core/words/message.hpp"
#include "courant/extensions/spice/netlist_circuit_reader.hpp"
#include "courant/structures/elements/bipolar_transistor.hpp"
#include "courant/structures/elements/mos_channel.hpp"

namespace courant::netlist {
namespace {

// ε of silicon and of its oxide in F/m, the charge of an electron in C, intrinsic carriers of silicon in 1/m³, and its band gap at 27 °C in V, as SPICE
// has them.
constexpr double kSilicon = 11.7 * 8.854214871e-12, kOxide = 3.9 * 8.854214871e-12;
constexpr double kElectron = 1.6021918e-19, kIntrinsic = 1.45e16, kGap = 1.1150877;

// f(u) with its gradient.
std::shared_ptr<StaticLaw> law_from(std::vector<StaticLaw::Control> controls,
                                    const std::function<Expr(const ExprVector& u)>& value) {
  Graph graph;
  const ExprVector u = graph.variables("u", std::ssize(controls));
  const Function function("law", {{"u", u}}, ExprVector{{value(u)}}, {.differentiate = {"u"}});
  const auto law = std::make_shared<StaticLaw>();
  law->controls = std::move(controls);
  law->value = [function](const VectorXd& at) {
    return std::pair(function({at})[0], VectorXd(function.jacobian({at}).row(0)));
  };
  return law;
}

// What a model without `key` says: 0 stands for a missing one.
struct Numbers {
  const NetlistCircuit& circuit;
  int line;
  double operator()(const std::string& formula) const { return circuit.value_of(formula, line); }
};

}  // namespace

std::size_t CircuitReader::behind_resistance(std::size_t node, const std::string& resistance,
                                             const std::string& name, int line, std::string place) {
  const double value = circuit_.value_of(resistance, line);
  if (!(value > 0.0)) return node;
  if (place.empty()) place = name + "_inside";
  for (char& c : place) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::size_t inside = own_node(place, line);
  circuit_.terminals[inside] = node;
  add_own("resistor", name, node, inside, resistance,
          {.kind = StaticElement::Kind::resistor, .value = value}, line);
  return inside;
}

void CircuitReader::add_bipolar(const Card& card, const Part& part, const std::string& prefix,
                                const NodeMap& map, const Scope& scope) {
  const int line = card.line->number;
  Named& named = names_.at(prefix + card.words[0]);
  const Numbers number_of{circuit_, line};
  const auto is_model = [&](const std::string& word) {
    return find_model(word, part, scope).model != nullptr;
  };
  std::size_t place =
      4;  // of the model: behind three nodes, that of the substrate, and one for heat
  while (place < 6 && !is_model(card.word(place, "model")) && card.words.size() > place + 1)
    ++place;
  if (place == 6) throw LineError{line, "has a node for heat, which is not supported"};
  const UsedModel used = model(card.words[place], {"npn", "pnp"}, part, scope, line);
  allow(used, {"is",  "bf",  "br",  "nf",   "nr",  "vaf", "va",  "var",  "vb",   "ikf",
               "ik",  "ikr", "ise", "ne",   "isc", "nc",  "rb",  "rbm",  "re",   "rc",
               "cje", "vje", "pe",  "mje",  "me",  "cjc", "vjc", "pc",   "mjc",  "mc",
               "cjs", "ccs", "vjs", "ps",   "mjs", "ms",  "fc",  "tf",   "tr",   "xtf",
               "vtf", "itf", "ptf", "xcjc", "irb", "c2",  "c4",  "subs", "level"},
        {"tnom", "tref", "eg", "xti", "xtb", "kf", "af", "iss", "ns", "vceo", "icrating", "mfg",
         "type", "trb1", "trc1", "tre1", "nk"});
  if (number_of(used.formula("level", "1")) > 1.0)
    throw LineError{used.model->line, "a bipolar model of level " + used.formula("level", "1") +
                                          " is not supported; expected level 1"};
  std::size_t words = card.words.size();
  if (words > place + 1 && card.words.back() == "off") --words;
  const bool has_area = words > place + 1 || card.value("area");
  card.allow(place + (has_area && words > place + 1 ? 2 : 1) + (card.words.size() - words),
             {"area", "ic", "temp", "dtemp", "m", "areab", "areac", "off"});
  std::string area = has_area ? formula(card.value_of(place + 1, "area"), scope, line) : "";
  if (const auto m = card.value("m")) area += (area.empty() ? "" : "*") + formula(*m, scope, line);
  const auto per_area = [&](const std::string& value) {
    return area.empty() ? value : value + "*" + area;
  };
  const auto over_area = [&](const std::string& value) {
    return area.empty() ? value : "(" + value + ")/(" + area + ")";
  };
  const auto first_of = [&](std::initializer_list<const char*> keys, const char* otherwise) {
    for (const char* key : keys)
      if (used.model->values.contains(key)) return used.formula(key, otherwise);
    return std::string(otherwise);
  };
  std::vector<std::string> left_out;
  for (const char* key : {"xtf", "ptf", "irb"})
    if (number_of(used.formula(key, "0")) != 0.0) left_out.emplace_back(key);
  if (number_of(used.formula("xcjc", "1")) != 1.0) left_out.emplace_back("xcjc");
  if (!left_out.empty())
    circuit_.notes.emplace_back(
        line, in_words(left_out) + " of its model " + (left_out.size() == 1 ? "is" : "are") +
                  " left out: transit times and the resistance of the base are constant here");

  const bool is_pnp = used.model->type == "pnp";
  const std::string own = prefix + card.line->written[0];
  const std::size_t collector =
      behind_resistance(node(card.word(1, "collector"), prefix, map, line),
                        over_area(used.formula("rc", "0")), own + "_rc", line);
  const std::size_t base = behind_resistance(node(card.word(2, "base"), prefix, map, line),
                                             over_area(used.formula("rb", "0")), own + "_rb", line);
  const std::size_t emitter =
      behind_resistance(node(card.word(3, "emitter"), prefix, map, line),
                        over_area(used.formula("re", "0")), own + "_re", line);
  const std::size_t substrate = place == 5 ? node(card.words[4], prefix, map, line) : 0;

  const std::string saturation = per_area(first_of({"is"}, "1e-16"));
  Json element = {{"type", "bipolar-transistor"},
                  {"name", named.name},
                  {"collector", circuit_.nodes[collector]},
                  {"base", circuit_.nodes[base]},
                  {"emitter", circuit_.nodes[emitter]},
                  {"polarity", used.model->type},
                  {"saturation", written_value(saturation)},
                  {"thermal_voltage", kThermalVoltage},
                  {"leak", kLeastConductance}};
  const auto say = [&](const char* key, const std::string& value, const char* otherwise) {
    if (value != otherwise) element[key] = written_value(value);
    return number_of(value);
  };
  elements::BipolarTransistor law;
  law.saturation = number_of(saturation);
  law.forward_gain = say("forward_gain", first_of({"bf"}, "100"), "100");
  law.reverse_gain = say("reverse_gain", first_of({"br"}, "1"), "1");
  law.forward_scale = kThermalVoltage * say("forward_emission", first_of({"nf"}, "1"), "1");
  law.reverse_scale = kThermalVoltage * say("reverse_emission", first_of({"nr"}, "1"), "1");
  const auto leak = [&](const char* key, const char* by_part) {
    if (used.model->values.contains(by_part) && !used.model->values.contains(key))
      return "(" + used.formula(by_part, "0") + ")*" + saturation;
    return number_of(used.formula(key, "0")) == 0.0 ? std::string("0")
                                                    : per_area(used.formula(key, "0"));
  };
  law.emitter_leak.saturation = say("emitter_leak", leak("ise", "c2"), "0");
  law.emitter_leak.scale =
      kThermalVoltage * say("emitter_leak_emission", first_of({"ne"}, "1.5"), "1.5");
  law.collector_leak.saturation = say("collector_leak", leak("isc", "c4"), "0");
  law.collector_leak.scale =
      kThermalVoltage * say("collector_leak_emission", first_of({"nc"}, "2"), "2");
  law.early_forward = say("early_forward", first_of({"vaf", "va"}, "0"), "0");
  law.early_reverse = say("early_reverse", first_of({"var", "vb"}, "0"), "0");
  const auto knee = [&](std::initializer_list<const char*> keys) {
    const std::string value = first_of(keys, "0");
    return number_of(value) == 0.0 ? std::string("0") : per_area(value);
  };
  law.knee_forward = say("knee_forward", knee({"ikf", "ik"}), "0");
  law.knee_reverse = say("knee_reverse", knee({"ikr"}), "0");
  law.leak = kLeastConductance;

  // For direct currents: what goes through the base by diodes, the rest by a law of their voltages.
  const auto junction = [&](std::size_t other, double saturated, double scale, double beside) {
    return add_static({.kind = StaticElement::Kind::diode,
                       .from = is_pnp ? other : base,
                       .to = is_pnp ? base : other,
                       .value = saturated,
                       .scale = scale,
                       .leak = beside},
                      named.name, line);
  };
  const std::size_t e =
      junction(emitter, law.saturation / law.forward_gain, law.forward_scale, kLeastConductance);
  const std::size_t c =
      junction(collector, law.saturation / law.reverse_gain, law.reverse_scale, kLeastConductance);
  if (law.emitter_leak.saturation > 0.0)
    junction(emitter, law.emitter_leak.saturation, law.emitter_leak.scale, 0.0);
  if (law.collector_leak.saturation > 0.0)
    junction(collector, law.collector_leak.saturation, law.collector_leak.scale, 0.0);
  StaticElement through{.kind = StaticElement::Kind::current};
  through.from = is_pnp ? emitter : collector;
  through.to = is_pnp ? collector : emitter;
  through.law = law_from({{.junction = e}, {.junction = c}},
                         [&](const ExprVector& u) { return law.transport(u[0], u[1]); });
  named.element = add_static(through, named.name, line);

  const std::string forward = first_of({"fc"}, "0.5");
  say("forward", forward, "0.5");
  const auto charge = [&](const std::string& at, const char* state, std::size_t of,
                          const std::string& capacitance, const std::string& voltage,
                          const std::string& grading, const std::string& transit,
                          const char* transit_key, double scale, std::size_t other) {
    if (other == base || !(number_of(capacitance) > 0.0 || number_of(transit) > 0.0)) return;
    element[at + "_capacitance"] = written_value(capacitance);
    element[at + "_junction"] = written_value(voltage);
    element[at + "_grading"] = written_value(grading);
    element[transit_key] = written_value(transit);
    circuit_.junctions.push_back({state + named.name,
                                  of,
                                  {.capacitance = number_of(capacitance),
                                   .junction = number_of(voltage),
                                   .grading = number_of(grading),
                                   .forward = number_of(forward),
                                   .transit = number_of(transit),
                                   .saturation = law.saturation,
                                   .scale = scale,
                                   .leak = kLeastConductance}});
  };
  charge("emitter", "q_be_", e, per_area(first_of({"cje"}, "0")), first_of({"vje", "pe"}, "0.75"),
         first_of({"mje", "me"}, "0.33"), first_of({"tf"}, "0"), "forward_transit",
         law.forward_scale, emitter);
  charge("collector", "q_bc_", c, per_area(first_of({"cjc"}, "0")), first_of({"vjc", "pc"}, "0.75"),
         first_of({"mjc", "mc"}, "0.33"), first_of({"tr"}, "0"), "reverse_transit",
         law.reverse_scale, collector);
  const double transit = number_of(first_of({"tf"}, "0"));
  if (auto& all = circuit_.junctions;
      all.size() > 1 && all.back().element == c && all[all.size() - 2].element == e) {
    all.back().other = e;
    all.back().more = [law, transit](double v_c, double v_e) {
      return law.widening(transit, v_e, v_c).at_collector.value();
    };
    all[all.size() - 2].other = c;
    all[all.size() - 2].more = [law, transit](double v_e, double v_c) {
      return law.widening(transit, v_e, v_c).at_emitter.value();
    };
  }
  named.entry = circuit_.elements.size();
  circuit_.elements.push_back(element);
  circuit_.element_lines.push_back(line);

  // Of a vertical transistor at its collector, of a lateral one at its base.
  const std::string to_substrate = per_area(first_of({"cjs", "ccs"}, "0"));
  if (number_of(to_substrate) > 0.0) {
    const bool is_lateral =
        used.model->values.contains("subs") ? number_of(used.formula("subs", "1")) < 0.0 : is_pnp;
    const std::size_t at = is_lateral ? base : collector;
    add_junction({.name = names_of_elements_.of(own + "_substrate"),
                  .from = is_pnp != is_lateral ? at : substrate,
                  .to = is_pnp != is_lateral ? substrate : at,
                  .saturation = "0",
                  .capacitance = to_substrate,
                  .voltage = first_of({"vjs", "ps"}, "0.75"),
                  .grading = first_of({"mjs", "ms"}, "0"),
                  .forward = "0"},
                 line);
  }
}

std::optional<std::size_t> CircuitReader::add_junction(const OwnJunction& junction, int line) {
  if (junction.from == junction.to) return std::nullopt;
  const Numbers number_of{circuit_, line};
  StaticElement fixed{.kind = StaticElement::Kind::diode,
                      .from = junction.from,
                      .to = junction.to,
                      .value = number_of(junction.saturation),
                      .scale = number_of(junction.emission) * kThermalVoltage,
                      .leak = junction.leak};
  Json element = {{"type", "diode"},
                  {"name", junction.name},
                  {"from", circuit_.nodes[junction.from]},
                  {"to", circuit_.nodes[junction.to]},
                  {"saturation", written_value(junction.saturation)},
                  {"emission", written_value(junction.emission)},
                  {"thermal_voltage", kThermalVoltage},
                  {"leak", junction.leak}};
  if (junction.breakdown != "0") {
    fixed.breakdown_voltage = number_of(junction.breakdown);
    fixed.breakdown = number_of(junction.breakdown_current);
    element["breakdown"] = written_value(junction.breakdown);
    element["breakdown_current"] = written_value(junction.breakdown_current);
  }
  const elements::JunctionCharge charge{.capacitance = number_of(junction.capacitance),
                                        .junction = number_of(junction.voltage),
                                        .grading = number_of(junction.grading),
                                        .forward = number_of(junction.forward),
                                        .transit = number_of(junction.transit),
                                        .saturation = fixed.value,
                                        .scale = fixed.scale,
                                        .leak = fixed.leak};
  if (charge.capacitance > 0.0 || charge.transit > 0.0) {
    element["capacitance"] = written_value(junction.capacitance);
    element["transit"] = written_value(junction.transit);
    element["junction"] = written_value(junction.voltage);
    element["grading"] = written_value(junction.grading);
    element["forward"] = written_value(junction.forward);
    circuit_.junctions.push_back({"q_" + junction.name, circuit_.fixed.elements.size(), charge});
  }
  return put(element, fixed, line);
}

void CircuitReader::add_mos(const Card& card, const Part& part, const std::string& prefix,
                            const NodeMap& map, const Scope& scope) {
  const int line = card.line->number;
  Named& named = names_.at(prefix + card.words[0]);
  const Numbers number_of{circuit_, line};
  // Other kinds have other numbers of nodes.
  const auto is_model = [&](std::size_t k) {
    return k < card.words.size() && find_model(card.words[k], part, scope).model;
  };
  for (std::size_t k = 4; k < 9 && !is_model(5); ++k)
    if (is_model(k)) model(card.words[k], {"nmos and pmos, with four nodes"}, part, scope, line);
  const UsedModel used = model(card.word(5, "model"), {"nmos", "pmos"}, part, scope, line);
  if (number_of(used.formula("level", "1")) != 1.0)
    throw LineError{used.model->line, "a model of level " + used.formula("level", "1") +
                                          " is not supported; expected level 1"};
  allow(
      used, {"vto", "vt0", "kp",   "gamma", "phi",  "lambda", "rd", "rs", "rsh",  "cbd",
             "cbs", "is",  "pb",   "cgso",  "cgdo", "cgbo",   "cj", "mj", "cjsw", "mjsw",
             "js",  "tox", "nsub", "nss",   "tpg",  "ld",     "uo", "u0", "fc",   "level"},
      {"tnom",  "tref",  "kf",  "af",    "xj",  "n", "nfs", "ucrit", "uexp", "utra", "vmax", "neff",
       "delta", "theta", "eta", "kappa", "xqc", "w", "l",   "wd",    "bv",   "imax", "imelt"});
  const bool is_off = card.words.back() == "off";
  card.allow(is_off ? 7 : 6,
             {"l", "w", "ad", "as", "pd", "ps", "nrd", "nrs", "m", "temp", "dtemp", "ic"});
  const auto on_card = [&](const char* key, const char* otherwise) {
    const auto given = card.value(key);
    return given ? formula(*given, scope, line) : std::string(otherwise);
  };
  const auto of_model = [&](const char* key) { return number_of(used.formula(key, "0")); };
  const auto is_given = [&](const char* key) { return used.model->values.contains(key); };
  const bool is_p = used.model->type == "pmos";
  const double sign = is_p ? -1.0 : 1.0;
  const double multiple = number_of(on_card("m", "1"));

  elements::MosChannel channel;
  const double oxide = of_model("tox") > 0.0 ? kOxide / of_model("tox") : 0.0;  // F/m²
  channel.surface = is_given("phi") ? of_model("phi") : 0.6;
  channel.body = of_model("gamma");
  channel.threshold = sign * (is_given("vto") ? of_model("vto") : of_model("vt0"));
  double per_square = is_given("kp") ? of_model("kp") : 2e-5;
  if (oxide > 0.0 && !is_given("kp")) {
    const double mobility = is_given("uo")   ? of_model("uo")
                            : is_given("u0") ? of_model("u0")
                                             : 600.0;
    per_square = mobility * 1e-4 * oxide;
  }
  // From how the substrate is doped, as in MOS1temp of SPICE.
  const double doping = of_model("nsub") * 1e6;  // 1/m³
  if (oxide > 0.0 && doping > kIntrinsic) {
    if (!is_given("phi"))
      channel.surface = std::max(0.1, 2.0 * kThermalVoltage * std::log(doping / kIntrinsic));
    if (!is_given("gamma")) channel.body = std::sqrt(2.0 * kSilicon * kElectron * doping) / oxide;
    if (!is_given("vto") && !is_given("vt0")) {
      const double gate = is_given("tpg") ? of_model("tpg") : 1.0;
      const double work = gate == 0.0 ? 3.2 : 3.25 + 0.5 * kGap - sign * gate * 0.5 * kGap;
      const double flat = work - (3.25 + 0.5 * kGap + sign * 0.5 * channel.surface) -
                          of_model("nss") * 1e4 * kElectron / oxide;
      channel.threshold = sign * flat + channel.body * std::sqrt(channel.surface) + channel.surface;
    }
  }
  channel.modulation = of_model("lambda");
  const double width = number_of(on_card("w", "1e-4")) * multiple,
               length = number_of(on_card("l", "1e-4")) - 2.0 * of_model("ld");
  if (!(length > 0.0))
    throw LineError{line, "has a channel without length: l less twice ld is " + exact_text(length)};
  channel.transconductance = per_square * width / length;

  const std::string own = prefix + card.line->written[0];
  const auto terminal = [&](std::size_t i, const char* what) {
    return node(card.word(i, what), prefix, map, line);
  };
  const auto series = [&](const char* key, const char* squares) {
    const double sheet = of_model("rsh") * number_of(on_card(squares, "1"));
    return exact_text((is_given(key) ? of_model(key) : sheet) / multiple);
  };
  const std::size_t drain =
      behind_resistance(terminal(1, "drain"), series("rd", "nrd"), own + "_rd", line);
  const std::size_t gate = terminal(2, "gate");
  const std::size_t source =
      behind_resistance(terminal(3, "source"), series("rs", "nrs"), own + "_rs", line);
  const std::size_t bulk = terminal(4, "bulk");

  const auto constant = [](double value) { return Json(value); };
  Json element = {{"type", "mos-transistor"},
                  {"name", named.name},
                  {"drain", circuit_.nodes[drain]},
                  {"gate", circuit_.nodes[gate]},
                  {"source", circuit_.nodes[source]},
                  {"bulk", circuit_.nodes[bulk]},
                  {"polarity", is_p ? "p" : "n"},
                  {"threshold", constant(sign * channel.threshold)},
                  {"transconductance", constant(per_square)},
                  {"width", constant(width)},
                  {"length", constant(length)}};
  if (channel.modulation != 0.0) element["modulation"] = channel.modulation;
  if (channel.body != 0.0) {
    element["body"] = channel.body;
    element["surface"] = channel.surface;
  }
  StaticElement through{.kind = StaticElement::Kind::current, .from = drain, .to = source};
  through.law = law_from({{.node = drain}, {.node = gate}, {.node = source}, {.node = bulk}},
                         [&](const ExprVector& u) {
                           return sign * channel.current(sign * (u[1] - u[2]), sign * (u[0] - u[2]),
                                                         sign * (u[3] - u[2]));
                         });
  named.entry = circuit_.elements.size();
  named.element = put(element, through, line);

  const auto of_bulk = [&](std::size_t other, const char* area_key, const char* perimeter_key,
                           const char* whole_key, const std::string& suffix) {
    const double area = number_of(on_card(area_key, "0")) * multiple,
                 perimeter = number_of(on_card(perimeter_key, "0")) * multiple;
    const double dense = of_model("js");
    const double saturation = area == 0.0 || dense == 0.0
                                  ? (is_given("is") ? of_model("is") : 1e-14) * multiple
                                  : dense * area;
    const double voltage = is_given("pb") ? of_model("pb") : 0.8;
    const double flat = is_given("cj") || doping == 0.0
                            ? of_model("cj")
                            : std::sqrt(kSilicon * kElectron * doping / (2.0 * voltage));
    const double bottom = is_given(whole_key) ? of_model(whole_key) * multiple : flat * area;
    OwnJunction junction{.name = names_of_elements_.of(own + suffix),
                         .from = is_p ? other : bulk,
                         .to = is_p ? bulk : other,
                         .saturation = exact_text(saturation),
                         .capacitance = exact_text(bottom),
                         .voltage = exact_text(voltage),
                         .grading = used.formula("mj", "0.5"),
                         .forward = used.formula("fc", "0.5"),
                         .leak = kLeastConductance};
    add_junction(junction, line);
    if (const double side = of_model("cjsw") * perimeter; side > 0.0) {
      junction.name = names_of_elements_.of(own + suffix + "_side");
      junction.saturation = "0";
      junction.leak = 0.0;
      junction.capacitance = exact_text(side);
      junction.grading = used.formula("mjsw", "0.5");
      add_junction(junction, line);
    }
  };
  of_bulk(drain, "ad", "pd", "cbd", "_bulk_drain");
  of_bulk(source, "as", "ps", "cbs", "_bulk_source");

  const auto overlap = [&](std::size_t other, double capacitance, const std::string& suffix) {
    if (!(capacitance > 0.0) || other == gate) return;
    StaticElement fixed{.kind = StaticElement::Kind::capacitor};
    fixed.value = capacitance;
    const std::string name = names_of_elements_.of(own + suffix);
    circuit_.storages.push_back({name, "q_" + name, exact_text(capacitance),
                                 circuit_.fixed.elements.size(), true, std::nullopt, line});
    fixed.from = gate;
    fixed.to = other;
    put({{"type", "capacitor"},
         {"name", name},
         {"from", circuit_.nodes[gate]},
         {"to", circuit_.nodes[other]},
         {"value", capacitance}},
        fixed, line);
  };
  const double under_gate = oxide * width * length / 2.0;
  if (under_gate > 0.0)
    circuit_.notes.emplace_back(
        line,
        "the capacitance of the oxide is constant here, half of it to the source and half to "
        "the drain: Meyer's, which changes with both voltages, is that of no energy");
  overlap(source, of_model("cgso") * width + under_gate, "_gate_source");
  overlap(drain, of_model("cgdo") * width + under_gate, "_gate_drain");
  overlap(bulk, of_model("cgbo") * length * multiple, "_gate_bulk");
}

}  // namespace courant::netlist
