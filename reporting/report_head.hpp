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

// A key of an experiment's system, and its formulas as they are written.
struct ModelEntry {
  std::string name;
  std::vector<std::string> formulas;
};
// Formulas of the system, then numbers and parameters: those of ready-made systems are members of
// it. An entry without formulas in the end where something was left out.
std::vector<ModelEntry> model_entries(const nlohmann::ordered_json& experiment);
// A line of an entry: words, or a formula, with = 0 where it is an equation, or L = in front.
Prose model_line(const std::string& key, const std::string& text);

// The systems and how many runs; their status; the equations and parameters of the experiment, where
// all runs have the same, set as mathematics. Formulas of more than 300 characters, and what
// comes after twelve of them, are left to the experiment at the end of the page.
plot::Markup report_head(std::span<const Run> runs);

}  // namespace courant
