#include "courant/running/symmetry_check.hpp"

#include "courant/core/words/message.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant {

std::string SymmetryFinding::why_not_conserved() const {
  if (report.acting.empty()) return "";
  std::string list;
  for (std::size_t i = 0; i < report.acting.size(); ++i)
    list += (i == 0 ? "" : i + 1 == report.acting.size() ? " and " : ", ") + report.acting[i];
  return name +
         " is not expected to be conserved: the energy is invariant, but along the symmetry "
         "there acts " +
         list + ", which changes it (momentum equation).";
}

std::vector<SymmetryFinding> check_symmetries(const Experiment& experiment,
                                              const ConstraintLadder& ladder) {
  std::vector<SymmetryFinding> findings;
  const auto system = std::dynamic_pointer_cast<const DiracSystem>(experiment.model.system);
  if (!system || ladder.verdict == Verdict::inconsistent) return findings;
  for (const DeclaredSymmetry& declared : experiment.symmetries) {
    SymmetryReport report = check_symmetry(*system, declared.symmetry, ladder.point, declared.name);
    for (const LawResult& law : report.laws) {
      if (law.passed()) continue;
      const std::string what = law.law.substr(law.law.find(' ') + 1);
      const auto is = what.rfind(" is ");
      throw ExperimentError(declared.pointer,
                            "is no symmetry: " + what.substr(0, is) + " is not" +
                                what.substr(is + 3) + ", but off by " + number_text(law.defect, 3) +
                                " of the size of its terms at " + law.where +
                                "; expected at most " + number_text(law.bound, 1));
    }
    findings.push_back({declared.name, std::move(report)});
  }
  return findings;
}

}  // namespace courant
