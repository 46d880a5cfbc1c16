// What the unknowns and equations of a step are called.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/certificate/local_formulation.hpp"

namespace courant {

// Names of the coordinates, derivatives and equations of a system near a point x₀, in the words of the
// system where the chart has its coordinates (n = N), by number otherwise.
class StepNames {
 public:
  explicit StepNames(const ImplicitSystem& system);

  // prefix + the k-th derivative of each of the n coordinates of the chart.
  std::vector<std::string> tangent(const std::string& prefix, Index order) const;
  std::vector<std::string> auxiliary(Index order) const;
  std::vector<std::string> basis() const;  // of basis_parameters
  // Of reduced_equations, with so many equations.
  std::vector<std::string> equations(Index count) const;
  // Of local.nonzero_equations().
  std::vector<std::string> equations(const LocalFormulation& local) const;

  static std::vector<std::string> numbered(const std::string& name, Index count);
  static std::vector<std::string> each(const std::string& prefix,
                                       const std::vector<std::string>& names);

 private:
  const ImplicitSystem& system_;
};

void append(std::vector<std::string>& names, const std::vector<std::string>& more);

}  // namespace courant
