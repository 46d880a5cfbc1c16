#include "courant/reading/coupled_inductors.hpp"

#include <cmath>
#include <map>

namespace courant {

bool couple(const std::vector<NetworkElement>& elements, elements::NetworkAssembly& assembly,
            Findings& findings) {
  std::map<std::string, double> inductances;
  for (const NetworkElement& element : elements)
    if (element.element.inductance) inductances[element.name] = *element.element.inductance;
  const NetworkElement* last = nullptr;
  for (const NetworkElement& element : elements) {
    if (!element.mutual) continue;
    const auto& [first, second] = element.mutual->inductors;
    const auto i = inductances.find(first), j = inductances.find(second);
    if (i == inductances.end() || j == inductances.end() || i == j) {
      const bool is_known = i != inductances.end();
      findings.problem(
          element.pointer + "/inductors",
          "\"" + (is_known ? second : first) + "\" is " +
              (i == j && is_known ? "both of them" : "no inductor that is given by its value") +
              "; expected the names of two such inductors");
      return false;
    }
    const double value = element.mutual->value;
    const bool is_loose = assembly.couple(
        first, second,
        element.mutual->is_coupling ? value
                                    : value / (std::sqrt(i->second) * std::sqrt(j->second)));
    if (!is_loose) {
      findings.problem(element.pointer, "couples the inductors " + first + " and " + second +
                                            " too closely; expected |M| below √(L₁ L₂) (an "
                                            "ideal-transformer couples them wholly)");
      return false;
    }
    last = &element;
  }
  if (assembly.has_positive_inductances()) return true;
  findings.problem(last->pointer,
                   "with the other mutual inductances this makes an inductance matrix that is "
                   "not positive definite; expected weaker coupling");
  return false;
}

}  // namespace courant
