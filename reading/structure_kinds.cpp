#include "courant/reading/structure_kinds.hpp"

#include "courant/core/words/message.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/reading/lie_algebra_keys.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/composed.hpp"
#include "courant/structures/distribution.hpp"
#include "courant/structures/gauge_transformed.hpp"
#include "courant/structures/lie_poisson.hpp"
#include "courant/structures/poisson.hpp"
#include "courant/structures/presymplectic.hpp"
#include "courant/structures/product_structure.hpp"
#include "courant/structures/pullback.hpp"
#include "courant/structures/pushforward.hpp"
#include "courant/structures/restricted_bivector.hpp"
#include "courant/structures/restricted_two_form.hpp"

namespace courant {
namespace {

using StructurePointer = std::shared_ptr<const DiracStructure>;

std::optional<StructurePointer> canonical(ObjectReader& object, const StructureSite& site) {
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(site.manifold);
  if (!bundle) {
    object.place().problem("the canonical structure is on " + site.manifold->name() +
                           "; expected a cotangent bundle as manifold");
    return std::nullopt;
  }
  return std::make_shared<CanonicalSymplectic>(bundle);
}

// The key `matrix`, that of a two-form or of a bivector.
std::optional<MatrixField> skew_matrix(ObjectReader& object, const StructureSite& site,
                                       SkewMatrix kind) {
  const auto key = object.required("matrix");
  return key ? read_skew_matrix(*key, site, kind) : std::nullopt;
}

std::optional<StructurePointer> bivector(ObjectReader& object, const StructureSite& site) {
  const auto lambda = skew_matrix(object, site, SkewMatrix::bivector);
  if (!lambda) return std::nullopt;
  return std::make_shared<Poisson>(site.manifold, *lambda);
}

std::optional<StructurePointer> two_form(ObjectReader& object, const StructureSite& site) {
  const auto omega = skew_matrix(object, site, SkewMatrix::form);
  if (!omega) return std::nullopt;
  return std::make_shared<Presymplectic>(site.manifold, *omega);
}

std::optional<StructurePointer> distribution(ObjectReader& object, const StructureSite& site) {
  const auto forms = object.optional("forms"), fields = object.optional("fields");
  if (!forms == !fields) {
    object.place().problem(
        "a distribution has either \"forms\" that vanish on it or \"fields\" that span it; "
        "expected one of the two");
    return std::nullopt;
  }
  const auto rows = read_row_field(forms ? *forms : *fields, site);
  if (!rows) return std::nullopt;
  if (forms)
    return std::make_shared<Distribution>(
        Distribution::annihilated_by(site.manifold, rows->count, rows->field));
  return std::make_shared<Distribution>(
      Distribution::spanned_by(site.manifold, rows->count, rows->field));
}

std::optional<StructurePointer> restricted_two_form(ObjectReader& object,
                                                    const StructureSite& site) {
  const auto omega = skew_matrix(object, site, SkewMatrix::form);
  const auto key = object.required("forms");
  const auto forms = key ? read_row_field(*key, site) : std::nullopt;
  if (!omega || !forms) return std::nullopt;
  return std::make_shared<RestrictedTwoForm>(site.manifold, *omega, forms->count, forms->field);
}

std::optional<StructurePointer> restricted_bivector(ObjectReader& object,
                                                    const StructureSite& site) {
  const auto lambda = skew_matrix(object, site, SkewMatrix::bivector);
  const auto key = object.required("fields");
  const auto fields = key ? read_row_field(*key, site) : std::nullopt;
  if (!lambda || !fields) return std::nullopt;
  return std::make_shared<RestrictedBivector>(site.manifold, *lambda, fields->count, fields->field);
}

std::optional<StructurePointer> lie_poisson(ObjectReader& object, const StructureSite& site) {
  const bool plus = object.word("sign") == "plus";
  const auto algebra = read_lie_algebra(object);
  const auto key = object.optional("representation");
  const auto representation = key ? read_matrices(*key) : std::nullopt;
  if (!algebra || (key && !representation)) return std::nullopt;
  const auto whole = representation ? semidirect(*algebra, *representation, *key) : algebra;
  if (!whole) return std::nullopt;
  const auto sign = plus ? LiePoisson::Sign::plus : LiePoisson::Sign::minus;
  try {
    // On all of Rⁿ it knows what acts on what.
    if (*site.manifold == Euclidean(whole->dimension()))
      return std::make_shared<LiePoisson>(*algebra,
                                          representation.value_or(std::vector<MatrixXd>()), sign);
    return std::make_shared<LiePoisson>(*whole, site.manifold, sign);
  } catch (const std::invalid_argument& error) {
    object.place().problem(without_place(error.what()));
    return std::nullopt;
  }
}

// T*Rⁿ for the canonical structure, Rⁿ for the others.
Json default_manifold(const std::optional<JsonReader>& structure) {
  const bool canonical =
      !structure || structure->value() == "canonical" ||
      (structure->value().is_object() && structure->value().value("type", Json()) == "canonical");
  return canonical ? Json{{"type", "cotangent-bundle"}} : Json{{"type", "euclidean"}};
}

// Whether the manifold of a structure is made of those of its parts.
bool has_parts(const Json& structure) {
  if (!structure.is_object()) return false;
  const Json type = structure.value("type", Json());
  if (type == "gauge") return structure.contains("structure") && has_parts(structure["structure"]);
  return type == "product" || type == "composed";
}

std::optional<StructurePointer> gauge_transformed(ObjectReader& object, const StructureSite& site) {
  const auto matrix_key = object.required("matrix"), key = object.required("structure");
  const auto structure = key ? structure_kinds().read(*key, site) : std::nullopt;
  StructureSite own = site;
  if (structure)
    own.manifold = (*structure)->manifold();
  else if (key && has_parts(key->value()))
    return std::nullopt;  // the size of the matrix is not known
  const auto form =
      matrix_key ? read_skew_matrix(*matrix_key, own, SkewMatrix::form) : std::nullopt;
  if (!form || !structure) return std::nullopt;
  return std::make_shared<GaugeTransformed>(*structure, *form);
}

// Names that coordinates inside a structure may not have.
SymbolTable taken_names(const Vocabulary& vocabulary, bool with_coordinates) {
  Vocabulary::Arguments arguments{.t = Expr(0.0)};
  if (with_coordinates) arguments.x = ExprVector::Ones(vocabulary.coordinates.size());
  SymbolTable taken = vocabulary.symbols(arguments);
  for (const Definition& definition : vocabulary.definitions)
    if (!taken.find(definition.name)) {
      const auto size = static_cast<Index>(definition.formulas.formulas.size());
      taken.add(definition.name, definition.formulas.shape, ExprVector::Ones(size));
    }
  return taken;
}

// The keys `coordinates`, `manifold` and `structure`: a space with names of its own, and a
// structure on it, or on its product with R^ports.
struct StructurePart {
  Space space;
  StructurePointer structure;
};
std::optional<StructurePart> read_structure_part(ObjectReader& object, const Vocabulary& outer,
                                                 SymbolTable& taken, Index ports = 0) {
  const auto key = object.required("structure");
  auto space = read_structure_space(object, outer, taken);
  if (!key || !space) return std::nullopt;
  StructureSite site{space->manifold, outer};
  site.vocabulary.coordinates = space->coordinates;
  if (ports > 0)
    site.manifold = std::make_shared<Product>(std::vector<std::shared_ptr<const Manifold>>{
        space->manifold, std::make_shared<Euclidean>(ports)});
  const auto structure = structure_kinds().read(*key, site);
  if (!structure) return std::nullopt;
  if (ports == 0) space->manifold = (*structure)->manifold();
  return StructurePart{*space, *structure};
}

// The parts in an array, whose coordinates together must be those of the site, in order.
std::optional<std::vector<StructurePart>> read_structure_parts(const JsonReader& value,
                                                               const StructureSite& site,
                                                               Index ports) {
  const auto elements = value.elements();
  if (!elements) return std::nullopt;
  SymbolTable taken = taken_names(site.vocabulary, false);
  std::vector<StructurePart> parts;
  NameList names;
  for (const JsonReader& element : *elements) {
    ObjectReader object(element);
    if (auto part = read_structure_part(object, site.vocabulary, taken, ports)) {
      for (const Declaration& declaration : part->space.coordinates.declarations())
        names.append(declaration);
      parts.push_back(std::move(*part));
    }
  }
  if (parts.size() != elements->size()) return std::nullopt;
  const NameList& expected = site.vocabulary.coordinates;
  if (names.element_names() != expected.element_names()) {
    value.problem("have the coordinates " + word_list(names.element_names()) + "; expected " +
                  word_list(expected.element_names()) + ", those of the whole, in that order");
    return std::nullopt;
  }
  return parts;
}

std::optional<StructurePointer> product_of_parts(ObjectReader& object, const StructureSite& site) {
  const auto key = object.required("factors");
  const auto factors = key ? read_structure_parts(*key, site, 0) : std::nullopt;
  if (!factors) return std::nullopt;
  std::vector<StructurePointer> structures;
  for (const StructurePart& factor : *factors) structures.push_back(factor.structure);
  return std::make_shared<ProductStructure>(std::move(structures));
}

std::optional<StructurePointer> composed_parts(ObjectReader& object, const StructureSite& site) {
  const Index ports = object.integer("ports");
  const auto key = object.required("parts");
  const auto parts = key ? read_structure_parts(*key, site, ports) : std::nullopt;
  if (!parts) return std::nullopt;
  if (parts->size() != 2) {
    key->problem("are " + std::to_string(parts->size()) + "; expected 2");
    return std::nullopt;
  }
  const StructurePart &A = (*parts)[0], &B = (*parts)[1];
  try {
    return std::make_shared<Composed>(A.structure, A.space.manifold, B.structure, B.space.manifold,
                                      ports);
  } catch (const std::invalid_argument& error) {
    key->problem(without_place(error.what()));
    return std::nullopt;
  }
}

// Formulas of the point of a site for the coordinates of a point of `target`, which must be one.
std::optional<SmoothMap> read_map(const JsonReader& value, const StructureSite& site,
                                  const std::shared_ptr<const Manifold>& target) {
  const auto formulas = read_formula_vector(value);
  if (!formulas) return std::nullopt;
  const Index size = formulas->shape[0], expected = target->ambient_dimension();
  if (size != expected) {
    value.problem("has " + std::to_string(size) + " formulas; expected " +
                  std::to_string(expected) + ", one for each coordinate of " + target->name());
    return std::nullopt;
  }
  if (!check_at_point(*formulas, site, value)) return std::nullopt;
  const SmoothMap map(site.manifold, target,
                      [formulas = *formulas, vocabulary = site.vocabulary](const ExprVector& x) {
                        return evaluate(formulas, vocabulary.symbols({.x = x}));
                      });
  const MatrixField column = [&map](const ExprVector& x) { return ExprMatrix(map(x)); };
  for (const MatrixXd& y : sampled(*site.manifold, column)) {
    const double defect = target->point_defect(y.col(0));
    if (defect > 1e-9 * (1 + y.norm())) {
      value.problem("leads away from " + target->name() + ", at a random point by " +
                    number_text(defect) + "; expected a point of it");
      return std::nullopt;
    }
  }
  return map;
}

std::optional<StructurePointer> pulled_back(ObjectReader& object, const StructureSite& site) {
  const auto map_key = object.required("map");
  SymbolTable taken = taken_names(site.vocabulary, true);
  const auto target = read_structure_part(object, site.vocabulary, taken);
  if (!map_key || !target) return std::nullopt;
  const auto map = read_map(*map_key, site, target->space.manifold);
  if (!map) return std::nullopt;
  return std::make_shared<Pullback>(*map, target->structure);
}

std::optional<StructurePointer> pushed_forward(ObjectReader& object, const StructureSite& site) {
  const auto map_key = object.required("map"), section_key = object.required("section");
  SymbolTable taken = taken_names(site.vocabulary, true);
  const auto source = read_structure_part(object, site.vocabulary, taken);
  if (!map_key || !section_key || !source) return std::nullopt;
  StructureSite inner{source->space.manifold, site.vocabulary};
  inner.vocabulary.coordinates = source->space.coordinates;
  const auto map = read_map(*map_key, inner, site.manifold);
  const auto section = read_map(*section_key, site, inner.manifold);
  if (!map || !section) return std::nullopt;
  const MatrixField there_and_back = [&](const ExprVector& y) {
    return ExprMatrix((*map)((*section)(y)) - y);
  };
  for (const MatrixXd& difference : sampled(*site.manifold, there_and_back))
    if (difference.norm() > 1e-9) {
      section_key->problem(
          "is no section: the map leads from it to another point, at a random one " +
          number_text(difference.norm()) + " away; expected map(section(y)) = y");
      return std::nullopt;
    }
  return std::make_shared<Pushforward>(*map, *section, source->structure);
}

}  // namespace

std::optional<Space> read_structure_space(ObjectReader& object, const Vocabulary& vocabulary,
                                          SymbolTable& taken) {
  const auto structure = object.optional("structure");
  if (!structure || !has_parts(structure->value()))
    return read_space(object, default_manifold(structure), vocabulary, taken);
  const auto coordinates = object.required("coordinates");
  if (const auto manifold = object.optional("manifold"))
    manifold->problem("is made of those of the structure's parts; expected no \"manifold\" here");
  NameList names;
  if (!coordinates || !read_names(*coordinates, taken, names)) return std::nullopt;
  if (names.size() == 0) {
    coordinates->expected("at least one name");
    return std::nullopt;
  }
  return Space{std::make_shared<Euclidean>(names.size()), names};
}

Registry<StructurePointer, StructureSite>& structure_kinds() {
  const auto matrix = [](const char* summary) {
    return required_key("matrix", takes::form_matrix(), summary);
  };
  const auto parts = [](const char* name, std::size_t least, std::optional<std::size_t> most) {
    return required_key(name, takes::array_of(takes::structure_part(), least, most),
                        "their coordinates together are those of the whole, in order");
  };
  // Of the other space of a map.
  const std::vector<Key> other = {
      required_key("coordinates", takes::coordinates(), "of the other space"),
      optional_key("manifold", takes::kind("manifold"), "the other space; as of a system"),
      required_key("structure", takes::kind("structure"), "on the other space")};
  const auto with = [](std::vector<Key> keys, const std::vector<Key>& more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
  };
  static Registry<StructurePointer, StructureSite> kinds({
      {{"canonical", "the graph of ω = dq ∧ dp on a cotangent bundle: i_v ω = α"}, canonical},
      {{"two-form",
        "the graph of a two-form: α = ω(x)ᵀ v, as ω♭(u)(v) = ω(u, v)",
        {matrix("ω, skew")}},
       two_form},
      {{"bivector", "the graph of a bivector: v = Λ(x) α", {matrix("Λ, skew")}}, bivector},
      {{"distribution",
        "F ⊕ F°: v ∈ F, α ∈ F°",
        {optional_key("forms", takes::field_rows(), "one-forms that vanish on F"),
         optional_key("fields", takes::field_rows(), "vector fields that span F")},
        {{"forms", "fields"}}},
       distribution},
      {{"restricted-two-form",
        "μ v = 0, α = ωᵀ v + μᵀ λ (Theorem 2.4)",
        {matrix("ω, skew"),
         required_key("forms", takes::field_rows(), "μ, one-forms that vanish on F")}},
       restricted_two_form},
      {{"restricted-bivector",
        "v = Λ α + Xᵀ λ, X α = 0 (Theorem 2.5)",
        {matrix("Λ, skew"),
         required_key("fields", takes::field_rows(), "X, which the covectors vanish on")}},
       restricted_bivector},
      {{"lie-poisson",
        "the dual of a Lie algebra: v is the ad*-bracket of α at the point",
        with(lie_algebra_keys(),
             {optional_key("representation", takes::number_matrices(),
                           "a matrix for each e_i: the semidirect product with the space they act "
                           "on"),
              default_key("sign", takes::word({"minus", "plus"}), "minus",
                          "minus in body coordinates")}),
        {lie_algebra_choice()}},
       lie_poisson},
      {{"gauge",
        "a structure transformed by a two-form B: (v, α − Bᵀ v) is in it",
        {required_key("structure", takes::kind("structure"), "what is transformed"),
         matrix("B, skew")}},
       gauge_transformed},
      {{"product", "(v_i, α_i) ∈ D_i in each factor", {parts("factors", 1, {})}}, product_of_parts},
      {{"composed",
        "(v_A, f, α_A, e) ∈ A and (v_B, −f, α_B, e) ∈ B for some flows f and efforts e",
        {default_key("ports", takes::integer(1), 1,
                     "how many dimensions each part has more, after its coordinates"),
         parts("parts", 2, 2)}},
       composed_parts},
      {{"pullback", "α = φ*β, (Tφ v, β) ∈ a structure at φ(x)",
        with(other, {required_key("map", takes::formula_vector(),
                                  "φ to the other space: formulas for its coordinates, then for "
                                  "their momenta")})},
       pulled_back},
      {{"pushforward", "v = Tφ w, (w, φ*α) ∈ a structure at σ(x)",
        with(other, {required_key("map", takes::formula_vector(),
                                  "φ from the other space: formulas of its coordinates and "
                                  "momenta"),
                     required_key("section", takes::formula_vector(),
                                  "σ to the other space, with φ(σ(x)) = x")})},
       pushed_forward},
  });
  return kinds;
}

}  // namespace courant
