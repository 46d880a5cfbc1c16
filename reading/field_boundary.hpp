// What an experiment says of the boundary of its fields.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/reading/cell_formulas.hpp"
#include "courant/structures/stokes_dirac/stokes_dirac_system.hpp"

namespace courant {

// One region: an effort is given, or what flows in, or there is an impedance, or a free port.
//
//   {"V": "sin(t)"}                    the first effort: a k-form on the boundary
//   {"I": 0}                           what enters of the second effort, for each m^(n-1-k)
//   {"impedance": "Z"}                 V = Z times what leaves
//   {"port": "V", "profile": "x"}      V = profile times u, and y is what enters, weighted likewise; {"port": "I"}
//                                      the other way about
struct RegionCondition {
  enum class Kind { effort, flow, impedance, effort_port, flow_port };
  std::string region, pointer;
  Kind kind = Kind::flow;
  WrittenFormulas formulas;
  std::vector<Index> cells;  // k-cells, of the boundary

  bool has_effort_cells() const { return kind == Kind::effort || kind == Kind::effort_port; }
};

// The conditions of an object by region. Cells in several regions with an effort belong to the first of these.
// With heat there are no impedances: a temperature has none for a flow of energy.
std::optional<std::vector<RegionCondition>> read_boundary(const JsonReader& boundary,
                                                          const CellComplex& complex, Index degree,
                                                          const std::vector<std::string>& efforts,
                                                          bool is_of_heat);

// The k-cells whose effort is an input.
std::vector<Index> effort_cells(const std::vector<RegionCondition>& conditions);

// Adds the conditions to a setting, with formulas of x, y, z, t and the names of the vocabulary. Whether they are right.
bool add_boundary(const std::vector<RegionCondition>& conditions, const StokesDirac& structure,
                  const Vocabulary& words, StokesDiracSystem::Setting& setting, Findings& findings);

}  // namespace courant
