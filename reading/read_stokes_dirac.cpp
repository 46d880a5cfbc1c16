#include <algorithm>
#include <stdexcept>

#include "courant/core/language/declaration.hpp"
#include "courant/core/words/message.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/reading/cell_formulas.hpp"
#include "courant/reading/complex_keys.hpp"
#include "courant/reading/field_boundary.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/stokes_dirac/stokes_dirac_system.hpp"

namespace courant {
namespace {

using At = CellFormulas::At;

// A formula for each of the states that an object names.
using OfStates = std::vector<std::pair<At, WrittenFormula>>;

std::optional<OfStates> read_of_states(const JsonReader& key,
                                       const std::vector<std::string>& states) {
  OfStates formulas;
  const auto entries = key.entries();
  if (!entries) return std::nullopt;
  for (const auto& [name, value] : *entries) {
    const auto found = std::find(states.begin(), states.end(), name);
    if (found == states.end()) {
      value.problem("is of \"" + name + "\"; expected one of the states");
      return std::nullopt;
    }
    const auto formula = read_formula(value);
    if (!formula) return std::nullopt;
    formulas.emplace_back(found == states.begin() ? At::p : At::q, *formula);
  }
  return formulas;
}

// Names without sizes: one or two of them.
std::optional<std::vector<std::string>> read_field_names(const JsonReader& key, SymbolTable& taken,
                                                         std::size_t least, std::size_t most) {
  NameList list;
  if (!read_names(key, taken, list)) return std::nullopt;
  std::vector<std::string> names;
  for (const Declaration& declaration : list.declarations()) {
    if (!declaration.shape.empty()) {
      key.problem("\"" + declaration.name + "\" has a size; expected names alone");
      return std::nullopt;
    }
    names.push_back(declaration.name);
  }
  if (names.size() >= least && names.size() <= most) return names;
  key.problem("has " + std::to_string(names.size()) + " names; expected " + std::to_string(least) +
              (least == most ? "" : " or " + std::to_string(most)));
  return std::nullopt;
}

// Whether a coefficient is right, and negative at no cell where it is a number; a problem where not.
bool is_coefficient(const CellFormulas& formulas, At at, const WrittenFormula& formula,
                    Index dimension, Findings& findings) {
  if (!formulas.is_right(at, formula, false, findings)) return false;
  const Graph graph;
  for (const Expr& value :
       formulas.at_cells(at, formula, graph.variables("x", dimension), std::nullopt))
    if (value.is_constant() && !(value.value() >= 0.0)) {
      findings.problem(formula.pointer, "has the value " + number_text(value.value()) +
                                            " at a cell; expected at least 0");
      return false;
    }
  return true;
}

// Everything that is said of the fields, read and right.
struct Fields {
  std::shared_ptr<const StokesDirac> structure;
  std::vector<std::string> states, efforts;
  std::shared_ptr<const CellFormulas> formulas;
  OfStates energy, resistance;
  std::optional<WrittenFormula> conductivity;
  bool is_of_heat = false;
};

// Σ |σ||⋆σ| density.
std::shared_ptr<const GeneratingFamily> energy_of(const Fields& fields, Index dimension) {
  return std::make_shared<Hamiltonian>(
      std::make_shared<Euclidean>(dimension), [fields](const ExprVector& x, const Expr& t) {
        Expr sum = 0.0;
        for (const auto& [at, formula] : fields.energy)
          sum += constants(fields.formulas->volumes(at))
                     .cwiseProduct(fields.formulas->at_cells(at, formula, x, t))
                     .sum();
        return sum;
      });
}

// |⋆σ|/|σ| of p and |σ|/|⋆σ| of q: what makes numbers of cells of coefficients; the inverse is that of conductivities.
VectorXd loss_sizes(const CellFormulas& formulas, At at) {
  const VectorXd& sizes = formulas.form(at).sizes;
  return sizes.cwiseProduct(sizes).cwiseQuotient(formulas.volumes(at));
}

StokesDiracSystem::Coefficients resistance_of(const Fields& fields, Index dimension) {
  if (fields.resistance.empty()) return {};
  return [fields, dimension](const ExprVector& x) {
    ExprVector r = ExprVector::Zero(dimension);
    for (const auto& [at, formula] : fields.resistance) {
      const VectorXd sizes = loss_sizes(*fields.formulas, at);
      const ExprVector values = fields.formulas->at_cells(at, formula, x, std::nullopt);
      const Index first = at == At::p ? 0 : fields.structure->p_count();
      r.segment(first, sizes.size()) += constants(sizes).cwiseProduct(values);
    }
    return r;
  };
}

std::optional<StokesDiracSystem::Conduction> conduction_of(const Fields& fields) {
  if (!fields.conductivity) return std::nullopt;
  return StokesDiracSystem::Conduction{
      [fields](const ExprVector& x) {
        const VectorXd sizes = loss_sizes(*fields.formulas, At::q).cwiseInverse();
        return ExprVector(constants(sizes).cwiseProduct(
            fields.formulas->at_cells(At::q, *fields.conductivity, x, std::nullopt)));
      },
      fields.is_of_heat};
}

// Constants beside each form: x_<name>, y_<name>, z_<name>, the centres of its cells, and size_<name>, what its numbers
// are divided by for its components.
void add_geometry(const std::string& name, const MatrixXd& positions, const VectorXd& sizes,
                  Vocabulary& vocabulary) {
  const auto add = [&](const std::string& word, const VectorXd& numbers) {
    NameList names;
    names.append({word, {numbers.size()}});
    vocabulary.derived.push_back(
        {names,
         [values = constants(numbers)](const Vocabulary::Arguments&) -> std::optional<ExprVector> {
           return values;
         }});
  };
  for (Index a = 0; a < 3; ++a) add(std::string(1, "xyz"[a]) + "_" + name, positions.col(a));
  add("size_" + name, sizes);
}

// Quantities of the kind: efforts, and the outputs of ports.
void add_quantities(const Fields& fields, const std::shared_ptr<const StokesDiracSystem>& system,
                    Vocabulary& vocabulary) {
  const auto effort_at = [system](const Vocabulary::Arguments& at) {
    return at.effort ? *at.effort : system->effort(*at.x, *at.z, *at.t);
  };
  const Index p = fields.structure->p_count(), q = fields.structure->q_count();
  NameList efforts;
  efforts.append({fields.efforts[0], {p}});
  efforts.append({fields.efforts[1], {q}});
  vocabulary.derived.push_back(
      {efforts,
       [system, effort_at, p](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
         if (!at.x || !at.z || !at.t) return std::nullopt;
         const ExprVector alpha = effort_at(at);
         ExprVector all(p + system->stokes_dirac()->q_count());
         all << alpha.head(p), system->flux(*at.x, alpha, *at.z, *at.t);
         return all;
       }});
  if (system->port_count() > 0) {
    NameList outputs;
    for (const Declaration& input : vocabulary.unknowns.declarations())
      outputs.append({"y" + input.name.substr(1), {}});
    vocabulary.derived.push_back(
        {outputs,
         [system, effort_at](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
           if (!at.x || !at.z || !at.t) return std::nullopt;
           return system->output(*at.x, effort_at(at), *at.z);
         }});
  }
}

// Whether all names that the fields bring are new; a problem where not.
bool are_new(const Vocabulary& vocabulary, SymbolTable taken, const JsonReader& place) {
  const auto take = [&](const NameList& names) {
    return take_new_names(names, "the fields", taken, place);
  };
  return take(vocabulary.unknowns) &&
         std::ranges::all_of(vocabulary.derived, take, &Vocabulary::Derived::names);
}

}  // namespace

std::optional<Model> read_stokes_dirac(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system, {"x", "y", "z"});
  const auto complex_key = system.required("complex");
  const auto regions_key = system.optional("regions");
  const Index degree = system.integer("degree");
  const auto states_key = system.required("states");
  const auto efforts_key = system.required("efforts");
  const auto energy_key = system.required("energy");
  const auto resistance_key = system.optional("resistance");
  const auto conductivity_key = system.optional("conductivity");
  const auto heat_key = system.optional("heat_conductivity");
  const auto boundary_key = system.optional("boundary");
  if (!complex_key || !states_key || !efforts_key || !energy_key) return std::nullopt;
  if (conductivity_key && heat_key) {
    heat_key->problem("is there beside \"conductivity\"; expected one of them");
    return std::nullopt;
  }
  const bool conducts = conductivity_key || heat_key;

  auto complex = read_complex(*complex_key, vocabulary);
  if (complex && regions_key) complex = with_regions(*complex, *regions_key, vocabulary);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  for (const char* name : {"x", "y", "z"}) taken.add(name, 0.0);
  for (const Definition& definition : vocabulary.definitions)
    if (!taken.find(definition.name)) taken.add(definition.name, 0.0);
  Fields fields;
  const std::size_t count = conducts ? 1 : 2;
  const auto states = read_field_names(*states_key, taken, count, count);
  SymbolTable with_efforts = taken;
  const auto efforts = read_field_names(*efforts_key, with_efforts, 2, 2);
  if (!complex || !states || !efforts) return std::nullopt;
  if (degree >= complex->dimension()) {
    system.place().problem("has the degree " + std::to_string(degree) +
                           " on a complex of dimension " + std::to_string(complex->dimension()) +
                           "; expected a lower degree");
    return std::nullopt;
  }
  fields.states = *states;
  fields.efforts = *efforts;
  const auto shared = std::make_shared<const CellComplex>(std::move(*complex));
  const auto conditions = boundary_key ? read_boundary(*boundary_key, *shared, degree,
                                                       fields.efforts, heat_key.has_value())
                                       : std::optional(std::vector<RegionCondition>());
  const auto energy = read_of_states(*energy_key, fields.states);
  const auto resistance =
      resistance_key ? read_of_states(*resistance_key, fields.states) : std::optional(OfStates());
  if (!conditions || !energy || !resistance) return std::nullopt;
  fields.energy = *energy;
  fields.resistance = *resistance;
  fields.is_of_heat = heat_key.has_value();
  if (conducts) {
    fields.conductivity = read_formula(heat_key ? *heat_key : *conductivity_key);
    if (!fields.conductivity) return std::nullopt;
  }
  fields.structure = std::make_shared<StokesDirac>(shared, degree, effort_cells(*conditions));
  fields.formulas = std::make_shared<CellFormulas>(fields.structure, fields.states, vocabulary);
  const Index p = fields.structure->p_count(), q = fields.structure->q_count();
  const Index dimension = conducts ? p : p + q;
  bool right = true;
  for (const auto& [at, formula] : fields.energy)
    right = fields.formulas->is_right(at, formula, true, findings) && right;
  for (const auto& [at, formula] : fields.resistance)
    right = is_coefficient(*fields.formulas, at, formula, dimension, findings) && right;
  if (conducts)
    right =
        is_coefficient(*fields.formulas, At::q, *fields.conductivity, dimension, findings) && right;

  StokesDiracSystem::Setting setting;
  right = add_boundary(*conditions, *fields.structure, vocabulary.of_time(), setting, findings) &&
          right;
  if (!right) return std::nullopt;

  vocabulary.coordinates.append({fields.states[0], {p}});
  if (!conducts) vocabulary.coordinates.append({fields.states[1], {q}});
  for (const StokesDiracSystem::Port& port : setting.ports)
    vocabulary.unknowns.append({"u_" + port.name, {}});
  setting.resistance = resistance_of(fields, dimension);
  setting.conduction = conduction_of(fields);
  const auto whole =
      std::make_shared<StokesDiracSystem>(fields.structure, energy_of(fields, dimension), setting,
                                          vocabulary.coordinates.element_names());
  model.system = whole;
  model.description = "conservation laws on " + std::to_string(shared->count(shared->dimension())) +
                      " cells of dimension " + std::to_string(shared->dimension());
  model.starts_at_zero = true;
  add_quantities(fields, whole, vocabulary);
  for (const At at : {At::p, At::q}) {
    const CellForm& form = fields.formulas->form(at);
    const std::size_t i = at == At::p ? 0 : 1;
    if (i < fields.states.size())
      add_geometry(fields.states[i], form.positions, form.sizes, vocabulary);
    add_geometry(fields.efforts[i], form.positions,
                 fields.formulas->volumes(at).cwiseQuotient(form.sizes), vocabulary);
  }
  if (!are_new(vocabulary, taken, system.place())) return std::nullopt;
  check_definitions(vocabulary, findings);
  return model;
}

}  // namespace courant
