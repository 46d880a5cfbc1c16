#include "courant/core/words/message.hpp"
#include "courant/integrators/maps/cayley_midpoint.hpp"
#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/formula_map.hpp"
#include "courant/integrators/maps/group_midpoint.hpp"
#include "courant/integrators/maps/product_map.hpp"
#include "courant/integrators/maps/projected.hpp"
#include "courant/integrators/maps/spherical_midpoint.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/torus.hpp"
#include "courant/reading/method_kinds.hpp"
#include "courant/reading/written_formula.hpp"

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
      if (const auto matrices = std::dynamic_pointer_cast<const MatrixGroup>(M)) {
        try {
          return std::make_shared<GroupMidpoint>(matrices, cayley_map(matrices->algebra()));
        } catch (const std::domain_error&) {  // the transform leaves the group
        }
      }
      refuse("cayley", "so3, se3, so and groups of matrices that leave a form invariant", *M);
    });
  });
}

std::optional<DiscretizationChoice> second_kind(ObjectReader&) {
  return lifted("second-kind", [](const ManifoldPointer& manifold) {
    return on_factors(manifold, [](const ManifoldPointer& M) -> MapPointer {
      if (const auto matrices = std::dynamic_pointer_cast<const MatrixGroup>(M))
        return std::make_shared<GroupMidpoint>(matrices, second_kind_map(matrices->algebra()));
      refuse("second-kind", "groups of matrices", *M);
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

// Formulas of two arrays, x and v or x0 and x1.
struct ArrayFormulas {
  WrittenFormulas formulas;
  const char* names[2];

  ExprVector operator()(const ExprVector& first, const ExprVector& second) const {
    SymbolTable symbols;
    symbols.add(names[0], {first.size()}, first);
    symbols.add(names[1], {second.size()}, second);
    ExprVector result(std::ssize(formulas.formulas));
    for (Index i = 0; i < result.size(); ++i) {
      const WrittenFormula& formula = formulas.formulas[static_cast<std::size_t>(i)];
      try {
        result[i] = evaluate(formula, symbols);
      } catch (const FormulaError& error) {
        throw std::invalid_argument("the discretization \"formula\": in \"" + formula.text +
                                    "\", " + error.what());
      }
    }
    return result;
  }
};

std::optional<DiscretizationChoice> formula_map(ObjectReader& object) {
  const auto read = [&](const char* key) -> std::optional<WrittenFormulas> {
    const auto value = object.optional(key);
    return value ? read_formula_vector(*value) : std::nullopt;
  };
  const auto minus = read("minus"), plus = read("plus"), point = read("point"),
             vector = read("vector");
  if (!minus || !plus) return std::nullopt;
  if (!point != !vector) {
    object.place().problem("has half an inverse; expected both \"point\" and \"vector\", or none");
    return std::nullopt;
  }
  FormulaMap::Formulas formulas{.minus = ArrayFormulas{*minus, {"x", "v"}},
                                .plus = ArrayFormulas{*plus, {"x", "v"}}};
  if (point) {
    formulas.point = ArrayFormulas{*point, {"x0", "x1"}};
    formulas.vector = ArrayFormulas{*vector, {"x0", "x1"}};
  }
  return lifted("formula", [formulas](const ManifoldPointer& M) -> MapPointer {
    try {
      return std::make_shared<FormulaMap>(M, formulas);
    } catch (const std::domain_error& error) {
      throw std::invalid_argument("the discretization \"formula\" is no discretization map of " +
                                  M->name() + ": " + without_place(error.what()));
    }
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
      {{"cayley",
        "midpoint of the Cayley transform on so3, se3, so, se2, su2, sp and others, and products"},
       cayley},
      {{"second-kind",
        "midpoint of coordinates of the second kind, exp(v_1 B_1) … exp(v_n B_n), on se2, su2, sl "
        "and other groups of "
        "matrices, and products"},
       second_kind},
      {{"projected",
        "(P × P) R_d on an implicit submanifold",
        {default_key("map", takes::kind("discretization"), "midpoint",
                     "R_d, a map of the surrounding manifold")}},
       projected},
      {{"formula",
        "R_d(x, v) by formulas of x[0], …, v[0], …; D1 and D2 are checked, and whether it is "
        "symmetric",
        {required_key("minus", takes::formula_vector(), "x⁻, as many as a point has numbers"),
         required_key("plus", takes::formula_vector(), "x⁺"),
         optional_key("point", takes::formula_vector(),
                      "of the inverse, by x0[0], …, x1[0], …: x; without it, Newton's method"),
         optional_key("vector", takes::formula_vector(), "of the inverse: v")}},
       formula_map},
      {{"theta",
        "R_d(x, v) = (R_x(-θv), R_x((1-θ)v))",
        {default_key("theta", takes::number(0, 1), 0.5, "θ: 0.5 is symmetric and of order 2")}},
       theta_map},
  });
  return kinds;
}

}  // namespace courant
