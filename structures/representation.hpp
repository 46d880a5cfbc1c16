// Representations of Lie algebras that are made of others.
#pragma once

#include <vector>

#include "courant/structures/lie_algebra.hpp"

namespace courant {

// ρ(e_i) on V = R^d, d × d each, with ρ([a, b]) = ρ(a) ρ(b) - ρ(b) ρ(a); LieAlgebra::semidirect checks it.
using Representation = std::vector<Eigen::MatrixXd>;

// On g itself: ad(e_i).
Representation adjoint_representation(const LieAlgebra& g);

// On V*: -ρᵀ.
Representation dual(const Representation& rho);

// On symmetric matrices S, S ↦ ρ S + S ρᵀ, by their entries S_ij, i ≤ j, row by row: d (d + 1) / 2.
Representation symmetric_square(const Representation& rho);

// On skew matrices W, W ↦ ρ W + W ρᵀ, by their entries W_ij, i < j, row by row: d (d - 1) / 2.
Representation exterior_square(const Representation& rho);

}  // namespace courant
