#include "courant/reading/network_branches.hpp"

#include <map>

#include "courant/core/language/formula.hpp"

namespace courant {
namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

}  // namespace

// Takes the names of branches and states into the words of the network.
class NetworkBranches::Naming {
 public:
  Naming(NetworkBranches& to, const NetworkNodes& nodes, NetworkWords& words, Findings& findings)
      : to_(to), nodes_(nodes), words_(words), findings_(findings) {
    taken_ = words.vocabulary.symbols({.t = Expr(0.0)});
    taken_.add("H", 0.0);
    for (const Definition& definition : words.vocabulary.definitions)
      if (!taken_.find(definition.name)) taken_.add(definition.name, 0.0);
  }

  void add(const NetworkElement& element) {
    std::vector<Index> nodes;
    for (const NetworkTerminal& terminal : element.terminals) nodes.push_back(nodes_.at(terminal));
    const auto first = to_.assembly.branches().size();
    to_.assembly.add(element.name, element.element, nodes);
    for (std::size_t k = first; k < to_.assembly.branches().size(); ++k) {
      const NetworkBranch& branch = to_.assembly.branches()[k];
      words_.currents[name(branch.current_name, element.pointer)] = static_cast<Index>(k);
      words_.voltages[name(branch.voltage_name, element.pointer)] = static_cast<Index>(k);
      const elements::Domain& domain = *element.element.branches[k - first].domain;
      to_.kinds[branch.current_name] = domain.name + " through";
      to_.kinds[branch.voltage_name] = across(domain);
      if (branch.role == Role::port)
        for (const char* letter : {"u_", "y_"}) name(letter + branch.name, element.pointer);
      if (branch.state_name.empty()) continue;
      words_.vocabulary.coordinates.append({name(branch.state_name, element.pointer), {}});
      to_.efforts.push_back(branch.kind == Kind::charge ? branch.voltage_name
                                                        : branch.current_name);
    }
  }

  // The potentials that laws depend on, as the voltages of branches without current: so they are
  // unknowns, whatever the laws are.
  void add_voltmeters(const std::vector<NetworkElement>& elements) {
    to_.of_elements = to_.assembly.branches().size();
    const auto kinds = node_domains(nodes_, elements);
    std::map<std::string, Index> potentials;
    for (std::size_t node = 1; node < nodes_.names.size(); ++node)
      if (kinds[node]) {
        const std::string potential = kinds[node]->node + nodes_.names[node];
        potentials[name(potential, nodes_.pointers[node])] = static_cast<Index>(node);
        to_.kinds[potential] = across(*kinds[node]);
      }
    for (const NetworkElement& element : elements)
      for (const WrittenFormula& formula : element.formulas)
        for (const std::string& used : used_in(formula)) {
          const auto node = potentials.find(used);
          if (node == potentials.end() || words_.voltages.count(used)) continue;
          words_.voltages[used] = std::ssize(to_.assembly.branches());
          to_.assembly.add_branch({.name = used,
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
  static std::string across(const elements::Domain& domain) { return domain.name + " across"; }

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
  Naming naming(*this, nodes, words, findings);
  for (const NetworkElement& element : elements) naming.add(element);
  naming.add_voltmeters(elements);
  for (const NetworkBranch& branch : assembly.branches())
    if (branch.kind == Kind::current || branch.kind == Kind::voltage)
      words.vocabulary.unknowns.append(
          {branch.kind == Kind::current ? branch.current_name : branch.voltage_name, {}});
  for (const NetworkBranch& branch : assembly.branches())
    if (branch.role == Role::port) {
      words.vocabulary.unknowns.append({"u_" + branch.name, {}});
      outputs.append({"y_" + branch.name, {}});
    }
}

}  // namespace courant
