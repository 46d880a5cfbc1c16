// The energy of inductors that mutual inductances couple.
#pragma once

#include <optional>
#include <vector>

#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/reading/network_element.hpp"

namespace courant {

// ½ φᵀ 𝓛⁻¹ φ of the inductors that mutual inductances couple.
struct CoupledInductors {
  std::vector<std::size_t> members;  // elements
  MatrixXd inverse;

  Expr energy(const ExprVector& flux) const {
    return 0.5 * flux.cwiseProduct(inverse * flux).sum();
  }
};

// The inductors of all mutual inductances among the elements, none if there are none. No value, and a problem, where
// one names no inductor of the elements or the same one twice, or where the inductance matrix 𝓛 is not positive definite.
std::optional<CoupledInductors> couple(const std::vector<NetworkElement>& elements,
                                       Findings& findings);

}  // namespace courant
