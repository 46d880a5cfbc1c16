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

// A group of g, with the exponential as retraction where there is one: that of the matrices that g was made of; else
// SO(3), SE(3), Rⁿ or SO(n) if g is the algebra of one of them; else that of the matrices ad(e_i). Null where the
// matrices are dependent, as ad(e_i) of an algebra with a centre, and where equations of their group are not found.
std::shared_ptr<const Manifold> group_of(const LieAlgebra& g);

// The matrices A(x) (d × d) with A(x y) = A(x) A(y) whose differential at the unit is ρ, as polynomials
// of degree 3 at most in the coordinates of x: on SO(n) vectors, tensors of two and three indices and their
// parts (symmetric matrices, two-forms, the algebra itself), on SE(3) also motions of points and forces;
// the identity for ρ = 0. The coefficients are found by least squares from X_a A = A ρ_a for left-invariant
// fields X_a and A(e) = 1, and are exact where they are multiples of 1/24. `rho` has a matrix for each
// component of a tangent vector of G, or none: d = 0. Empty where no such A is found.
using GroupAction = std::function<ExprMatrix(const ExprVector& x)>;
GroupAction group_action(const Manifold& G, const std::vector<MatrixXd>& rho);

}  // namespace courant
