// What stands under the title of a report.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "courant/plotting/svg.hpp"
#include "courant/reporting/prose.hpp"
#include "courant/running/run_files.hpp"

namespace courant {

// A key of an experiment's system, and what it says in words and formulas.
struct ModelEntry {
  std::string name;
  std::vector<Prose> lines;
};
// Formulas of the system, then numbers and parameters: those of ready-made systems are members of
// it. Left out are formulas of more than 1,000 letters and what has more than forty lines; an entry in the end says
// so.
std::vector<ModelEntry> model_entries(const nlohmann::ordered_json& experiment);
// These as a list of terms, folded where it is longer than twelve lines.
plot::Markup model_markup(const std::vector<ModelEntry>& entries);

// The systems and how many runs; their status; the equations and parameters of the experiment, where
// all runs have the same, set as mathematics.
plot::Markup report_head(std::span<const Run> runs);

}  // namespace courant
