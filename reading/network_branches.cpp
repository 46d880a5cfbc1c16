#include "courant/reading/network_branches.hpp"

#include <map>

#include "courant/core/language/formula.hpp"

namespace courant {
namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

// Where the temperatures of branches are looked for: at 0 K the laws have no value.
constexpr double kRoomTemperature = 300.0;

}  // namespace

// Adds branches to those that there are.
class NetworkBranches::Assembly {
 public:
  Assembly(NetworkBranches& to, const NetworkNodes& nodes, NetworkWords& words, Findings& findings)
      : to_(to), nodes_(nodes), words_(words), findings_(findings) {
    taken_ = words.vocabulary.symbols({.t = Expr(0.0)});
    taken_.add("H", 0.0);
    for (const Definition& definition : words.vocabulary.definitions)
      if (!taken_.find(definition.name)) taken_.add(definition.name, 0.0);
  }

  void add(const NetworkElement& element, const NetworkElement::Port& port) {
    const std::string full = element.name + port.suffix;
    const auto index = static_cast<Index>(to_.branches.size());
    NetworkBranch branch{.name = full,
                         .from = nodes_.at(port.from),
                         .to = nodes_.at(port.to),
                         .kind = port.kind,
                         .role = port.role,
                         .law = port.law,
                         .energy = port.energy,
                         .current_name = name(port.domain->through + full, element.pointer),
                         .voltage_name = name(port.domain->across + full, element.pointer)};
    if (port.domain == &domains::thermal && port.kind == Kind::voltage)
      branch.guess = kRoomTemperature;
    if (port.role == Role::port)
      for (const char* letter : {"u_", "y_"}) name(letter + full, element.pointer);
    words_.currents[branch.current_name] = index;
    words_.voltages[branch.voltage_name] = index;
    if (!port.state.empty()) {
      branch.state_name = name(port.state + element.name, element.pointer);
      to_.states.back().push_back(words_.vocabulary.coordinates.size());
      words_.vocabulary.coordinates.append({branch.state_name, {}});
    }
    to_.branches.push_back(std::move(branch));
  }

  // The potentials that laws depend on, as the voltages of branches without current: so they are
  // unknowns, whatever the laws are.
  void add_voltmeters(const std::vector<NetworkElement>& elements) {
    to_.of_elements = to_.branches.size();
    const auto kinds = node_domains(nodes_, elements);
    std::map<std::string, Index> potentials;
    for (std::size_t node = 1; node < nodes_.names.size(); ++node)
      if (kinds[node])
        potentials[name(kinds[node]->node + nodes_.names[node], nodes_.pointers[node])] =
            static_cast<Index>(node);
    for (const NetworkElement& element : elements)
      for (const WrittenFormula& formula : element.formulas)
        for (const std::string& used : used_in(formula)) {
          const auto node = potentials.find(used);
          if (node == potentials.end() || words_.voltages.count(used)) continue;
          words_.voltages[used] = static_cast<Index>(to_.branches.size());
          to_.branches.push_back({.name = used,
                                  .from = node->second,
                                  .to = 0,
                                  .kind = Kind::voltage,
                                  .role = Role::coupler,
                                  .law = [](const NetworkVariables&) { return Expr(0.0); },
                                  .current_name = "i_" + used,
                                  .voltage_name = used});
        }
  }

 private:
  std::string name(const std::string& name, const std::string& pointer) {
    if (taken_.find(name)) {
      findings_.problem(pointer, "needs the name \"" + name +
                                     "\", which has a meaning already; expected another name for "
                                     "the element or for what has it");
      to_.right = false;
    } else {
      taken_.add(name, 0.0);
    }
    return name;
  }

  std::vector<std::string> used_in(const WrittenFormula& formula) {
    try {
      return names_used(formula.text);
    } catch (const FormulaError& error) {
      findings_.problem(formula.pointer, error.what());
      to_.right = false;
      return {};
    }
  }

  NetworkBranches& to_;
  const NetworkNodes& nodes_;
  NetworkWords& words_;
  Findings& findings_;
  SymbolTable taken_;
};

NetworkBranches::NetworkBranches(const NetworkNodes& nodes,
                                 const std::vector<NetworkElement>& elements, NetworkWords& words,
                                 Findings& findings) {
  Assembly assembly(*this, nodes, words, findings);
  for (const NetworkElement& element : elements) {
    *element.first = static_cast<Index>(branches.size());
    states.emplace_back();
    for (const NetworkElement::Port& port : element.ports) assembly.add(element, port);
  }
  assembly.add_voltmeters(elements);
  for (const NetworkBranch& branch : branches)
    if (branch.kind == Kind::current || branch.kind == Kind::voltage)
      words.vocabulary.unknowns.append(
          {branch.kind == Kind::current ? branch.current_name : branch.voltage_name, {}});
  for (const NetworkBranch& branch : branches)
    if (branch.role == Role::port) {
      words.vocabulary.unknowns.append({"u_" + branch.name, {}});
      outputs.append({"y_" + branch.name, {}});
    }
}

}  // namespace courant
