#include "courant/reading/coupled_inductors.hpp"

#include <cmath>
#include <tuple>

#include "courant/core/linear/cholesky_decomposition.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/numbers/as_size.hpp"

namespace courant {

std::optional<CoupledInductors> couple(const std::vector<NetworkElement>& elements,
                                       Findings& findings) {
  CoupledInductors coupled;
  const auto member = [&](const std::string& name) -> std::optional<Index> {
    for (std::size_t k = 0; k < coupled.members.size(); ++k)
      if (elements[coupled.members[k]].name == name) return static_cast<Index>(k);
    for (std::size_t k = 0; k < elements.size(); ++k)
      if (elements[k].name == name && elements[k].inductance) {
        coupled.members.push_back(k);
        return static_cast<Index>(coupled.members.size() - 1);
      }
    return std::nullopt;
  };
  std::vector<std::tuple<Index, Index, const NetworkElement*>> pairs;
  for (const NetworkElement& element : elements) {
    if (!element.mutual) continue;
    const auto [first, second] = element.mutual->inductors;
    const auto i = member(first), j = member(second);
    if (i && j && *i != *j) {
      pairs.emplace_back(*i, *j, &element);
      continue;
    }
    findings.problem(element.pointer + "/inductors",
                     "\"" + (i ? second : first) + "\" is " +
                         (i && j ? "both of them" : "no inductor that is given by its value") +
                         "; expected the names of two such inductors");
    return std::nullopt;
  }
  const auto n = static_cast<Index>(coupled.members.size());
  MatrixXd L = MatrixXd::Zero(n, n);
  VectorXd root(n);
  for (Index i = 0; i < n; ++i)
    root[i] = std::sqrt(*elements[coupled.members[as_size(i)]].inductance);
  for (const auto& [i, j, element] : pairs) {
    const double M =
        element->mutual->value / (element->mutual->is_coupling ? 1.0 : root[i] * root[j]);
    L(i, j) += M;
    L(j, i) += M;
    if (std::abs(L(i, j)) < 1.0) continue;
    findings.problem(element->pointer, "couples the inductors " + element->mutual->inductors[0] +
                                           " and " + element->mutual->inductors[1] +
                                           " too closely; expected |M| below √(L₁ L₂) (an "
                                           "ideal-transformer couples them wholly)");
    return std::nullopt;
  }
  L.diagonal().array() += 1.0;
  const CholeskyDecomposition factors(L);
  if (n > 0 && !(factors.is_positive_definite() && LuDecomposition(L).pivot_ratio() > 1e-14)) {
    findings.problem(std::get<2>(pairs.back())->pointer,
                     "with the other mutual inductances this makes an inductance matrix that is "
                     "not positive definite; expected weaker coupling");
    return std::nullopt;
  }
  const MatrixXd half =
      factors.solve_lower(MatrixXd::Identity(n, n)) * root.cwiseInverse().asDiagonal();
  coupled.inverse = half.transpose() * half;
  return coupled;
}

}  // namespace courant
