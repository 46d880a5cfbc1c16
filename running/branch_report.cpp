#include "courant/running/branch_report.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "courant/integrators/certificate/branches.hpp"
#include "courant/reading/branch.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant {
namespace {

double distance_of_coordinates(const ImplicitSystem& system, const std::vector<Movement>& moves) {
  const auto& names = system.names().coordinates;
  double squares = 0.0;
  for (const Movement& move : moves)
    if (std::ranges::find(names, move.name) != names.end())
      squares += (move.to - move.from) * (move.to - move.from);
  return std::sqrt(squares);
}

}  // namespace

std::vector<BranchReport> branch_reports(const Experiment& experiment) {
  std::vector<BranchReport> reports;
  const auto chosen = experiment.document.find("branch");
  const Index number = chosen == experiment.document.end() ? 0 : chosen->get<Index>();
  for (const Branch& branch : branches(whole_system(experiment.model))) {
    BranchReport report{.number = std::ssize(reports) + 1,
                        .level = branch.level,
                        .equations = branch.equations,
                        .ladder = {}};
    report.is_chosen = report.number == number;
    Experiment on_branch = experiment;
    on_branch.model.system = branch.system;
    try {
      report.ladder = discrete_ladder_report(consistent_start(on_branch), *branch.system);
      report.moved = distance_of_coordinates(*branch.system, report.ladder.moves);
    } catch (const ExperimentError& error) {
      report.problem = error.problems().front().where + ": " + error.problems().front().what;
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

Json with_branches(Json ladder, const std::vector<BranchReport>& branches) {
  for (const BranchReport& branch : branches) {
    Json entry{{"branch", branch.number},
               {"chosen", branch.is_chosen},
               {"level", branch.level},
               {"equations", branch.equations}};
    if (branch.problem.empty()) {
      const Json of_branch = to_json(branch.ladder);
      entry["verdict"] = of_branch.at("verdict");
      entry["ladder"] = Json::array();
      for (const auto& [dim_S, dim_M] : branch.ladder.dimensions())
        entry["ladder"].push_back({dim_S ? Json(*dim_S) : Json(), dim_M ? Json(*dim_M) : Json()});
      entry["degrees_of_freedom"] = of_branch.at("degrees_of_freedom");
      entry["moved"] = branch.moved;
    } else {
      entry["problem"] = branch.problem;
    }
    ladder["branches"].push_back(std::move(entry));
  }
  return ladder;
}

}  // namespace courant
