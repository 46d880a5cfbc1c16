#include "courant/core/linear/symmetric_eigenvalues.hpp"
#include "courant/core/words/message.hpp"
#include "courant/reading/space.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"

namespace courant {
namespace {

// Whether R(x) is symmetric and positive semidefinite at some random points; a problem where not.
bool is_resistive(const Manifold& manifold, const MatrixField& R, const JsonReader& place) {
  for (const MatrixXd& A : sampled(manifold, R)) {
    const double size = A.cwiseAbs().maxCoeff();
    if ((A - A.transpose()).cwiseAbs().maxCoeff() > 1e-12 * size) {
      place.problem("is not symmetric at a random point; expected R = Rᵀ");
      return false;
    }
    const double least = symmetric_eigenvalues(A).minCoeff();
    if (least < -1e-12 * size) {
      place.problem("is not positive semidefinite: an eigenvalue at a random point is " +
                    number_text(least) + "; expected at least 0");
      return false;
    }
  }
  return true;
}

// "u", or "u[m]" where there are several ports; u_<name> for each where they have names.
NameList port_variables(const std::string& letter, Index count,
                        const std::vector<std::string>& port_names) {
  NameList names;
  if (count == 0) return names;
  if (port_names.empty()) {
    Declaration declaration{letter, {}};
    if (count > 1) declaration.shape = {count};
    names.append(std::move(declaration));
  }
  for (const std::string& name : port_names) names.append({letter + "_" + name, {}});
  return names;
}

bool is_free(const NameList& names, const SymbolTable& taken,
             const std::vector<Definition>& definitions) {
  for (const Declaration& declaration : names.declarations()) {
    if (taken.find(declaration.name)) return false;
    for (const Definition& definition : definitions)
      if (definition.name == declaration.name) return false;
  }
  return true;
}

// The m names of the ports, or none.
std::optional<std::vector<std::string>> read_port_names(const std::optional<JsonReader>& key,
                                                        Index m) {
  std::vector<std::string> names;
  if (!key) return names;
  NameList list;
  SymbolTable known;
  if (!read_names(*key, known, list)) return std::nullopt;
  for (const Declaration& declaration : list.declarations()) {
    if (!declaration.shape.empty()) {
      key->problem("\"" + declaration.name + "\" has a size; expected a name for each port");
      return std::nullopt;
    }
    names.push_back(declaration.name);
  }
  if (static_cast<Index>(names.size()) == m) return names;
  key->problem("has " + std::to_string(names.size()) + " names; expected one for each of the " +
               std::to_string(m) + " columns of B");
  return std::nullopt;
}

}  // namespace

// ẋ = (J - R) dH + B u, y = Bᵀ dH + D u with open or closed ports.
std::optional<Model> read_port_hamiltonian(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto space = read_space(system, vocabulary, taken);
  const auto hamiltonian_key = system.required("hamiltonian");
  const auto hamiltonian = hamiltonian_key ? read_formula(*hamiltonian_key) : std::nullopt;
  const auto J_key = system.required("J");
  const auto R_key = system.optional("R");
  const auto B_key = system.optional("B");
  const auto D_key = system.optional("D");
  const bool open = system.word("ports") == "open";
  const auto names_key = system.optional("port_names");
  const auto inputs_key = open ? system.required("inputs") : system.optional("inputs");
  if (!open && inputs_key)
    inputs_key->problem("is for open ports; expected \"ports\": \"open\" beside it");
  if (!space || !J_key) return std::nullopt;

  vocabulary.coordinates = space->coordinates;
  const StructureSite site{space->manifold, vocabulary};
  const Index n = space->manifold->tangent_dimension();
  const auto J = read_skew_matrix(*J_key, site, SkewMatrix::bivector);
  const auto R = R_key ? read_matrix_field(*R_key, site, n, n) : std::nullopt;
  std::optional<MatrixField> B;
  Index m = 0;
  if (B_key) {
    if (const auto columns = read_column_field(*B_key, site)) {
      B = columns->field;
      m = columns->count;
    }
  } else {
    B = [n](const ExprVector&) { return ExprMatrix(ExprMatrix::Zero(n, 0)); };
  }
  const auto D = D_key && B ? read_matrix_field(*D_key, site, m, m) : std::nullopt;
  const auto port_names = read_port_names(names_key, m);
  if (!J || !B || (R_key && !R) || (D_key && !D) || !port_names) return std::nullopt;
  const bool right = !R || is_resistive(*space->manifold, *R, *R_key);
  const JsonReader& ports_place = B_key ? *B_key : system.place();
  vocabulary.unknowns = port_variables("u", m, *port_names);
  if (!take_new_names(vocabulary.unknowns, "the ports", taken, ports_place)) return std::nullopt;
  check_definitions(vocabulary, findings);

  Graph graph;
  const SymbolTable symbols = vocabulary.symbols(
      {.x = graph.variables("x", vocabulary.coordinates.size()), .t = graph.variable("t")});
  const bool energy_right = hamiltonian && check(*hamiltonian, symbols, findings);

  // Inputs are formulas in t, the parameters and the outputs, y or y[m].
  std::optional<PortHamiltonianSystem::Input> input;
  bool inputs_right = true;
  if (open && inputs_key) {
    const auto formulas = read_formula_vector(*inputs_key);
    inputs_right = formulas.has_value();
    if (formulas && static_cast<Index>(formulas->formulas.size()) != m) {
      inputs_key->problem("has " + std::to_string(formulas->formulas.size()) +
                          " formulas; expected one for each of the " + std::to_string(m) +
                          " columns of B");
      inputs_right = false;
    }
    const NameList outputs = port_variables("y", m, *port_names);
    const Vocabulary words = vocabulary.of_time();
    SymbolTable known = words.symbols({.t = Expr(0.0)});
    if (!take_new_names(outputs, "the ports", known, *inputs_key)) return std::nullopt;
    const auto table = [words, outputs](const Expr& t, const ExprVector& y) {
      SymbolTable result = words.symbols({.t = t});
      outputs.add_to(result, y);
      return result;
    };
    if (inputs_right &&
        check(*formulas, table(graph.variable("t"), graph.variables("y", m)), findings))
      input = [formulas = *formulas, table](const Expr& t, const ExprVector& y) {
        return evaluate(formulas, table(t, y));
      };
    else
      inputs_right = false;
  }
  if (!right || !energy_right || !inputs_right) return std::nullopt;

  const auto energy = std::make_shared<Hamiltonian>(
      space->manifold, [formula = *hamiltonian, vocabulary](const ExprVector& x, const Expr& t) {
        return evaluate(formula, vocabulary.symbols({.x = x, .t = t}));
      });
  model.description = "port-Hamiltonian system with " + std::string(open ? "open" : "closed") +
                      " ports on " + space->manifold->name();
  const auto ports = std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{*J, R.value_or(MatrixField()), *B, m,
                                      D.value_or(MatrixField())},
      energy, input,
      ImplicitSystem::Names{
          vocabulary.coordinates.element_names(), vocabulary.unknowns.element_names(), {}});
  model.system = ports;
  // Outputs, flows and efforts are words of observables, unless a name of theirs has a meaning already.
  const auto effort = [ports](const Vocabulary::Arguments& at) {
    return at.effort ? *at.effort : ports->effort(*at.x, *at.z, *at.t);
  };
  const auto add_words =
      [&](const NameList& names,
          std::function<std::optional<ExprVector>(const Vocabulary::Arguments&)> words) {
        if (names.size() > 0 && is_free(names, taken, vocabulary.definitions))
          vocabulary.derived.push_back({names, std::move(words)});
      };
  add_words(port_variables("y", m, *port_names),
            [ports, effort](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
              if (!at.x || !at.z || !at.t) return std::nullopt;
              return ports->output(*at.x, effort(at), *at.z);
            });
  // (v, dH) of (28)-(31), in the representation of the manifold.
  NameList flows, efforts;
  flows.append({"flow", {n}});
  efforts.append({"effort", {n}});
  add_words(efforts, [effort](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    if (!at.x || !at.z || !at.t) return std::nullopt;
    return effort(at);
  });
  add_words(flows, [ports](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    if (!at.x || !at.velocity) return std::nullopt;
    return ExprVector(ports->manifold()->coframe(*at.x) * *at.velocity);
  });
  const std::pair<std::string, std::shared_ptr<const DiracStructure>> of_open{
      "open ports", std::make_shared<OpenPortHamiltonian>(space->manifold, *J, m, *B)};
  const std::pair<std::string, std::shared_ptr<const DiracStructure>> of_closed{
      "closed ports", std::make_shared<ClosedPortHamiltonian>(space->manifold, *J, m, *B)};
  if (D)  // closed ports with feedthrough are no such Dirac structure
    model.structures = {of_open};
  else if (open)
    model.structures = {of_open, of_closed};
  else
    model.structures = {of_closed, of_open};
  return model;
}

}  // namespace courant
