#include "courant/core/message.hpp"
#include "courant/core/symmetric_eigenvalues.hpp"
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

// One name, or an array of them where there are several; nothing if it has a meaning already.
bool append_name(NameList& names, const std::string& name, Index count, SymbolTable& taken,
                 const JsonReader& place) {
  if (count == 0) return true;
  if (taken.find(name)) {
    place.problem("the ports have the name \"" + name +
                  "\", which has a meaning already; expected another name in its place");
    return false;
  }
  Declaration declaration{name, {}};
  if (count > 1) declaration.shape = {count};
  taken.add(name, declaration.shape, ExprVector::Ones(count));
  names.append(std::move(declaration));
  return true;
}

}  // namespace

// ẋ = (J - R) dH + B u with open or closed ports.
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
  const bool open = system.word("ports") == "open";
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
  if (!J || !B || (R_key && !R)) return std::nullopt;
  const bool right = !R || is_resistive(*space->manifold, *R, *R_key);
  const JsonReader& ports_place = B_key ? *B_key : system.place();
  if (!append_name(vocabulary.unknowns, "u", m, taken, ports_place)) return std::nullopt;
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
    NameList outputs;
    Vocabulary words;
    words.parameters = vocabulary.parameters;
    SymbolTable known = words.symbols({.t = Expr(0.0)});
    if (!append_name(outputs, "y", m, known, *inputs_key)) return std::nullopt;
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
  model.system = std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{*J, R.value_or(MatrixField()), *B, m}, energy, input,
      ImplicitSystem::Names{
          vocabulary.coordinates.element_names(), vocabulary.unknowns.element_names(), {}});
  const std::pair<std::string, std::shared_ptr<const DiracStructure>> of_open{
      "open ports", std::make_shared<OpenPortHamiltonian>(space->manifold, *J, m, *B)};
  const std::pair<std::string, std::shared_ptr<const DiracStructure>> of_closed{
      "closed ports", std::make_shared<ClosedPortHamiltonian>(space->manifold, *J, m, *B)};
  if (open)
    model.structures = {of_open, of_closed};
  else
    model.structures = {of_closed, of_open};
  return model;
}

}  // namespace courant
