#include <algorithm>

#include "courant/reading/element_parts.hpp"
#include "courant/structures/elements/transistors.hpp"

namespace courant {
namespace {

using namespace element_parts;

// Of each terminal the first that is at its node.
std::vector<Index> joined(const std::vector<NetworkTerminal>& terminals) {
  std::vector<Index> first;
  for (const NetworkTerminal& terminal : terminals)
    first.push_back(std::ranges::find(terminals, terminal.node, &NetworkTerminal::node) -
                    terminals.begin());
  return first;
}

std::optional<NetworkElement> read_bipolar(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double thermal = reader.positive("thermal_voltage");
  elements::BipolarTransistor law;
  law.saturation = reader.positive("saturation");
  law.forward_gain = reader.positive("forward_gain");
  law.reverse_gain = reader.positive("reverse_gain");
  law.forward_scale = thermal * reader.positive("forward_emission");
  law.reverse_scale = thermal * reader.positive("reverse_emission");
  law.emitter_leak = {reader.constant("emitter_leak"),
                      thermal * reader.positive("emitter_leak_emission")};
  law.collector_leak = {reader.constant("collector_leak"),
                        thermal * reader.positive("collector_leak_emission")};
  law.early_forward = reader.constant("early_forward");
  law.early_reverse = reader.constant("early_reverse");
  law.knee_forward = reader.constant("knee_forward");
  law.knee_reverse = reader.constant("knee_reverse");
  law.leak = reader.constant("leak");
  const double forward = reader.constant("forward");
  // `transit`: the key of its time; what is stored so grows with the current of this scale.
  const auto charge = [&](const std::string& junction, const char* transit, double scale) {
    return elements::JunctionCharge{.capacitance = reader.constant(junction + "_capacitance"),
                                    .junction = reader.positive(junction + "_junction"),
                                    .grading = reader.constant(junction + "_grading"),
                                    .forward = forward,
                                    .transit = reader.constant(transit),
                                    .saturation = law.saturation,
                                    .scale = scale,
                                    .leak = law.leak};
  };
  const elements::JunctionCharge at_emitter =
                                     charge("emitter", "forward_transit", law.forward_scale),
                                 at_collector =
                                     charge("collector", "reverse_transit", law.reverse_scale);
  const std::vector<NetworkTerminal> terminals = {reader.node("collector"), reader.node("base"),
                                                  reader.node("emitter")};
  const bool is_pnp = reader.word("polarity") == "pnp";
  return reader.result(
      elements::bipolar_transistor(law, at_emitter, at_collector, is_pnp, joined(terminals)),
      terminals);
}

std::optional<NetworkElement> read_mos(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const bool is_p = reader.word("polarity") == "p";
  elements::MosChannel channel;
  channel.threshold = (is_p ? -1.0 : 1.0) * reader.constant("threshold");
  channel.transconductance =
      reader.positive("transconductance") * reader.positive("width") / reader.positive("length");
  channel.modulation = reader.constant("modulation");
  channel.body = reader.constant("body");
  channel.surface = reader.positive("surface");
  const std::vector<NetworkTerminal> terminals = {reader.node("drain"), reader.node("gate"),
                                                  reader.node("source"), reader.node("bulk")};
  return reader.result(elements::mos_transistor(channel, is_p, joined(terminals)), terminals);
}

Key terminal(const char* name, const char* summary) {
  return required_key(name, takes::text(), summary);
}

}  // namespace

ElementKinds transistor_elements() {
  const auto number = [](const char* key, double otherwise, const char* summary) {
    return default_key(key, takes::formula(), otherwise, summary);
  };
  return {
      {{"bipolar-transistor",
        "of Ebers and Moll, with the base charge of Gummel and Poon where early and knee values "
        "are given, and with "
        "charges",
        {name(),
         terminal("collector", "a node"),
         terminal("base", "a node"),
         terminal("emitter", "a node"),
         default_key("polarity", takes::word({"npn", "pnp"}), "npn", "which way it conducts"),
         number("saturation", 1e-16, "in A"),
         number("forward_gain", 100.0, "β_f"),
         number("reverse_gain", 1.0, "β_r"),
         number("forward_emission", 1.0, "its coefficient"),
         number("reverse_emission", 1.0, "its coefficient"),
         number("thermal_voltage", 0.025852, "k T/e in V"),
         number("emitter_leak", 0.0, "saturation of the leaking junction at the emitter, in A"),
         number("emitter_leak_emission", 1.5, "its coefficient"),
         number("collector_leak", 0.0, "saturation of the leaking junction at the collector, in A"),
         number("collector_leak_emission", 2.0, "its coefficient"),
         number("early_forward", 0.0, "the Early voltage in V; 0: infinite"),
         number("early_reverse", 0.0, "that of reverse operation, in V; 0: infinite"),
         number("knee_forward", 0.0,
                "the current at which the gain begins to fall, in A; 0: infinite"),
         number("knee_reverse", 0.0, "that of reverse operation, in A; 0: infinite"),
         number("leak", 0.0, "a conductance beside each junction, in S"),
         number("emitter_capacitance", 0.0,
                "C₀ of C₀/(1 - v/junction)^grading in F; with it or with forward_transit there is "
                "a charge "
                "q_be_<name>"),
         number("emitter_junction", 0.75, "in V"),
         number("emitter_grading", 0.33, "less than 1"),
         number("collector_capacitance", 0.0,
                "in F; with it or with reverse_transit there is a charge q_bc_<name>"),
         number("collector_junction", 0.75, "in V"),
         number("collector_grading", 0.33, "less than 1"),
         number("forward", 0.5,
                "the part of junction from which on the capacitance goes on as its tangent"),
         number("forward_transit", 0.0, "the time whose product with i_f is a charge, in s"),
         number("reverse_transit", 0.0, "the time whose product with i_r is a charge, in s")}},
       read_bipolar},
      {{"mos-transistor",
        "the channel of Shichman and Hodges (level 1 of SPICE); junctions and capacitances are "
        "elements besides",
        {name(), terminal("drain", "a node"), terminal("gate", "a node"),
         terminal("source", "a node"), terminal("bulk", "a node; mostly that of the source"),
         default_key("polarity", takes::word({"n", "p"}), "n", "of the channel"),
         number("threshold", 0.0, "in V; negative for a p-channel that is off at 0 V"),
         number("transconductance", 2e-5, "in A/V², for a width equal to the length"),
         number("width", 1e-4, "in m"), number("length", 1e-4, "in m"),
         number("modulation", 0.0, "λ in 1/V: of the length of the channel"),
         number("body", 0.0, "γ in √V: of the voltage of the bulk"),
         number("surface", 0.6, "the surface potential in V")}},
       read_mos},
  };
}

}  // namespace courant
