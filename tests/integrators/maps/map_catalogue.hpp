// Every discretization map that the laws are measured on.
#pragma once

#include <memory>
#include <vector>

#include "../../manifolds/catalogue.hpp"
#include "courant/integrators/maps/adjoint.hpp"
#include "courant/integrators/maps/cayley_midpoint.hpp"
#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/formula_map.hpp"
#include "courant/integrators/maps/group_midpoint.hpp"
#include "courant/integrators/maps/product_map.hpp"
#include "courant/integrators/maps/projected.hpp"
#include "courant/integrators/maps/spherical_midpoint.hpp"
#include "courant/integrators/maps/staggered.hpp"
#include "courant/integrators/maps/theta.hpp"

namespace courant::test {

using MapPointer = std::shared_ptr<const DiscretizationMap>;

inline std::shared_ptr<const CotangentLift> lift(const MapPointer& map) {
  return make<CotangentLift>(make<CotangentBundle>(map->manifold()), map);
}

// S: an ImplicitSubmanifold.
inline MapPointer projected(const ManifoldPointer& S, double theta) {
  const auto submanifold = std::dynamic_pointer_cast<const ImplicitSubmanifold>(S);
  return make<Projected>(submanifold, make<Theta>(submanifold->surrounding(), theta));
}

inline MapPointer by_cayley_midpoint(const MatrixAlgebra& algebra) {
  return make<GroupMidpoint>(make<MatrixGroup>(algebra), cayley_map(algebra));
}
inline MapPointer by_second_kind_midpoint(const MatrixAlgebra& algebra) {
  return make<GroupMidpoint>(make<MatrixGroup>(algebra), second_kind_map(algebra));
}

// x + factor v, bent by a quarter of v_0 v_1.
inline FormulaMap::Map stretched(double factor) {
  return [factor](const ExprVector& x, const ExprVector& v) {
    ExprVector y = x + Expr(factor) * v;
    y[1] += 0.25 * factor * v[0] * v[1];
    return y;
  };
}

// Maps of manifolds that are not cotangent bundles, in dimension 0, 1 and more: explicit, implicit
// and symmetric ones, with closed inverses and without, geodesic and not.
inline std::vector<MapPointer> base_map_catalogue() {
  const auto space = make<Euclidean>(3);
  const auto sphere = make<Sphere>(2);
  const auto projective = make<Sphere>(2, Sphere::projective());
  const auto rotations = make<SpecialOrthogonal3>();
  const auto cayley = make<SpecialOrthogonal3>(SpecialOrthogonal3::cayley());
  const auto motions = make<SpecialEuclidean3>();
  const auto torus = make<Torus>(2);
  const auto frames = make<Stiefel>(3, 2);
  const auto pair = make<Product>(std::vector<ManifoldPointer>{sphere, rotations});
  return {make<Theta>(make<Euclidean>(0)),
          make<Theta>(make<Euclidean>(1)),
          make<Theta>(space, 0.0),
          make<Theta>(space, 0.3),
          make<Theta>(space, 1.0),
          make<Theta>(make<Sphere>(1)),
          make<Theta>(sphere, 0.0),
          make<Theta>(sphere, 0.3),
          make<Theta>(sphere, 0.5),
          make<Theta>(sphere, 1.0),
          make<Theta>(projective, 0.5),
          make<Theta>(rotations, 0.0),
          make<Theta>(rotations, 0.7),
          make<Theta>(rotations, 0.5),
          make<Theta>(rotations, 1.0),
          make<Theta>(cayley, 0.0),
          make<Theta>(motions, 0.5),
          make<Theta>(torus, 0.5),
          make<Theta>(make<Hyperbolic>(2), 0.5),
          make<Theta>(frames, 0.0),
          make<Theta>(frames, 0.5),
          make<Theta>(make<SymmetricPositiveDefinite>(2), 0.5),
          make<Theta>(ellipsoid(), 0.5),
          make<Theta>(make<TangentBundle>(sphere), 0.5),
          make<Chordal>(sphere),
          make<Chordal>(make<Sphere>(1)),
          make<Chordal>(projective),
          make<SphericalMidpoint>(sphere),
          make<SphericalMidpoint>(make<Sphere>(1)),
          make<CayleyMidpoint>(rotations),
          make<CayleyMidpoint>(cayley),
          make<CayleyMidpoint>(motions),
          make<CayleyMidpoint>(make<SpecialOrthogonal>(2)),
          make<CayleyMidpoint>(make<SpecialOrthogonal>(3)),
          make<Theta>(group(MatrixAlgebra::se2()), 0.3),
          make<Theta>(group(MatrixAlgebra::sl(2)), 0.5),
          make<Theta>(by_cayley(MatrixAlgebra::sl(2)), 0.5),
          make<Theta>(by_second_kind(MatrixAlgebra::su2()), 0.3),
          by_cayley_midpoint(MatrixAlgebra::se2()),
          by_cayley_midpoint(MatrixAlgebra::sl(2)),
          by_second_kind_midpoint(MatrixAlgebra::se2()),
          by_second_kind_midpoint(MatrixAlgebra::heisenberg(1)),
          make<FormulaMap>(make<Euclidean>(2),
                           FormulaMap::Formulas{.minus = stretched(-0.4), .plus = stretched(0.6)}),
          projected(ellipsoid(), 0.5),
          projected(ellipsoid(), 0.3),
          projected(spherical_circle(), 0.5),
          make<Adjoint>(make<Theta>(rotations, 0.2)),
          make<Adjoint>(make<Theta>(space, 0.0)),
          make<Staggered>(space, Eigen::Vector3d(0.0, 1.0, 0.0)),
          make<Staggered>(space, Eigen::Vector3d(0.0, 1.0, 0.3)),
          make<Staggered>(torus, Eigen::Vector2d(0.5, 0.5)),
          make<ProductMap>(
              make<Product>(std::vector<ManifoldPointer>{space, rotations}),
              std::vector<MapPointer>{make<Theta>(space, 0.0), make<Theta>(rotations, 0.0)}),
          make<Adjoint>(make<Chordal>(sphere)),
          make<ProductMap>(pair, std::vector<MapPointer>{make<Chordal>(sphere),
                                                         make<CayleyMidpoint>(rotations)}),
          make<ProductMap>(pair, std::vector<MapPointer>{make<Theta>(sphere, 0.0),
                                                         make<Theta>(rotations, 0.5)})};
}

// Maps of cotangent bundles that are no lifts.
inline std::vector<MapPointer> other_map_catalogue() {
  const auto phase_space = make<CotangentBundle>(make<Sphere>(2));
  return {make<Theta>(phase_space, 0.5),
          make<Theta>(make<CotangentBundle>(make<SpecialOrthogonal3>()), 0.5),
          make<Adjoint>(lift(make<Theta>(make<Sphere>(2), 0.0))),
          make<Adjoint>(lift(make<CayleyMidpoint>(make<SpecialOrthogonal3>()))),
          make<Adjoint>(lift(make<Theta>(make<Euclidean>(2), 0.0)))};
}

}  // namespace courant::test
