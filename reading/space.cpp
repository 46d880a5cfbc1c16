#include "courant/reading/space.hpp"

#include <span>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/implicit_submanifold.hpp"
#include "courant/manifolds/matrix_group.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/tangent_bundle.hpp"

namespace courant {
namespace {

// The shapes of the fibre coordinates over `declarations`, which together are the coordinates of Q:
// those of the coordinates where vectors are in R^N; for each factor of a product its own; else one
// array of Ñ, on SE(3) also 3 and 3 for a rotation and a translation that are named apart. Nothing
// where the coordinates are named in another way.
std::optional<std::vector<Shape>> fibre_shapes(const Manifold& Q,
                                               std::span<const Declaration> declarations) {
  std::vector<Shape> shapes;
  if (Q.tangent_dimension() == Q.ambient_dimension()) {
    for (const Declaration& declaration : declarations) shapes.push_back(declaration.shape);
    return shapes;
  }
  if (const auto* submanifold = dynamic_cast<const ImplicitSubmanifold*>(&Q))
    return fibre_shapes(*submanifold->surrounding(), declarations);
  if (const auto* bundle = dynamic_cast<const VectorBundle*>(&Q)) {
    // Over the base and over the fibres the same.
    const auto of_base = fibre_shapes(*bundle->base(), declarations.first(declarations.size() / 2));
    if (!of_base) return std::nullopt;
    shapes = *of_base;
    shapes.insert(shapes.end(), of_base->begin(), of_base->end());
    return shapes;
  }
  if (const auto* factors = dynamic_cast<const Product*>(&Q)) {
    if (factors->factors().size() != declarations.size()) return std::nullopt;
    for (std::size_t i = 0; i < declarations.size(); ++i) {
      const auto of_factor = fibre_shapes(*factors->factors()[i], declarations.subspan(i, 1));
      if (!of_factor) return std::nullopt;
      shapes.push_back(of_factor->front());
    }
    return shapes;
  }
  if (declarations.size() == 1) return std::vector<Shape>{{Q.tangent_dimension()}};
  const bool motion = dynamic_cast<const SpecialEuclidean3*>(&Q) && declarations.size() == 2 &&
                      declarations[0].size() == 9 && declarations[1].size() == 3;
  if (motion) return std::vector<Shape>{{3}, {3}};
  const auto* group = dynamic_cast<const MatrixGroup*>(&Q);
  if (group && group->algebra() == MatrixAlgebra::se2() && declarations.size() == 2 &&
      declarations[0].size() == 4 && declarations[1].size() == 2)
    return std::vector<Shape>{{}, {2}};
  return std::nullopt;
}

// Adds the names of the fibres over Q to those of Q.
bool name_fibres(const VectorBundle& bundle, NameList& names, SymbolTable& taken,
                 const JsonReader& coordinates) {
  const bool velocities = dynamic_cast<const TangentBundle*>(&bundle) != nullptr;
  const std::vector<Declaration> base = names.declarations();
  const auto shapes = fibre_shapes(*bundle.base(), base);
  if (!shapes) {
    coordinates.problem(std::string("do not say what the ") +
                        (velocities ? "velocities" : "momenta") + " on " + bundle.base()->name() +
                        " are called; expected one array for each factor, such as \"R[3][3]\"");
    return false;
  }
  for (std::size_t i = 0; i < shapes->size(); ++i) {
    Declaration fibre{(velocities ? "v_" : "p_") + base[i].name, (*shapes)[i]};
    if (taken.find(fibre.name)) {
      coordinates.problem(std::string("the ") + (velocities ? "velocity" : "momentum") +
                          (velocities ? " over \"" : " of \"") + base[i].name + "\" is \"" +
                          fibre.name + "\", which has a meaning already");
      return false;
    }
    taken.add(fibre.name, fibre.shape, ExprVector::Ones(fibre.size()));
    names.append(std::move(fibre));
  }
  return true;
}

// The names of all coordinates of M: `names`, and on a bundle those of its fibres.
bool name_all(const Manifold& M, NameList& names, SymbolTable& taken,
              const JsonReader& coordinates) {
  const auto* bundle = dynamic_cast<const VectorBundle*>(&M);
  return !bundle || (name_all(*bundle->base(), names, taken, coordinates) &&
                     name_fibres(*bundle, names, taken, coordinates));
}

}  // namespace

std::optional<Space> cotangent_bundle(const Space& base, SymbolTable& taken,
                                      const JsonReader& coordinates) {
  const auto bundle = std::make_shared<CotangentBundle>(base.manifold);
  Space space{bundle, base.coordinates};
  if (!name_fibres(*bundle, space.coordinates, taken, coordinates)) return std::nullopt;
  return space;
}

std::optional<Space> read_space(ObjectReader& system, const Vocabulary& vocabulary,
                                SymbolTable& taken, const std::string& key) {
  return read_space(system, system.declared_default("manifold"), vocabulary, taken, key);
}

std::optional<Space> read_space(ObjectReader& system, const Json& otherwise,
                                const Vocabulary& vocabulary, SymbolTable& taken,
                                const std::string& key) {
  const auto coordinates = system.required(key);
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
  Vocabulary at_point = vocabulary;
  at_point.coordinates = names;
  const auto manifold = manifold_kinds().read(system, "manifold", otherwise, at_point);
  if (!manifold || !name_all(**manifold, names, taken, *coordinates)) return std::nullopt;
  if (names.size() != (*manifold)->ambient_dimension()) {
    coordinates->problem("name " + std::to_string(names.size()) + " numbers; expected " +
                         std::to_string((*manifold)->ambient_dimension()) +
                         ", those of a point of " + (*manifold)->name());
    return std::nullopt;
  }
  return Space{*manifold, names};
}

}  // namespace courant
