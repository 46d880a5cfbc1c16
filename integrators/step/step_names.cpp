#include "courant/integrators/step/step_names.hpp"

#include "courant/core/words/text_layout.hpp"
#include "courant/integrators/step/step_formulas.hpp"

namespace courant {

StepNames::StepNames(const ImplicitSystem& system) : system_(system) {}

std::vector<std::string> StepNames::tangent(const std::string& prefix, Index order) const {
  const Manifold& M = *system_.manifold();
  const bool is_flat = M.dimension() == M.ambient_dimension();
  std::vector<std::string> names =
      is_flat ? system_.names().coordinates : numbered("xi", M.dimension());
  for (std::string& name : names) name = prefix + derivative_name(name, order);
  return names;
}

std::vector<std::string> StepNames::auxiliary(Index order) const {
  std::vector<std::string> names = system_.names().auxiliary;
  for (std::string& name : names) name = derivative_name(name, order);
  return names;
}

std::vector<std::string> StepNames::basis() const {
  const Manifold& M = *system_.manifold();
  const bool is_identity = M.dimension() == M.tangent_dimension();
  return numbered("B", is_identity ? 0 : M.tangent_dimension() * M.dimension());
}

std::vector<std::string> StepNames::equations(Index count) const {
  const std::vector<std::string>& names = system_.names().equations;
  if (std::ssize(names) == count) return names;
  // Each tangent block has become n equations, the others follow.
  const Manifold& M = *system_.manifold();
  const Index tangent = M.tangent_dimension(), blocks = system_.tangent_blocks();
  std::vector<std::string> result;
  for (Index b = 0; b < blocks; ++b)
    for (Index i = 0; i < M.dimension(); ++i)
      result.push_back(names[static_cast<std::size_t>(b * tangent)] + ", direction " +
                       std::to_string(i));
  result.insert(result.end(), names.begin() + blocks * tangent, names.end());
  return result;
}

std::vector<std::string> StepNames::equations(const LocalFormulation& local) const {
  std::vector<Index> order(system_.names().equations.size(), 0);
  std::vector<std::string> result;
  for (Index i = 0; i < local.equations.size(); ++i) {
    const auto source = static_cast<std::size_t>(local.source[static_cast<std::size_t>(i)]);
    const Index k = order[source]++;
    const std::string& name = system_.names().equations[source];
    if (local.equations[i].is_constant(0.0)) continue;
    result.push_back(time_derivative(name, k));
  }
  return result;
}

std::vector<std::string> StepNames::numbered(const std::string& name, Index count) {
  std::vector<std::string> names;
  for (Index i = 0; i < count; ++i) names.push_back(name + "[" + std::to_string(i) + "]");
  return names;
}

std::vector<std::string> StepNames::each(const std::string& prefix,
                                         const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (const std::string& name : names) result.push_back(prefix + name);
  return result;
}

void append(std::vector<std::string>& names, const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
}

}  // namespace courant
