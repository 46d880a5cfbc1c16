// Lie groups among the manifolds, by their Lie algebras.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "courant/manifolds/manifold.hpp"
#include "courant/structures/lie_algebra.hpp"

namespace courant {

// Whether G is a group (Manifold::unit) with left-trivialised vectors and g its Lie algebra in their
// components: [v, w] = -T(v, w), with the torsion of the frame as in CotangentBundle, up to 1e-12.
bool is_group_of(const std::shared_ptr<const Manifold>& G, const LieAlgebra& g);

// SO(3) or SE(3) with the exponential as retraction, Rⁿ or SO(n); null if g is the algebra of none of them.
std::shared_ptr<const Manifold> group_of(const LieAlgebra& g);

// The matrices A(x) (d × d) with A(x y) = A(x) A(y) whose differential at the unit is ρ: rotations on
// copies of Rⁿ for SO(n), of R³ for SO(3) and SE(3), the identity for ρ = 0. `rho` has a matrix for each component of
// a tangent vector of G, or none: d = 0. Empty where no A is known.
using GroupAction = std::function<ExprMatrix(const ExprVector& x)>;
GroupAction group_action(const Manifold& G, const std::vector<MatrixXd>& rho);

}  // namespace courant
