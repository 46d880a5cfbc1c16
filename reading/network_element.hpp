// NetworkElement: what an experiment says of one element of a network.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/reading/registry.hpp"
#include "courant/reading/vocabulary.hpp"
#include "courant/structures/network.hpp"

namespace courant {

// A pair of a through and an across variable, and the first letters of names: of these two, and of
// the across variable of a node against the ground.
struct NetworkDomain {
  std::string name;
  std::string through, across, node;
};
namespace domains {
extern const NetworkDomain electrical;   // i_R1 in A, v_R1 in V, potential_a
extern const NetworkDomain translation;  // F_K1 in N, v_K1 in m/s, velocity_a
extern const NetworkDomain rotation;     // tau_K1 in N·m, omega_K1 in rad/s, speed_a
extern const NetworkDomain hydraulic;    // Q_P1 in m³/s, P_P1 in Pa, pressure_a
extern const NetworkDomain thermal;      // s_G1 in W/K, T_G1 in K, temperature_a
}  // namespace domains

// The words of the formulas of elements: parameters, t, states, definitions of these, the currents
// and voltages of all branches, the potentials of nodes. Filled after the elements are read.
struct NetworkWords {
  Vocabulary vocabulary;
  std::map<std::string, Index, std::less<>> currents, voltages;  // branches by name

  // Of a law. Throws FormulaError.
  Expr value(const WrittenFormula& formula, const NetworkVariables& variables) const;
  // Of an energy.
  Expr value(const WrittenFormula& formula, const ExprVector& x, const Expr& t) const;
};

// A node as it is named, and where.
struct NetworkTerminal {
  std::string node;  // empty: the ground
  std::string pointer;
};

// An element of one or several branches.
struct NetworkElement {
  struct Port {
    std::string suffix;  // what the branch's name has after that of the element
    const NetworkDomain* domain = nullptr;
    NetworkTerminal from, to;
    NetworkBranch::Kind kind = NetworkBranch::Kind::current;
    NetworkBranch::Role role = NetworkBranch::Role::resistor;
    NetworkBranch::Law law = {};
    std::string state = {};          // first letters of the state's name
    NetworkBranch::Law energy = {};  // of a charge whose law is implicit
  };
  using Energy = std::function<Expr(const ExprVector& own, const ExprVector& x, const Expr& t)>;

  std::string type, name, pointer;
  std::string turn = {};  // " (i = 3)" where it is one of those that a repetition stands for
  std::vector<Port> ports = {};
  Energy energy = {};
  std::vector<WrittenFormula> formulas = {}, energy_formulas = {};  // of laws; of x and t alone
  // Of a linear inductor, for mutual inductances.
  std::optional<double> inductance = {};
  // Of a mutual inductance: M, or M/√(L₁L₂).
  struct Mutual {
    std::string inductors[2];
    std::string pointer;
    double value = 0.0;
    bool is_coupling = false;
  };
  std::optional<Mutual> mutual = {};
  // The index of the element's first branch among all; laws look it up when they are evaluated.
  std::shared_ptr<Index> first = std::make_shared<Index>(0);
};

// What reading an element needs of the network around it.
struct NetworkSite {
  Vocabulary vocabulary;  // parameters and definitions
  std::shared_ptr<const NetworkWords> words;
};

// The kinds of `element`.
Registry<NetworkElement, NetworkSite>& element_kinds();

// One file each: the kinds of a domain.
using ElementKinds = std::vector<Registry<NetworkElement, NetworkSite>::Kind>;
ElementKinds electrical_elements();
ElementKinds transistor_elements();
ElementKinds mechanical_elements();
ElementKinds thermofluid_elements();
ElementKinds transducer_elements();
ElementKinds port_elements();

// Reads the keys of an element, and collects what it is made of.
class ElementReader {
 public:
  using Kind = NetworkBranch::Kind;
  using Role = NetworkBranch::Role;
  using Law = NetworkBranch::Law;
  // A law in the variables of the element's own branches.
  using OwnLaw = std::function<Expr(const NetworkVariables&, Index first)>;

  ElementReader(ObjectReader& object, const NetworkSite& site);

  NetworkTerminal node(const std::string& key);  // the ground, if the key is missing
  NetworkTerminal ground() const;
  // A pair of nodes as an array of two; nothing, and a problem, if it is none.
  std::pair<NetworkTerminal, NetworkTerminal> pair(const std::string& key);
  bool has(const std::string& key) const;
  // The one of these keys that is there; the first, and a problem, if it is not one.
  std::string one_of(const std::vector<std::string>& keys);
  // A constant formula of the parameters; 1, and a problem, if it is none.
  double constant(const std::string& key);
  double positive(const std::string& key);
  double nonzero(const std::string& key);
  // One of the words of its key.
  std::string word(const std::string& key);
  std::optional<WrittenFormula> formula(const std::string& key);

  // Branches, in the order of their indices.
  void branch(const NetworkDomain& domain, NetworkTerminal from, NetworkTerminal to, Kind kind,
              Role role, OwnLaw law, const std::string& suffix = "");
  // … whose law is the value of a formula.
  void formula_branch(const NetworkDomain& domain, NetworkTerminal from, NetworkTerminal to,
                      Kind kind, Role role, const WrittenFormula& law,
                      const std::string& suffix = "");
  void storage(const NetworkDomain& domain, NetworkTerminal from, NetworkTerminal to, Kind kind,
               const std::string& letters, const std::string& suffix = "");
  // A charge that is tied to the unknowns of the element's other branches by its law: `voltage` of these and of the charge itself,
  // `energy` of these.
  using ChargeLaw = std::function<Expr(const NetworkVariables&, Index first, const Expr& charge)>;
  void implicit_storage(const NetworkDomain& domain, NetworkTerminal from, NetworkTerminal to,
                        const std::string& letters, const std::string& suffix, ChargeLaw voltage,
                        OwnLaw energy);
  // A port of the network (NetworkBranch::Role::port).
  void port(const NetworkDomain& domain, NetworkTerminal from, NetworkTerminal to, Kind kind);
  // The value of a formula that the laws of the element use, which is checked like a law.
  OwnLaw value_of(const WrittenFormula& formula);
  void energy(NetworkElement::Energy energy) { element_.energy = std::move(energy); }
  void energy(const WrittenFormula& formula);
  // x²/(2 value)
  void quadratic_energy(double value);
  // ∫₀ˣ of a law for the across or through variable of a state, by Gauss quadrature; the law itself
  // is what moves the state.
  void law_of_state(const WrittenFormula& formula);

  NetworkElement& element() { return element_; }
  std::optional<NetworkElement> result();

 private:
  ObjectReader& object_;
  const NetworkSite& site_;
  NetworkElement element_;
  bool right_ = true;
};

}  // namespace courant
