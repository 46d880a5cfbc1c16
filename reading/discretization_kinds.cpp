#include "courant/core/words/message.hpp"
#include "courant/integrators/maps/cayley_midpoint.hpp"
#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/product_map.hpp"
#include "courant/integrators/maps/projected.hpp"
#include "courant/integrators/maps/spherical_midpoint.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/torus.hpp"
#include "courant/reading/method_kinds.hpp"

namespace courant {
namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;
using MapPointer = std::shared_ptr<const DiscretizationMap>;

// The map that a choice gives on M; on T*Q the cotangent lift of the one on Q.
template <class Make>
DiscretizationChoice lifted(std::string description, Make make) {
  return {std::move(description), [make](const ManifoldPointer& manifold) -> MapPointer {
            if (const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(manifold))
              return std::make_shared<CotangentLift>(bundle, make(bundle->base()));
            return make(manifold);
          }};
}

std::optional<DiscretizationChoice> midpoint(ObjectReader&) {
  return lifted("midpoint",
                [](const ManifoldPointer& M) { return std::make_shared<Theta>(M, 0.5); });
}

std::optional<DiscretizationChoice> theta_map(ObjectReader& object) {
  const double theta = object.number("theta");
  return lifted("theta = " + exact_text(theta),
                [theta](const ManifoldPointer& M) { return std::make_shared<Theta>(M, theta); });
}

[[noreturn]] void refuse(const std::string& map, const std::string& home, const Manifold& M) {
  throw std::invalid_argument("the discretization \"" + map + "\" is for " + home +
                              ", but the configurations are on " + M.name() +
                              "; expected \"midpoint\"");
}

// Half a step of the cotangent lift of Theta(0), then half a step of its adjoint.
std::optional<DiscretizationChoice> verlet(ObjectReader&) {
  return DiscretizationChoice{"verlet",
                              [](const ManifoldPointer& M) -> MapPointer {
                                const auto bundle =
                                    std::dynamic_pointer_cast<const CotangentBundle>(M);
                                if (!bundle) refuse("verlet", "cotangent bundles", *M);
                                return std::make_shared<CotangentLift>(
                                    bundle, std::make_shared<Theta>(bundle->base(), 0.0));
                              },
                              true};
}

// A map that only some manifolds have, on M or, factor by factor, on a product of them; flat
// factors get the midpoint map, which is what each of these maps is there.
template <class Make>
MapPointer on_factors(const ManifoldPointer& M, const Make& make) {
  if (const auto product = std::dynamic_pointer_cast<const Product>(M)) {
    std::vector<MapPointer> maps;
    for (const ManifoldPointer& factor : product->factors())
      maps.push_back(on_factors(factor, make));
    return std::make_shared<ProductMap>(product, std::move(maps));
  }
  if (dynamic_cast<const Euclidean*>(M.get()) || dynamic_cast<const Torus*>(M.get()))
    return std::make_shared<Theta>(M, 0.5);
  return make(M);
}

std::optional<DiscretizationChoice> exponential(ObjectReader&) {
  return lifted("exponential", [](const ManifoldPointer& M) {
    if (!M->is_geodesic()) refuse("exponential", "manifolds with the exponential retraction", *M);
    return std::make_shared<Theta>(M, 0.5);
  });
}

// A map that every sphere has.
template <class Map>
DiscretizationChoice on_spheres(const std::string& name) {
  return lifted(name, [name](const ManifoldPointer& manifold) {
    return on_factors(manifold, [&](const ManifoldPointer& M) -> MapPointer {
      if (const auto sphere = std::dynamic_pointer_cast<const Sphere>(M))
        return std::make_shared<Map>(sphere);
      refuse(name, "spheres", *M);
    });
  });
}

std::optional<DiscretizationChoice> chordal(ObjectReader&) {
  return on_spheres<Chordal>("chordal");
}

std::optional<DiscretizationChoice> spherical_midpoint(ObjectReader&) {
  return on_spheres<SphericalMidpoint>("spherical-midpoint");
}

std::optional<DiscretizationChoice> cayley(ObjectReader&) {
  return lifted("cayley", [](const ManifoldPointer& manifold) {
    return on_factors(manifold, [](const ManifoldPointer& M) -> MapPointer {
      if (const auto rotations = std::dynamic_pointer_cast<const SpecialOrthogonal3>(M))
        return std::make_shared<CayleyMidpoint>(rotations);
      if (const auto motions = std::dynamic_pointer_cast<const SpecialEuclidean3>(M))
        return std::make_shared<CayleyMidpoint>(motions);
      if (const auto all = std::dynamic_pointer_cast<const SpecialOrthogonal>(M))
        return std::make_shared<CayleyMidpoint>(all);
      refuse("cayley", "so3, se3 and so", *M);
    });
  });
}

// A map of the surrounding manifold with its ends projected to a submanifold.
std::optional<DiscretizationChoice> projected(ObjectReader& object) {
  const auto map = read_map(object, "map");
  if (!map) return std::nullopt;
  const auto on_submanifold = [make = map->make](const ManifoldPointer& M) -> MapPointer {
    const auto submanifold = std::dynamic_pointer_cast<const ImplicitSubmanifold>(M);
    if (!submanifold) refuse("projected", "implicit submanifolds", *M);
    return std::make_shared<Projected>(submanifold, make(submanifold->surrounding()));
  };
  return lifted("projected " + map->description,
                [on_submanifold](const ManifoldPointer& M) -> MapPointer {
                  return dynamic_cast<const Product*>(M.get()) ? on_factors(M, on_submanifold)
                                                               : on_submanifold(M);
                });
}

}  // namespace

std::optional<DiscretizationChoice> read_map(ObjectReader& object, const std::string& key) {
  auto choice = discretization_kinds().read_key(object, key);
  if (!choice || !choice->is_half) return choice;
  object.optional(key)->problem(
      "is \"verlet\", which is made of two maps; expected one map, such as \"midpoint\"");
  return std::nullopt;
}

Registry<DiscretizationChoice>& discretization_kinds() {
  static Registry<DiscretizationChoice> kinds({
      {{"midpoint", "R_d(x, v) = (R_x(-v/2), R_x(v/2)), symmetric, order 2"}, midpoint},
      {{"verlet",
        "half a step of Theta(0), then half a step of Theta(1), on cotangent bundles: order 2, "
        "symmetric, symplectic; explicit for H = T(p) + V(q), RATTLE with constraints on q"},
       verlet},
      {{"exponential", "midpoint, where the retraction is the exponential map"}, exponential},
      {{"chordal", "the symmetric map (2) of spheres, and of products of them"}, chordal},
      {{"spherical-midpoint", "(x√(1-v²/4) - v/2, x√(1-v²/4) + v/2) on spheres, and products"},
       spherical_midpoint},
      {{"cayley", "midpoint of the Cayley transform on so3, se3 and so, and products"}, cayley},
      {{"projected",
        "(P × P) R_d on an implicit submanifold",
        {default_key("map", takes::kind("discretization"), "midpoint",
                     "R_d, a map of the surrounding manifold")}},
       projected},
      {{"theta",
        "R_d(x, v) = (R_x(-θv), R_x((1-θ)v))",
        {default_key("theta", takes::number(0, 1), 0.5, "θ: 0.5 is symmetric and of order 2")}},
       theta_map},
  });
  return kinds;
}

}  // namespace courant
