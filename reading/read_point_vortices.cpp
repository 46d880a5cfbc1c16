#include "courant/reading/system_kinds.hpp"
#include "courant/systems/point_vortices.hpp"
#include "courant/systems/spherical_vortices.hpp"

namespace courant {
namespace {

// At least one number (or formula), none of them zero.
std::optional<VectorXd> read_strengths(ObjectReader& system, const SymbolTable& constants) {
  const auto key = system.required("strengths");
  const auto formulas = key ? read_formula_vector(*key) : std::nullopt;
  if (!formulas) return std::nullopt;
  if (formulas->formulas.empty()) {
    key->expected("at least one strength");
    return std::nullopt;
  }
  const auto strengths = evaluate_constants(*formulas, constants, key->findings());
  if (!strengths) return std::nullopt;
  bool right = true;
  for (Index i = 0; i < strengths->size(); ++i) {
    if ((*strengths)[i] != 0.0) continue;
    key->findings().problem(formulas->formulas[static_cast<std::size_t>(i)].pointer,
                            "is 0; expected a strength other than 0 (of a vortex without strength "
                            "the Lagrangian knows nothing)");
    right = false;
  }
  return right ? strengths : std::nullopt;
}

std::optional<std::string> problem_of(const std::optional<std::pair<Index, Index>>& pair) {
  if (!pair) return std::nullopt;
  return "vortices " + std::to_string(pair->first) + " and " + std::to_string(pair->second) +
         " are at one place; expected different places (their energy is infinite)";
}

}  // namespace

std::optional<Model> read_point_vortices(ObjectReader& system) {
  Model model;
  Vocabulary& vocabulary = model.vocabulary =
      read_vocabulary(system, {"strengths", "x", "y", "p_x", "p_y"});
  const std::string form = system.word("form");
  const auto strengths = read_strengths(system, vocabulary.symbols({}));
  if (!strengths) return std::nullopt;

  const PointVortices vortices(*strengths);
  const bool lagrangian = form == "lagrangian";
  vocabulary.parameters.push_back({"strengths", {{vortices.count()}, constants(*strengths)}});
  for (const char* name : {"x", "y"}) vocabulary.coordinates.append({name, {vortices.count()}});
  if (lagrangian)
    for (const char* name : {"p_x", "p_y"})
      vocabulary.coordinates.append({name, {vortices.count()}});
  check_definitions(vocabulary, system.place().findings());

  model.description = std::to_string(vortices.count()) + " point vortices, " +
                      (lagrangian ? "singular Lagrangian" : "Hamiltonian") + " form";
  model.system = lagrangian ? vortices.lagrangian_form() : vortices.hamiltonian_form();
  model.point_problem = [vortices](const VectorXd& x) {
    return problem_of(vortices.coinciding(x.head(2 * vortices.count())));
  };
  return model;
}

std::optional<Model> read_spherical_vortices(ObjectReader& system) {
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system, {"strengths", "x"});
  const auto strengths = read_strengths(system, vocabulary.symbols({}));
  if (!strengths) return std::nullopt;

  const SphericalVortices vortices(*strengths);
  vocabulary.parameters.push_back({"strengths", {{vortices.count()}, constants(*strengths)}});
  vocabulary.coordinates.append({"x", {vortices.count(), 3}});
  check_definitions(vocabulary, system.place().findings());

  model.description = std::to_string(vortices.count()) + " point vortices on the sphere";
  model.system = vortices.system();
  model.point_problem = [vortices](const VectorXd& x) {
    return problem_of(vortices.coinciding(x));
  };
  return model;
}

}  // namespace courant
