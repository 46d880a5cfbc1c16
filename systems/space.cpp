#include "courant/systems/space.hpp"

#include <span>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/hyperbolic.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/stiefel.hpp"
#include "courant/manifolds/symmetric_positive_definite.hpp"
#include "courant/manifolds/torus.hpp"

namespace courant {
namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

std::optional<ManifoldPointer> euclidean(ObjectReader&, const NameList& coordinates) {
  return std::make_shared<Euclidean>(coordinates.size());
}

std::optional<ManifoldPointer> torus(ObjectReader&, const NameList& coordinates) {
  return std::make_shared<Torus>(coordinates.size());
}

std::optional<ManifoldPointer> sphere(ObjectReader& object, const NameList& coordinates) {
  const bool projective =
      object.word("retraction", "exponential", {"exponential", "projective"}) == "projective";
  return std::make_shared<Sphere>(coordinates.size() - 1,
                                  projective ? Sphere::projective() : Sphere::exponential());
}

std::optional<ManifoldPointer> hyperbolic(ObjectReader&, const NameList& coordinates) {
  return std::make_shared<Hyperbolic>(coordinates.size() - 1);
}

// SO(3) or SE(3), whose retractions have the same names.
template <class Group>
std::optional<ManifoldPointer> read_group(ObjectReader& object) {
  const bool cayley =
      object.word("retraction", "exponential", {"exponential", "cayley"}) == "cayley";
  return std::make_shared<Group>(cayley ? Group::cayley() : Group::exponential());
}

std::optional<ManifoldPointer> rotations(ObjectReader& object, const NameList&) {
  return read_group<SpecialOrthogonal3>(object);
}

std::optional<ManifoldPointer> motions(ObjectReader& object, const NameList&) {
  return read_group<SpecialEuclidean3>(object);
}

std::optional<ManifoldPointer> stiefel(ObjectReader& object, const NameList& coordinates) {
  const auto& declarations = coordinates.declarations();
  if (declarations.size() == 1 && declarations[0].shape.size() == 2 &&
      declarations[0].shape[0] >= declarations[0].shape[1])
    return std::make_shared<Stiefel>(declarations[0].shape[0], declarations[0].shape[1]);
  object.place().problem(
      "the points of a Stiefel manifold are matrices with at least as many rows as columns; "
      "expected coordinates such as \"X[4][2]\"");
  return std::nullopt;
}

std::optional<ManifoldPointer> symmetric_positive_definite(ObjectReader& object,
                                                           const NameList& coordinates) {
  Index n = 1;
  while (n * (n + 1) / 2 < coordinates.size()) ++n;
  if (n * (n + 1) / 2 == coordinates.size()) return std::make_shared<SymmetricPositiveDefinite>(n);
  object.place().problem("a lower triangle does not have " + std::to_string(coordinates.size()) +
                         " entries; expected n(n+1)/2 coordinates, such as \"X[6]\"");
  return std::nullopt;
}

// One factor for each declaration of the coordinates.
std::optional<ManifoldPointer> product_of(ObjectReader& object, const NameList& coordinates) {
  const auto key = object.required("factors");
  const auto elements = key ? key->elements() : std::nullopt;
  if (!elements) return std::nullopt;
  const auto& declarations = coordinates.declarations();
  if (elements->size() != declarations.size()) {
    key->problem("are " + std::to_string(elements->size()) + "; expected one for each of the " +
                 std::to_string(declarations.size()) + " names in \"coordinates\"");
    return std::nullopt;
  }
  std::vector<ManifoldPointer> factors;
  for (std::size_t i = 0; i < elements->size(); ++i) {
    NameList name;
    name.append(declarations[i]);
    const auto factor = manifold_kinds().read((*elements)[i], name);
    if (!factor) continue;
    if ((*factor)->ambient_dimension() == name.size()) {
      factors.push_back(*factor);
    } else {
      (*elements)[i].problem("is " + (*factor)->name() + " with points of " +
                             std::to_string((*factor)->ambient_dimension()) + " numbers, but \"" +
                             declarations[i].name + "\" has " + std::to_string(name.size()));
    }
  }
  if (factors.size() != elements->size()) return std::nullopt;
  return std::make_shared<Product>(std::move(factors));
}

std::optional<ManifoldPointer> cotangent_bundle_of(ObjectReader& object,
                                                   const NameList& coordinates) {
  const auto base = manifold_kinds().read(object, "base", "euclidean", coordinates);
  if (!base) return std::nullopt;
  return std::make_shared<CotangentBundle>(*base);
}

}  // namespace

const Registry<ManifoldPointer, NameList>& manifold_kinds() {
  static const Registry<ManifoldPointer, NameList> kinds({
      {{"euclidean", "Rⁿ, with as many dimensions as there are coordinates"}, euclidean},
      {{"torus", "Tⁿ by n angles"}, torus},
      {{"sphere", "Sⁿ by unit vectors of Rⁿ⁺¹; \"retraction\" exponential or projective"}, sphere},
      {{"hyperbolic", "Hⁿ, the hyperboloid x₀² = 1 + x₁² + … in Rⁿ⁺¹, x₀ > 0"}, hyperbolic},
      {{"so3", "rotations by 3×3 matrices; \"retraction\" exponential or cayley"}, rotations},
      {{"se3", "rigid motions by a rotation matrix and a vector; \"retraction\" as so3"}, motions},
      {{"stiefel", "orthonormal k-frames of Rⁿ by n×k matrices"}, stiefel},
      {{"symmetric-positive-definite", "such n×n matrices by their lower triangle, row after row"},
       symmetric_positive_definite},
      {{"product", "the product of \"factors\", one for each name in \"coordinates\""}, product_of},
      {{"cotangent-bundle", "T*Q of a \"base\" Q; the momentum of x is p_x"}, cotangent_bundle_of},
  });
  return kinds;
}

namespace {

// The shapes of the momenta of `declarations`, which together are the coordinates of Q: those of
// the coordinates where covectors are in R^N; for each factor of a product its own; else one array
// of Ñ, on SE(3) also 3 and 3 for a rotation and a translation that are named apart. Nothing where
// the coordinates are named in another way.
std::optional<std::vector<Shape>> momentum_shapes(const Manifold& Q,
                                                  std::span<const Declaration> declarations) {
  std::vector<Shape> shapes;
  if (Q.tangent_dimension() == Q.ambient_dimension()) {
    for (const Declaration& declaration : declarations) shapes.push_back(declaration.shape);
    return shapes;
  }
  if (const auto* factors = dynamic_cast<const Product*>(&Q)) {
    if (factors->factors().size() != declarations.size()) return std::nullopt;
    for (std::size_t i = 0; i < declarations.size(); ++i) {
      const auto of_factor = momentum_shapes(*factors->factors()[i], declarations.subspan(i, 1));
      if (!of_factor) return std::nullopt;
      shapes.push_back(of_factor->front());
    }
    return shapes;
  }
  if (declarations.size() == 1) return std::vector<Shape>{{Q.tangent_dimension()}};
  const bool motion = dynamic_cast<const SpecialEuclidean3*>(&Q) && declarations.size() == 2 &&
                      declarations[0].size() == 9 && declarations[1].size() == 3;
  if (motion) return std::vector<Shape>{{3}, {3}};
  return std::nullopt;
}

}  // namespace

std::optional<Space> cotangent_bundle(const Space& base, SymbolTable& taken,
                                      const JsonReader& coordinates) {
  Space space{std::make_shared<CotangentBundle>(base.manifold), base.coordinates};
  const auto shapes = momentum_shapes(*base.manifold, base.coordinates.declarations());
  if (!shapes) {
    coordinates.problem("do not say what the momenta on " + base.manifold->name() +
                        " are called; expected one array for each factor, such as \"R[3][3]\"");
    return std::nullopt;
  }
  for (std::size_t i = 0; i < shapes->size(); ++i) {
    const Declaration& declaration = base.coordinates.declarations()[i];
    Declaration momentum{"p_" + declaration.name, (*shapes)[i]};
    if (taken.find(momentum.name)) {
      coordinates.problem("the momentum of \"" + declaration.name + "\" is \"" + momentum.name +
                          "\", which has a meaning already");
      return std::nullopt;
    }
    taken.add(momentum.name, momentum.shape, ExprVector::Ones(momentum.size()));
    space.coordinates.append(std::move(momentum));
  }
  return space;
}

std::optional<Space> read_space(ObjectReader& system, const Json& otherwise, SymbolTable& taken) {
  const auto coordinates = system.required("coordinates");
  NameList names;
  if (!coordinates || !read_names(*coordinates, taken, names)) {
    system.optional("manifold");  // cannot be looked into without coordinates
    return std::nullopt;
  }
  if (names.size() == 0) {
    coordinates->expected("at least one name");
    system.optional("manifold");
    return std::nullopt;
  }
  const auto manifold = manifold_kinds().read(system, "manifold", otherwise, names);
  if (!manifold) return std::nullopt;
  Space space{*manifold, names};
  if (const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(*manifold)) {
    auto with_momenta = cotangent_bundle({bundle->base(), names}, taken, *coordinates);
    if (!with_momenta) return std::nullopt;
    space.coordinates = with_momenta->coordinates;
  }
  if (space.coordinates.size() != (*manifold)->ambient_dimension()) {
    coordinates->problem("name " + std::to_string(space.coordinates.size()) +
                         " numbers; expected " + std::to_string((*manifold)->ambient_dimension()) +
                         ", those of a point of " + (*manifold)->name());
    return std::nullopt;
  }
  return space;
}

}  // namespace courant
