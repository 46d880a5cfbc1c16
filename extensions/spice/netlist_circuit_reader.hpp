// What reads the elements of a netlist: each file reads cards of its own.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "courant/extensions/importing/different_names.hpp"
#include "courant/extensions/spice/netlist_behaviour.hpp"
#include "courant/extensions/spice/netlist_circuit.hpp"
#include "courant/extensions/spice/netlist_parameters.hpp"

namespace courant::netlist {

// k T/e at 27 °C, the temperature of SPICE, and the conductance that it puts beside each diode.
inline constexpr double kThermalVoltage = 0.02586492;
inline constexpr double kLeastConductance = 1e-12;

// The circuit of a deck: instances of subcircuits opened, values evaluated, devices made of the elements of `network`.
class CircuitReader {
 public:
  CircuitReader(const Deck& deck, LineProblems& problems);

  NetlistCircuit read();

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

  void read_times(const Card& card);

  std::size_t node(const std::string& name, const std::string& prefix, const NodeMap& map,
                   int line);
  void expand(const Part& part, const std::string& prefix, const NodeMap& map, const Scope& scope);

  // The key of an element that another one refers to.
  std::string reference(const std::string& name, char type, const std::string& prefix,
                        int line) const;

  // A model of one of the types, and where its formulas find parameters.
  struct UsedModel {
    const DeviceModel* model;
    const Scope* scope;

    std::string formula(const std::string& key, const std::string& otherwise) const {
      return netlist::formula(model->value(key, otherwise), *scope, model->line);
    }
  };
  // With the pointer null where there is none of the name.
  UsedModel find_model(const std::string& name, const Part& part, const Scope& scope) const;
  UsedModel model(const std::string& name, const std::vector<std::string>& types, const Part& part,
                  const Scope& scope, int line) const;
  // Throws LineError for parameters of the model that are neither read nor without effect here.
  void allow(const UsedModel& used, const std::set<std::string>& read,
             const std::set<std::string>& without_effect) const;

  // The difference of the potentials of two nodes as a formula.
  std::string difference(std::size_t plus, std::size_t minus) const;

  void add_element(const Part& part, const Line& line, const std::string& prefix,
                   const NodeMap& map, const Scope& scope);

  // Both of an element, or only what it is for direct currents; the index among the static ones.
  std::size_t add_static(const StaticElement& fixed, const std::string& name, int line);
  std::size_t put(const Json& element, const StaticElement& fixed, int line);

  // The value of R, C or L: a number, key=value, or that of a model. What belongs to temperatures other than the nominal one
  // has no effect.
  std::string size_of(const Card& card, const std::string& key, const Part& part,
                      const Scope& scope);

  // … from rsh, or cj and cjsw, of the model and the sides l and w.
  static std::string size_by_geometry(const Card& card, const std::string& key,
                                      const UsedModel& used, const Scope& scope);
  // The current of a source of the importer's own that holds a capacitor of 1 F at the value of the formula.
  std::string derivative_of(const std::string& formula, const std::string& prefix, int line);
  // Whether the value of a resistor is an expression of potentials and currents.
  static bool depends_on_circuit(const Card& card);
  std::string behaviour_of(const std::string& expression, const Scope& scope,
                           const std::string& prefix, const NodeMap& map, int line);

  // What stands behind `key =` in a line as it is written, without braces or quotes around it; up to the next
  // assignment.
  static std::string expression_after(const Line& line, const std::string& key);

  // TABLE {x} = (x₁, y₁) (x₂, y₂) …, as table(x, x₁, y₁, …).
  static std::string table_after(const Line& line);

  // The law of a source from an expression of SPICE.
  void law_of(Json& element, StaticElement& fixed, const std::string& expression,
              const Scope& scope, const std::string& prefix, const NodeMap& map, int line);

  // … from a formula of potentials and currents.
  void law_of(Json& element, StaticElement& fixed, const std::string& law,
              const std::string& prefix, int line);

  std::string polynomial_of(const Card& card, bool by_voltage, const std::string& prefix,
                            const NodeMap& map, const Scope& scope);

  // A node of the importer's own.
  std::size_t own_node(const std::string& name, int line);
  void add_own(const char* type, const std::string& name, std::size_t from, std::size_t to,
               const std::string& value, StaticElement fixed, int line);

  void add_diode(const Card& card, const Part& part, const std::string& prefix, const NodeMap& map,
                 const Scope& scope);

  // A resistor whose conductance goes from off to on by the control, geometrically from `voff` to `von` or, without `vh`, over a
  // thousandth of vt; with `vh` a switch that keeps its state.
  void add_switch(const Card& card, const Part& part, const std::string& prefix, const NodeMap& map,
                  const Scope& scope);

  void add_bipolar(const Card& card, const Part& part, const std::string& prefix,
                   const NodeMap& map, const Scope& scope);
  void add_mos(const Card& card, const Part& part, const std::string& prefix, const NodeMap& map,
               const Scope& scope);
  // The node behind a series resistance of the importer's own, with the name `place` or, without one, that of the resistor and
  // _inside; the node itself where it is 0 Ω.
  std::size_t behind_resistance(std::size_t node, const std::string& resistance,
                                const std::string& name, int line, std::string place = "");
  // A diode, or a junction of a transistor that is an element of its own. All but the leak in S are formulas, in the units of `diode`.
  struct OwnJunction {
    std::string name;
    std::size_t from = 0, to = 0;
    std::string saturation = "0", emission = "1", capacitance = "0", transit = "0", voltage = "1",
                grading = "0.5", forward = "0.5";
    std::string breakdown = "0", breakdown_current = "0";  // V, 0: none, and A
    double leak = 0.0;
  };
  // Its static element; nothing where both ends are at one node.
  std::optional<std::size_t> add_junction(const OwnJunction& junction, int line);

  void add_instance(const Card& card, const Part& around, const std::string& prefix,
                    const NodeMap& map, const Scope& scope);

  // … at both of whose states its resistance is one number.
  void add_hysteresis(const NetlistSwitch& hysteresis, Json element, const StaticElement& fixed,
                      const std::string& off, const std::string& on, int line);

  // What elements say of others.
  void connect();

  // The coupling of two inductors; null if there is none.
  const Coupling* coupling_of(const std::string& first, const std::string& second) const;

  // Inductors that share one flux, those of each core in the order of the netlist. Throws LineError where one of them is coupled with
  // another one in part.
  std::vector<std::vector<std::string>> wholly_coupled() const;

  // With M² = L₁ L₂ the fluxes are one: φ₂ = M/L₁ φ₁, and φ₁ = L₁ (i₁ + M/L₁ i₂ + …). That is the first
  // inductor beside ideal transformers, one for each other inductor.
  void couple_wholly(const std::vector<std::string>& group, std::vector<std::size_t>& gone);

  void add_state();

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
  struct LawControl {
    std::shared_ptr<StaticLaw> law;
    std::size_t control;
    std::string by;
  };
  std::vector<LawControl> law_controls_;
  std::vector<std::pair<std::size_t, std::string>> switch_controls_;  // of circuit_.switches, keys
};

NetlistCircuit read_circuit(const Deck& deck, LineProblems& problems);

}  // namespace courant::netlist
