// Every manifold that the laws are measured on, and how a class that is missing is found.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <typeinfo>
#include <vector>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/hyperbolic.hpp"
#include "courant/manifolds/implicit_submanifold.hpp"
#include "courant/manifolds/matrix_group.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/stiefel.hpp"
#include "courant/manifolds/symmetric_positive_definite.hpp"
#include "courant/manifolds/tangent_bundle.hpp"
#include "courant/manifolds/torus.hpp"

namespace courant::test {

using ManifoldPointer = std::shared_ptr<const Manifold>;

template <class M, class... Arguments>
std::shared_ptr<const M> make(Arguments&&... arguments) {
  return std::make_shared<const M>(std::forward<Arguments>(arguments)...);
}

inline ManifoldPointer product(std::vector<ManifoldPointer> factors) {
  return make<Product>(std::move(factors));
}

// x² + y²/2 + z²/4 = 1
inline ManifoldPointer ellipsoid() {
  return make<ImplicitSubmanifold>(
      "Ellipsoid", make<Euclidean>(3),
      [](const ExprVector& x) {
        return ExprVector(
            ExprVector::Constant(1, square(x[0]) + square(x[1]) / 2.0 + square(x[2]) / 4.0 - 1.0));
      },
      1);
}

// The circle of the sphere that a plane cuts out.
inline ManifoldPointer spherical_circle() {
  return make<ImplicitSubmanifold>(
      "SphericalCircle", make<Sphere>(2),
      [](const ExprVector& x) {
        return ExprVector(ExprVector::Constant(1, x[0] - 0.3 * x[1] - 0.2));
      },
      1);
}

// Groups of matrices, with each map of the algebra.
inline ManifoldPointer group(const MatrixAlgebra& algebra) { return make<MatrixGroup>(algebra); }
inline ManifoldPointer by_cayley(const MatrixAlgebra& algebra) {
  return make<MatrixGroup>(algebra, cayley_map(algebra));
}
inline ManifoldPointer by_second_kind(const MatrixAlgebra& algebra) {
  return make<MatrixGroup>(algebra, second_kind_map(algebra));
}

// so(3), whose points are all entries of matrices.
inline MatrixAlgebra rotation_matrices() {
  std::vector<MatrixXd> basis(3, MatrixXd::Zero(3, 3));
  for (Index k = 0; k < 3; ++k) {
    basis[static_cast<std::size_t>(k)]((k + 2) % 3, (k + 1) % 3) = 1.0;
    basis[static_cast<std::size_t>(k)]((k + 1) % 3, (k + 2) % 3) = -1.0;
  }
  return {"rotations", basis};
}
// The affine maps x ↦ e^a x + b of the line: not unimodular, and no form is invariant.
inline MatrixAlgebra affine_maps() {
  return {"affine", {MatrixXd{{1.0, 0.0}, {0.0, 0.0}}, MatrixXd{{0.0, 1.0}, {0.0, 0.0}}}};
}

// Every class of manifolds/, with each of its retractions, in dimension 0, 1 and more, alone and as
// first and last factor of a product.
inline std::vector<ManifoldPointer> manifold_catalogue() {
  const auto sphere = make<Sphere>(2);
  const auto rotations = make<SpecialOrthogonal3>();
  const auto motions = make<SpecialEuclidean3>();
  const auto torus = make<Torus>(2);
  const auto plane = make<Hyperbolic>(2);
  const auto frames = make<Stiefel>(3, 2);
  return {make<Euclidean>(0),
          make<Euclidean>(1),
          make<Euclidean>(3),
          make<Sphere>(0),
          make<Sphere>(1),
          sphere,
          make<Sphere>(0, Sphere::projective()),
          make<Sphere>(1, Sphere::projective()),
          make<Sphere>(3, Sphere::projective()),
          rotations,
          make<SpecialOrthogonal3>(SpecialOrthogonal3::cayley()),
          motions,
          make<SpecialEuclidean3>(SpecialEuclidean3::cayley()),
          make<SpecialOrthogonal>(1),
          make<SpecialOrthogonal>(2),
          make<SpecialOrthogonal>(4),
          make<Torus>(0),
          make<Torus>(1),
          torus,
          make<Hyperbolic>(0),
          make<Hyperbolic>(1),
          plane,
          make<Stiefel>(1, 1),
          make<Stiefel>(2, 1),
          frames,
          make<Stiefel>(3, 3),
          make<Stiefel>(4, 2),
          make<SymmetricPositiveDefinite>(0),
          make<SymmetricPositiveDefinite>(1),
          make<SymmetricPositiveDefinite>(3),
          group(MatrixAlgebra::se2()),
          by_cayley(MatrixAlgebra::se2()),
          by_second_kind(MatrixAlgebra::se2()),
          group(MatrixAlgebra::su2()),
          by_cayley(MatrixAlgebra::su2()),
          by_second_kind(MatrixAlgebra::su2()),
          group(MatrixAlgebra::heisenberg(1)),
          by_second_kind(MatrixAlgebra::heisenberg(2)),
          group(MatrixAlgebra::sl(2)),
          by_cayley(MatrixAlgebra::sl(2)),
          by_second_kind(MatrixAlgebra::sl(2)),
          group(MatrixAlgebra::sl(3)),
          group(MatrixAlgebra::gl(1)),
          group(MatrixAlgebra::gl(2)),
          group(MatrixAlgebra::sp(2)),
          by_cayley(MatrixAlgebra::sp(2)),
          group(MatrixAlgebra::galilei()),
          group(rotation_matrices()),
          by_cayley(rotation_matrices()),
          group(affine_maps()),
          by_second_kind(affine_maps()),
          product({group(MatrixAlgebra::se2()), make<Euclidean>(1)}),
          make<CotangentBundle>(group(MatrixAlgebra::su2())),
          make<CotangentBundle>(by_cayley(MatrixAlgebra::sl(2))),
          product({}),
          product({sphere, make<Euclidean>(1)}),
          product({make<Euclidean>(0), torus, rotations}),
          product({rotations, frames}),
          product({make<Euclidean>(2), sphere}),
          make<TangentBundle>(torus),
          make<TangentBundle>(sphere),
          make<TangentBundle>(plane),
          make<TangentBundle>(make<TangentBundle>(make<Sphere>(1))),
          make<CotangentBundle>(make<Euclidean>(0)),
          make<CotangentBundle>(make<Euclidean>(1)),
          make<CotangentBundle>(make<Sphere>(0)),
          make<CotangentBundle>(make<Sphere>(1)),
          make<CotangentBundle>(sphere),
          make<CotangentBundle>(rotations),
          make<CotangentBundle>(motions),
          make<CotangentBundle>(plane),
          make<CotangentBundle>(frames),
          make<CotangentBundle>(product({sphere, rotations})),
          product({make<CotangentBundle>(sphere), make<CotangentBundle>(torus)}),
          ellipsoid(),
          spherical_circle(),
          product({ellipsoid(), torus}),
          make<CotangentBundle>(spherical_circle())};
}

// The final classes that derive from one of `bases` in the headers of a folder.
inline std::set<std::string> final_classes(const std::filesystem::path& folder,
                                           const std::string& bases) {
  const std::regex declaration("class (\\w+) final\\s*:\\s*public (?:" + bases + ")\\b");
  std::set<std::string> result;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".hpp") continue;
    std::ifstream file(entry.path());
    const std::string text(std::istreambuf_iterator<char>(file), {});
    for (std::sregex_iterator it(text.begin(), text.end(), declaration), end; it != end; ++it)
      result.insert((*it)[1]);
  }
  return result;
}

// Whether the class courant::`name` is that of the object: its mangled name is
// N7courant<length><name>E.
template <class T>
bool is_of_class(const T& object, const std::string& name) {
  return typeid(object).name() == "N7courant" + std::to_string(name.size()) + name + "E";
}

}  // namespace courant::test
