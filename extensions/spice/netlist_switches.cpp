#include "courant/extensions/spice/netlist_switches.hpp"

#include <utility>
#include <variant>

namespace courant::netlist {

bool set_switches(StaticCircuit& circuit, std::vector<NetlistSwitch>& switches) {
  std::vector<NetlistSwitch> as_given = switches;
  const auto place = [&] {
    for (const NetlistSwitch& one : switches)
      circuit.elements[one.element].value = one.begins_on ? one.on : one.off;
  };
  for (std::size_t round = 0; round <= 2 * switches.size(); ++round) {
    place();
    const auto found = operating_point(circuit);
    const auto* const point = std::get_if<OperatingPoint>(&found);
    if (!point) return true;  // which is told by whoever asks for the point
    bool moved = false;
    for (NetlistSwitch& one : switches) {
      const double control = one.source ? point->current[static_cast<Index>(*one.source)]
                                        : point->potential[static_cast<Index>(one.plus)] -
                                              point->potential[static_cast<Index>(one.minus)];
      const bool is_on = one.begins_on ? control >= one.below : control > one.above;
      moved = moved || is_on != one.begins_on;
      one.begins_on = is_on;
    }
    if (!moved) return true;
  }
  switches = std::move(as_given);
  place();
  return false;
}

}  // namespace courant::netlist
