// The operating point of a netlist: where SPICE begins without `uic`.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "courant/core/linear/linear_solver.hpp"

namespace courant::netlist {

// An element for direct voltages and currents, from node `from` to node `to`; 0 is the ground. Its
// current i counts positive from `from` to `to`, its voltage is v = φ_from - φ_to.
// A value f(u) of potentials of nodes, of voltages of diodes and of currents of elements that are sources of voltage, and its
// gradient. Laws that are exponential in a voltage ask for that of a diode, which grows no faster than the logarithm of its current.
struct StaticLaw {
  struct Control {
    std::optional<std::size_t> element = {};   // its current, else
    std::optional<std::size_t> junction = {};  // the voltage of this diode, else
    std::size_t node = 0;                      // the potential of this node
  };
  std::vector<Control> controls = {};
  std::function<std::pair<double, VectorXd>(const VectorXd& u)> value = {};
};

// An element of a circuit at rest: a relation of its voltage v and its current i.
struct StaticElement {
  enum class Kind {
    resistor,   // v = value i
    capacitor,  // i = 0, value in F
    inductor,   // v = 0, value in H
    voltage,    // v = value + gain (what controls it)
    current,    // i = value + gain (what controls it)
    diode  // i = value (exp(v/scale) - 1) + leak v - breakdown exp(-(v + breakdown_voltage)/scale)
  };
  Kind kind = Kind::resistor;
  std::size_t from = 0, to = 0;
  double value = 0.0;  // Ω, F, H, V or A
  double gain = 0.0;   // of controlled sources
  // What controls a source: the voltage between two nodes, or the current of an element that is a
  // voltage source.
  std::size_t control_from = 0, control_to = 0;
  std::optional<std::size_t> control = std::nullopt;
  double scale = 0.0, leak = 0.0;                   // of a diode, V and S
  double breakdown = 0.0, breakdown_voltage = 0.0;  // A and V; 0 A: none
  // Of voltage and current: what they are besides `value`.
  std::shared_ptr<const StaticLaw> law = nullptr;
};

// A circuit in which nothing changes with time.
struct StaticCircuit {
  struct Coupling {
    std::size_t first, second;  // inductors
    double mutual;              // H
  };
  struct Held {  // a node with .ic
    std::size_t node;
    double potential;  // V
  };

  std::size_t nodes = 1;  // with the ground
  std::vector<StaticElement> elements = {};
  std::vector<Coupling> couplings = {};
  std::vector<Held> held = {};
  std::vector<Held> guessed = {};  // nodes with .nodeset, none of them held
};

// Where it is at rest.
struct OperatingPoint {
  VectorXd potential;  // of each node, V
  VectorXd current;    // of each element, A; that of a capacitor is 0
};

// Why there is none: that of `elements`, if any, which form what `why` says.
struct NoOperatingPoint {
  std::string why;
  std::vector<std::size_t> elements;
};

// Direct voltages and currents of the circuit: capacitors carry no current, inductors have no
// voltage, held nodes are tied to their potentials by 1e-10 Ω. What that leaves open is as if the
// sources had been turned on slowly, from rest: parts of the circuit that only capacitors and sources
// of current connect have no charge, loops of inductors and sources of voltage no flux.
//
// Modified nodal analysis, and Newton's method with the limits of SPICE on the voltages of diodes: at
// first from 0 V, or from where it leads to with the guessed nodes held too; then with conductances from every node to the ground and beside every diode, which
// are taken away in steps; then with sources that grow in steps. The last equations are those of the
// circuit itself, and their residual is round-off. Source: Nagel, SPICE2 (1975), sections 4 and 5.
std::variant<OperatingPoint, NoOperatingPoint> operating_point(const StaticCircuit& circuit);

}  // namespace courant::netlist
