#include "courant/reporting/branch_words.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"

namespace courant {
namespace {

std::string dimensions_of_branch(const LadderReport& ladder) {
  const auto written = [](const std::optional<Index>& number) {
    return number ? std::to_string(*number) : "-";
  };
  std::string text;
  for (const auto& [dim_S, dim_M] : ladder.dimensions())
    text += (text.empty() ? "(" : ", (") + written(dim_S) + "," + written(dim_M) + ")";
  return text;
}

}  // namespace

std::vector<Prose> branches_in_words(const std::vector<BranchReport>& branches) {
  if (branches.empty()) return {};
  const auto chosen = std::ranges::find_if(branches, &BranchReport::is_chosen);
  const std::string count = std::to_string(branches.size());
  std::vector<Prose> lines = {
      chosen == branches.end()
          ? "Branches: S is a union of " + count +
                ", by products among the equations or what follows from them. A \"branch\" beside "
                "\"initial\" restarts the algorithm on one of them:"
          : "This is branch " + std::to_string(chosen->number) + " of " + count +
                ". The algorithm, restarted on each of them:"};
  for (const BranchReport& branch : branches) {
    Prose line = "    " + std::to_string(branch.number) + ": ";
    for (const std::string& equation : branch.equations)
      line +=
          (&equation == &branch.equations.front() ? "" : ", ") + Prose::formula(equation + " = 0");
    const LadderReport& ladder = branch.ladder;
    std::string found;
    if (!branch.problem.empty()) {
      found = branch.problem;
    } else {
      found = to_string(ladder.verdict) + ", " + dimensions_of_branch(ladder);
      if (ladder.verdict == Verdict::regular || ladder.verdict == Verdict::gauge) {
        if (ladder.degrees_of_freedom)
          found += ", " + counted(*ladder.degrees_of_freedom, "degree") + " of freedom";
        found += branch.moved > 0.0 ? ", " + number_text(branch.moved, 3) + " away"
                                    : ", through the initial values";
      }
    }
    lines.push_back(line + " (" + found + ")");
  }
  return lines;
}

}  // namespace courant
