#include "courant/systems/space.hpp"

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"

namespace courant {
namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

std::optional<ManifoldPointer> euclidean(ObjectReader&, const NameList& coordinates) {
  return std::make_shared<Euclidean>(coordinates.size());
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
      {{"cotangent-bundle", "T*Q of a \"base\" Q; the momentum of x is p_x"}, cotangent_bundle_of},
  });
  return kinds;
}

std::optional<Space> cotangent_bundle(const Space& base, SymbolTable& taken,
                                      const JsonReader& coordinates) {
  const Index covector_size = base.manifold->tangent_dimension();
  const bool in_ambient_space = covector_size == base.manifold->ambient_dimension();
  Space space{std::make_shared<CotangentBundle>(base.manifold), base.coordinates};
  for (const Declaration& declaration : base.coordinates.declarations()) {
    Declaration momentum{"p_" + declaration.name, declaration.shape};
    if (!in_ambient_space) momentum.shape = {covector_size};
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
