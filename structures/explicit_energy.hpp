// The energy of an EnergySystem as a function on its phase space.
#pragma once

#include <optional>

#include "courant/structures/energy_system.hpp"

namespace courant {

// E(x, z, t) of `system` without the velocities in it: E(x, w, λ, t) that is quadratic in some of z, with ∂²E/∂w² that
// contains none of z and ∂E/∂w that does not depend on t, at the w where ∂E/∂w = 0. Of a Lagrangian with a kinetic
// energy, E = ⟨p, w⟩ - L, that is the Hamiltonian, with constraints ∂E/∂λ as before: in the rest of z the result is
// affine. E itself where has_explicit_energy(). Nothing where E is anything else, as for controls that it is not
// quadratic in. `z`: variables.
std::optional<Expr> explicit_energy(const EnergySystem& system, const ExprVector& x,
                                    const ExprVector& z, const Expr& t);

}  // namespace courant
