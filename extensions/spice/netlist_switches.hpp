// Switches that keep their state between two thresholds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/extensions/spice/netlist_operating_point.hpp"

namespace courant::netlist {

// A switch with hysteresis: it goes on where its control rises above `high`, and off where that falls below
// `low`. Its state is the charge of a capacitor without energy on a node of its own, 1 where it is on, which the events
// of the experiment set.
struct NetlistSwitch {
  std::string name, state;              // S1, q_S1_on
  std::string control, low, high;       // formulas
  std::size_t element = 0;              // of the fixed circuit, a resistor
  double on = 0.0, off = 0.0;           // its values, in Ω
  double above = 0.0, below = 0.0;      // those of `high` and `low`, in V or A
  std::size_t plus = 0, minus = 0;      // nodes whose difference is the control, else
  std::optional<std::size_t> source{};  // the element whose current is
  std::size_t memory = 0;               // the node of that capacitor
  bool begins_on = false;               // as the netlist says
};

// Sets which switches are on at the operating point: beyond its thresholds that is as they say, between them as the
// netlist says. As in SPICE: with the switches as they are the point is found, and switches that it moves are moved, until
// none is. False where that goes round in circles, as of an oscillator: they are as the netlist says then.
bool set_switches(StaticCircuit& circuit, std::vector<NetlistSwitch>& switches);

}  // namespace courant::netlist
