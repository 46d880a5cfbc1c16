#include "courant/reading/energy_words.hpp"

#include <set>

#include "courant/integrators/step/step_energies.hpp"

namespace courant {

NameList energy_words(const Model& model) {
  NameList words;
  const auto system = std::dynamic_pointer_cast<const EnergySystem>(model.system);
  if (!system) return words;
  const StepEnergies::Formulas energies(*system);  // nothing is compiled
  if (energies.suppliers.empty() && energies.dissipators.empty()) return words;
  const Manifold& M = *system->manifold();
  Graph graph;
  const SymbolTable taken = model.symbols(
      graph.variables("x", M.ambient_dimension()), graph.variables("v", M.tangent_dimension()),
      graph.variables("z", system->auxiliary_size()), graph.variable("t"));
  std::set<std::string> used;
  const auto add = [&](const std::string& name) {
    if (taken.find(name) || !used.insert(name).second)
      words.append_unnamed(1);
    else
      words.append({name, {}});
  };
  add("supplied");
  add("dissipated");
  for (const std::string& port : energies.suppliers) add("supplied_" + port);
  for (const std::string& port : energies.dissipators) add("dissipated_" + port);
  return words;
}

bool has_ports(const NameList& energy_words) {
  constexpr Index of_reactions = 3;  // supplied, dissipated, supplied_constraints
  return energy_words.size() > of_reactions ||
         (energy_words.size() > 0 && !energy_words.contains("supplied_constraints"));
}

}  // namespace courant
