#include "courant/reading/network_quantities.hpp"

#include <set>
#include <unordered_set>
#include <utility>

#include "courant/core/numbers/as_size.hpp"

namespace courant {

std::vector<std::string> potential_names(const NetworkNodes& nodes,
                                         const std::vector<const elements::Domain*>& kinds) {
  std::vector<std::string> potentials;
  for (std::size_t node = 1; node < kinds.size(); ++node)
    potentials.push_back(kinds[node]->node + nodes.names[node]);
  return potentials;
}

void check_network_definitions(Vocabulary& vocabulary, const NetworkWords& words,
                               const std::vector<std::string>& potentials, Findings& findings) {
  SymbolTable known;
  vocabulary.unknowns.add_to(known, ExprVector::Zero(vocabulary.unknowns.size()));
  NameList names;
  const auto add = [&](const std::string& name) {
    if (known.find(name)) return;
    known.add(name, 0.0);
    names.append({name, {}});
  };
  for (const auto& [name, branch] : words.currents) add(name);
  for (const auto& [name, branch] : words.voltages) add(name);
  for (const std::string& name : potentials) add(name);
  vocabulary.derived.push_back(
      {names,
       [size = names.size()](const Vocabulary::Arguments& given) -> std::optional<ExprVector> {
         if (!given.velocity || !given.t) return std::nullopt;
         return ExprVector(ExprVector::Constant(size, *given.t));
       }});
  check_definitions(vocabulary, findings);
  vocabulary.derived.clear();
}

bool check_formulas(const std::vector<NetworkElement>& elements, const NetworkWords& words,
                    const std::vector<std::string>& potentials, Findings& findings) {
  Graph graph;
  const ExprVector x = graph.variables("x", words.vocabulary.coordinates.size());
  SymbolTable of_energies = words.vocabulary.symbols({.x = x, .t = graph.variable("t")});
  SymbolTable of_laws = of_energies;
  const auto add = [&](const std::string& name) {
    if (!of_laws.find(name)) of_laws.add(name, graph.variable(name));
  };
  for (const auto& [name, branch] : words.currents) add(name);
  for (const auto& [name, branch] : words.voltages) add(name);
  for (const std::string& name : potentials) add(name);
  std::set<std::string> wrong;  // places: a formula that is repeated is wrong once
  for (const NetworkElement& element : elements) {
    const auto check_all = [&](const std::vector<WrittenFormula>& formulas,
                               const SymbolTable& symbols) {
      for (const WrittenFormula& formula : formulas) {
        if (wrong.count(formula.pointer)) continue;
        Findings own;
        if (!check(formula, symbols, own)) wrong.insert(formula.pointer);
        findings.take_problems(own, element.turn);
      }
    };
    check_all(element.formulas, of_laws);
    check_all(element.energy_formulas, of_energies);
  }
  return wrong.empty();
}

Vocabulary::Derived network_quantities(const std::shared_ptr<const Network>& network,
                                       const Vocabulary& vocabulary, std::size_t of_elements,
                                       const NetworkNodes& nodes,
                                       const std::vector<const elements::Domain*>& kinds) {
  const auto unknowns = vocabulary.unknowns.element_names();
  const std::unordered_set<std::string> known(unknowns.begin(), unknowns.end());
  const auto is_new = [&](const std::string& name) { return !known.contains(name); };
  NameList names;
  std::vector<std::pair<Index, int>> source;  // 0: current, 1: voltage of a branch; 2: of a node
  for (std::size_t k = 0; k < of_elements; ++k) {
    const NetworkBranch& branch = network->branches()[k];
    for (const int which : {0, 1}) {
      const std::string& name = which == 0 ? branch.current_name : branch.voltage_name;
      if (!is_new(name)) continue;
      names.append({name, {}});
      source.emplace_back(static_cast<Index>(k), which);
    }
  }
  for (std::size_t node = 1; node < nodes.names.size(); ++node) {
    const std::string name = kinds[node]->node + nodes.names[node];
    if (!is_new(name)) continue;
    names.append({name, {}});
    source.emplace_back(static_cast<Index>(node), 2);
  }
  return {names,
          [network, source](const Vocabulary::Arguments& given) -> std::optional<ExprVector> {
            if (!given.x || !given.velocity || !given.z || !given.t) return std::nullopt;
            const ExprVector effort =
                given.effort ? *given.effort : network->effort(*given.x, *given.z, *given.t);
            const Network::Ports ports =
                network->ports(*given.x, *given.velocity, effort, *given.z, *given.t);
            const ExprVector potentials = network->potentials(ports.voltage);
            ExprVector values(static_cast<Index>(source.size()));
            for (Index k = 0; k < values.size(); ++k) {
              const auto& [index, which] = source[as_size(k)];
              values[k] = which == 0   ? ports.current[index]
                          : which == 1 ? ports.voltage[index]
                                       : potentials[index];
            }
            return values;
          }};
}

}  // namespace courant
