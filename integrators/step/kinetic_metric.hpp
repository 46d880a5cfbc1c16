// The metric of a system's kinetic energy.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "courant/integrators/step/projector.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// g of the kinetic energy ½ g^{ij} p_i p_j = ½ g_{ij} w^i w^j, for k momenta and the velocities that belong to them:
// formulas of the point, k × k. Where k numbers stand for fewer dimensions, as those of T*S², both are 1 across.
struct KineticMetric {
  Projector::MatrixFormula lower;  // g_{ij}: velocities to momenta
  Projector::MatrixFormula raise;  // g^{ij}
};

// The metric of `momenta`, which are entries of tangent vectors of M. If the system has an energy H, it is g^{ij} =
// ∂²H/∂p², unless this depends on these momenta, on unknowns or on t. If it is that of a Lagrangian on T*Q, it is
// g_{ij} = ∂²L/∂w², if this depends on q alone. Nothing where neither is positive definite at x.
std::optional<KineticMetric> kinetic_metric(const std::shared_ptr<const ImplicitSystem>& system,
                                            const std::vector<Index>& momenta, const VectorXd& x);

}  // namespace courant
