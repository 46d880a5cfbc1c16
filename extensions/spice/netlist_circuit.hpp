// The elements of a netlist, with its subcircuits put in their places.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "courant/core/language/symbol_table.hpp"
#include "courant/extensions/spice/netlist_cards.hpp"
#include "courant/extensions/spice/netlist_operating_point.hpp"
#include "courant/extensions/spice/netlist_switches.hpp"
#include "courant/structures/elements/junction_charge.hpp"

namespace courant::netlist {

// A capacitor or an inductor.
struct NetlistStorage {
  std::string name, state;  // C1, q_C1
  std::string value;        // a formula of parameters, F or H
  std::size_t element;      // of `fixed`
  bool is_capacitor;
  std::optional<std::string> given;  // by ic=
  int line;
};

// The charge of a diode.
struct NetlistJunction {
  std::string state;    // q_D1
  std::size_t element;  // of `fixed`
  elements::JunctionCharge charge;
  // What is added to the charge, by the voltage of this junction and that of another one.
  std::size_t other = 0;
  std::function<double(double v, double other)> more = {};

  double at(double v, double v_other) const {
    return charge.charge(v).value() + (more ? more(v, v_other) : 0.0);
  }
};

// A circuit as the system `network` takes it, with the lines of the netlist that its parts come from.
struct NetlistCircuit {
  Json parameters = Json::object();  // as `network` takes them
  Json nodes = Json::array({"0"}), elements = Json::array();
  std::map<std::string, int> parameter_lines;
  std::vector<int> node_lines = {0}, element_lines;

  SymbolTable values;  // of parameters, and of t: 0
  Scope scope;         // outside of all subcircuits
  std::map<std::string, std::size_t>
      nodes_by_name;                               // as in the netlist; x1.m is in the instance x1
  std::vector<std::string> sources;                // of voltage, outside of all subcircuits
  std::vector<std::pair<int, std::string>> notes;  // what of a line has no effect
  std::vector<NetlistStorage> storages;
  std::vector<NetlistJunction> junctions;
  std::vector<NetlistSwitch> switches;
  std::map<std::size_t, std::size_t> terminals;  // of nodes behind the resistance of a device
  StaticCircuit fixed;                           // at t = 0
  std::vector<std::string> names;                // of the elements of `fixed`
  std::vector<int> lines;
  bool at_rest = true;  // whether all sources are 0 at t = 0

  // Of a circuit without capacitors and inductors: the node of a capacitor beside a resistor that stand
  // for the state that a network needs, and that stays 0.
  std::optional<std::size_t> resting;

  Times times;
  double largest_step = 0.0;    // 0: not given
  std::vector<Corner> corners;  // of the values of sources
  bool from_given = false;      // uic

  std::string name_of(std::size_t node) const { return nodes[node].get<std::string>(); }
  // Throws LineError unless it is a finite number.
  double value_of(const std::string& formula, int line) const;
};

// A number where the formula is one.
Json written_value(const std::string& formula);

}  // namespace courant::netlist
