// What elements say of others: inductors on one core, sources that others control.
#include <algorithm>
#include <cmath>

#include "courant/core/words/message.hpp"
#include "courant/extensions/spice/netlist_circuit_reader.hpp"

namespace courant::netlist {

void CircuitReader::connect() {
  circuit_.fixed.nodes = circuit_.nodes.size();
  for (const auto& [element, by] : controls_)
    circuit_.fixed.elements[element].control = names_.at(by).element;
  for (const auto& [law, control, by] : law_controls_)
    law->controls[control].element = names_.at(by).element;
  for (const auto& [place, by] : switch_controls_)
    circuit_.switches[place].source = names_.at(by).element;
  std::vector<std::size_t> gone;
  for (const Coupling& coupling : couplings_) {
    const Named &first = names_.at(coupling.inductors[0]),
                &second = names_.at(coupling.inductors[1]);
    const double of_first = circuit_.fixed.elements[*first.element].value,
                 of_second = circuit_.fixed.elements[*second.element].value;
    circuit_.fixed.couplings.push_back(
        {*first.element, *second.element, coupling.coupling * std::sqrt(of_first * of_second)});
  }
  for (const std::vector<std::string>& group : wholly_coupled()) couple_wholly(group, gone);
  std::sort(gone.rbegin(), gone.rend());
  for (const std::size_t entry : gone) {
    circuit_.elements.erase(entry);
    circuit_.element_lines.erase(circuit_.element_lines.begin() + static_cast<Index>(entry));
  }
}

const CircuitReader::Coupling* CircuitReader::coupling_of(const std::string& first,
                                                          const std::string& second) const {
  for (const Coupling& coupling : couplings_)
    if ((coupling.inductors[0] == first && coupling.inductors[1] == second) ||
        (coupling.inductors[0] == second && coupling.inductors[1] == first))
      return &coupling;
  return nullptr;
}

std::vector<std::vector<std::string>> CircuitReader::wholly_coupled() const {
  std::vector<std::vector<std::string>> groups;
  for (const Coupling& coupling : couplings_) {
    if (std::abs(coupling.coupling) != 1.0) continue;
    std::vector<std::string> joined;
    for (const std::string& inductor : coupling.inductors) {
      const auto found = std::ranges::find_if(groups, [&](const auto& group) {
        return std::ranges::find(group, inductor) != group.end();
      });
      if (found == groups.end()) {
        joined.push_back(inductor);
      } else {
        joined.insert(joined.end(), found->begin(), found->end());
        groups.erase(found);
      }
    }
    std::vector<std::string> once;
    for (const std::string& inductor : joined)
      if (std::ranges::find(once, inductor) == once.end()) once.push_back(inductor);
    groups.push_back(once);
  }
  for (const auto& group : groups)
    for (const Coupling& coupling : couplings_) {
      const auto inside = [&](const std::string& name) {
        return std::ranges::find(group, name) != group.end();
      };
      const bool first = inside(coupling.inductors[0]), second = inside(coupling.inductors[1]);
      if (first != second || (first && std::abs(coupling.coupling) != 1.0))
        throw LineError{coupling.line,
                        "the inductors are coupled wholly, and one of them is coupled with "
                        "others in part; expected a coupling between -1 and 1"};
    }
  return groups;
}

void CircuitReader::couple_wholly(const std::vector<std::string>& group,
                                  std::vector<std::size_t>& gone) {
  const Named& first = names_.at(group[0]);
  const Json primary = circuit_.elements[first.entry];
  const auto text = [](const Json& value) {
    return value.is_number() ? exact_text(value.get<double>()) : value.get<std::string>();
  };
  const auto storage = [&](const Named& named) {
    return std::find_if(circuit_.storages.begin(), circuit_.storages.end(),
                        [&](const NetlistStorage& each) { return each.name == named.name; });
  };
  const auto of_first = storage(first);
  std::map<std::string, double> sign = {{group[0], 1.0}};
  std::set<std::size_t> used;
  for (std::size_t k = 1; k < group.size(); ++k) {
    const Named& second = names_.at(group[k]);
    const Json secondary = circuit_.elements[second.entry];
    const Coupling* coupling = coupling_of(group[0], group[k]);
    if (!coupling)
      throw LineError{second.line, "the inductor " + second.name + " shares a core with " +
                                       first.name +
                                       ", but is not coupled with it; expected a coupling of 1"};
    sign[group[k]] = coupling->coupling;
    used.insert(coupling->entry);
    Json& element = circuit_.elements[coupling->entry];
    element = {{"type", "ideal-transformer"},
               {"name", element["name"]},
               {"from", primary["from"]},
               {"to", primary["to"]},
               {"secondary", {secondary["from"], secondary["to"]}},
               {"ratio", (coupling->coupling < 0.0 ? "-sqrt(" : "sqrt(") + text(primary["value"]) +
                             "/(" + text(secondary["value"]) + "))"}};
    const auto of_second = storage(second);
    if (of_second->given)
      of_first->given = "(" + of_first->given.value_or("0") + " + " + *of_second->given + "/(" +
                        element["ratio"].get<std::string>() + "))";
    gone.push_back(second.entry);
  }
  for (const Coupling& coupling : couplings_) {
    if (!sign.contains(coupling.inductors[0]) || used.contains(coupling.entry)) continue;
    if (coupling.coupling != sign[coupling.inductors[0]] * sign[coupling.inductors[1]])
      throw LineError{coupling.line,
                      "the signs of the couplings on one core contradict each other"};
    gone.push_back(coupling.entry);
  }
  std::erase_if(circuit_.storages, [&](const NetlistStorage& each) {
    return each.name != first.name && std::ranges::any_of(group, [&](const std::string& name) {
             return names_.at(name).name == each.name;
           });
  });
}

}  // namespace courant::netlist
