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
#include "courant/structures/elements/element.hpp"

namespace courant {

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

// An element as it is written.
struct NetworkElement {
  std::string type, name, pointer;
  std::string turn = {};  // " (i = 3)" where it is one of those that a repetition stands for
  elements::Element element = {};
  std::vector<NetworkTerminal> terminals = {};
  std::vector<WrittenFormula> formulas = {}, energy_formulas = {};  // of laws; of x and t alone
  // Of a mutual inductance: M, or M/√(L₁L₂).
  struct Mutual {
    std::string inductors[2];
    std::string pointer;
    double value = 0.0;
    bool is_coupling = false;
  };
  std::optional<Mutual> mutual = {};

  // Where a branch of it ends: a terminal, or the ground.
  NetworkTerminal terminal(Index number) const;
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

// Reads the keys of an element, and collects what is wrong with it.
class ElementReader {
 public:
  ElementReader(ObjectReader& object, const NetworkSite& site);

  const std::string& name() const { return element_.name; }
  NetworkTerminal node(const std::string& key);  // the ground, if the key is missing
  // A pair of nodes as an array of two; nothing, and a problem, if it is none.
  std::pair<NetworkTerminal, NetworkTerminal> pair(const std::string& key);
  bool has(const std::string& key) const;
  // The one of these keys that is there; the first, and a problem, if there are several or none.
  std::string one_of(const std::vector<std::string>& keys);
  // A constant formula of the parameters; 1, and a problem, if it is none.
  double constant(const std::string& key);
  double positive(const std::string& key);
  double nonzero(const std::string& key);
  // One of the words of its key.
  std::string word(const std::string& key);
  std::optional<WrittenFormula> formula(const std::string& key);

  // The formula of a key as a law, of anything; or, for energies, of states and t. 1, and a problem, if there is none.
  elements::Law law(const std::string& key);
  elements::Law law_of(const WrittenFormula& formula);
  elements::StateLaw state_law(const std::string& key);
  // ∫₀ˣ of the law of a key for the across or through variable of a state, by Gauss quadrature; the law itself
  // is what moves the state. `element`: of one state.
  void take_law_of_state(elements::Element& element, const std::string& key);

  // The element between the nodes of these keys, or between these; nothing if there were problems.
  std::optional<NetworkElement> result(elements::Element element,
                                       const std::vector<std::string>& keys);
  std::optional<NetworkElement> result(elements::Element element,
                                       std::vector<NetworkTerminal> terminals);
  std::optional<NetworkElement> result(NetworkElement::Mutual mutual);

 private:
  ObjectReader& object_;
  const NetworkSite& site_;
  NetworkElement element_;
  bool right_ = true;
};

}  // namespace courant
