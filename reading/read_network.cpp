#include <cmath>
#include <set>
#include <unordered_set>

#include "courant/core/as_size.hpp"
#include "courant/core/cholesky_decomposition.hpp"
#include "courant/core/declaration.hpp"
#include "courant/core/formula.hpp"
#include "courant/core/lu_decomposition.hpp"
#include "courant/reading/network_topology.hpp"
#include "courant/reading/repetition.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {
namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

// Where the temperatures of branches are looked for: at 0 K the laws have no value.
constexpr double kRoomTemperature = 300.0;

// Reads what a value stands for: once, or in the turns of its key `repeat`. Whether that was right.
bool read_turns(const JsonReader& value, const SymbolTable& constants,
                const std::function<bool(const JsonReader&, const std::string& turn)>& read) {
  if (!value.value().is_object() || !value.value().contains("repeat")) {
    const Json filled = Repetition::Turn(constants, "").filled(value);
    return read(JsonReader(filled, value.pointer(), value.findings()), "");
  }
  const JsonReader repeat(value.value().at("repeat"), value.pointer() + "/repeat",
                          value.findings());
  const auto repetition = Repetition::read(repeat, constants);
  return repetition && repetition->for_each(value.findings(), [&](const Repetition::Turn& turn,
                                                                  Findings& findings) {
    const Json filled = turn.filled(JsonReader(value.value(), value.pointer(), findings));
    if (findings.clean())
      read(JsonReader(filled, value.pointer(), findings), " (" + turn.words() + ")");
  });
}

// Nothing, and a problem, where the value is neither a name nor an object with one.
std::optional<std::string> read_node_name(const JsonReader& value) {
  if (!value.value().is_object()) return value.text();
  ObjectReader object(value);
  object.optional("repeat");
  const auto name = object.required("name");
  return name ? name->text() : std::nullopt;
}

std::optional<NetworkNodes> read_nodes(ObjectReader& system, const SymbolTable& constants) {
  const auto key = system.required("nodes");
  const auto elements = key ? key->elements() : std::nullopt;
  if (!elements) return std::nullopt;
  NetworkNodes nodes;
  bool right = true;
  const auto read_node = [&](const JsonReader& node, const std::string&) {
    const auto name = read_node_name(node);
    if (!name) return false;
    try {
      if (!parse_declaration("v_" + *name).shape.empty()) throw FormulaError(1, "");
    } catch (const FormulaError&) {
      node.problem("is \"" + *name + "\"; expected letters, digits and _");
      return false;
    }
    if (!nodes.index.emplace(*name, static_cast<Index>(nodes.names.size())).second) {
      node.problem("is \"" + *name + "\" again; expected each node once");
      return false;
    }
    nodes.names.push_back(*name);
    nodes.pointers.push_back(node.pointer());
    return true;
  };
  for (const JsonReader& element : *elements)
    right = read_turns(element, constants, read_node) && right;
  if (right && nodes.names.empty()) {
    key->expected("nodes, the ground first");
    right = false;
  }
  return right ? std::optional(nodes) : std::nullopt;
}

std::optional<std::vector<NetworkElement>> read_elements(ObjectReader& system,
                                                         const NetworkSite& site) {
  const auto key = system.required("elements");
  const auto list = key ? key->elements() : std::nullopt;
  if (!list) return std::nullopt;
  std::vector<NetworkElement> elements;
  bool right = true;
  const SymbolTable constants = site.vocabulary.symbols({});
  const auto read_element = [&](const JsonReader& value, const std::string& turn) {
    auto element = element_kinds().read(value, site);
    if (!element) return false;
    element->type = value.value().at("type").get<std::string>();
    element->turn = turn;
    elements.push_back(std::move(*element));
    return true;
  };
  for (const JsonReader& value : *list) right = read_turns(value, constants, read_element) && right;
  if (right && elements.empty()) {
    key->expected("at least one element");
    right = false;
  }
  return right ? std::optional(elements) : std::nullopt;
}

// ½ φᵀ 𝓛⁻¹ φ of the inductors that mutual inductances couple.
struct CoupledInductors {
  std::vector<std::size_t> members;  // elements
  MatrixXd inverse;

  Expr energy(const ExprVector& flux) const {
    return 0.5 * flux.cwiseProduct(inverse * flux).sum();
  }
};

std::optional<CoupledInductors> couple(const std::vector<NetworkElement>& elements,
                                       Findings& findings) {
  CoupledInductors coupled;
  const auto member = [&](const std::string& name) -> std::optional<Index> {
    for (std::size_t k = 0; k < coupled.members.size(); ++k)
      if (elements[coupled.members[k]].name == name) return static_cast<Index>(k);
    for (std::size_t k = 0; k < elements.size(); ++k)
      if (elements[k].name == name && elements[k].inductance) {
        coupled.members.push_back(k);
        return static_cast<Index>(coupled.members.size() - 1);
      }
    return std::nullopt;
  };
  std::vector<std::tuple<Index, Index, const NetworkElement*>> pairs;
  for (const NetworkElement& element : elements) {
    if (!element.mutual) continue;
    const auto [first, second] = element.mutual->inductors;
    const auto i = member(first), j = member(second);
    if (i && j && *i != *j) {
      pairs.emplace_back(*i, *j, &element);
      continue;
    }
    findings.problem(element.pointer + "/inductors",
                     "\"" + (i ? second : first) + "\" is " +
                         (i && j ? "both of them" : "no inductor that is given by its value") +
                         "; expected the names of two such inductors");
    return std::nullopt;
  }
  const auto n = static_cast<Index>(coupled.members.size());
  MatrixXd L = MatrixXd::Zero(n, n);
  VectorXd root(n);
  for (Index i = 0; i < n; ++i)
    root[i] = std::sqrt(*elements[coupled.members[as_size(i)]].inductance);
  for (const auto& [i, j, element] : pairs) {
    const double M =
        element->mutual->value / (element->mutual->is_coupling ? 1.0 : root[i] * root[j]);
    L(i, j) += M;
    L(j, i) += M;
    if (std::abs(L(i, j)) < 1.0) continue;
    findings.problem(element->pointer, "couples the inductors " + element->mutual->inductors[0] +
                                           " and " + element->mutual->inductors[1] +
                                           " too closely; expected |M| below √(L₁ L₂) (an "
                                           "ideal-transformer couples them wholly)");
    return std::nullopt;
  }
  L.diagonal().array() += 1.0;
  const CholeskyDecomposition factors(L);
  if (n > 0 && !(factors.is_positive_definite() && LuDecomposition(L).pivot_ratio() > 1e-14)) {
    findings.problem(std::get<2>(pairs.back())->pointer,
                     "with the other mutual inductances this makes an inductance matrix that is "
                     "not positive definite; expected weaker coupling");
    return std::nullopt;
  }
  const MatrixXd half =
      factors.solve_lower(MatrixXd::Identity(n, n)) * root.cwiseInverse().asDiagonal();
  coupled.inverse = half.transpose() * half;
  return coupled;
}

// Branches of all elements, in order; their names go into `words`, their states and unknowns into
// its vocabulary.
class Assembly {
 public:
  Assembly(const NetworkNodes& nodes, const std::vector<NetworkElement>& elements,
           NetworkWords& words, Findings& findings)
      : nodes_(nodes), words_(words), findings_(findings) {
    taken_ = words.vocabulary.symbols({.t = Expr(0.0)});
    taken_.add("H", 0.0);
    for (const Definition& definition : words.vocabulary.definitions)
      if (!taken_.find(definition.name)) taken_.add(definition.name, 0.0);
    for (const NetworkElement& element : elements) {
      *element.first = static_cast<Index>(branches.size());
      states.emplace_back();
      for (const NetworkElement::Port& port : element.ports) add(element, port);
    }
    add_voltmeters(elements);
    for (const NetworkBranch& branch : branches)
      if (branch.kind == Kind::current || branch.kind == Kind::voltage)
        words_.vocabulary.unknowns.append(
            {branch.kind == Kind::current ? branch.current_name : branch.voltage_name, {}});
    for (const NetworkBranch& branch : branches)
      if (branch.role == Role::port) {
        words_.vocabulary.unknowns.append({"u_" + branch.name, {}});
        outputs.append({"y_" + branch.name, {}});
      }
  }

  std::vector<NetworkBranch> branches;
  NameList outputs;                        // of ports
  std::vector<std::vector<Index>> states;  // of each element
  std::size_t of_elements = 0;             // branches before those that measure potentials
  bool right = true;

 private:
  std::string name(const std::string& name, const std::string& pointer) {
    if (taken_.find(name)) {
      findings_.problem(pointer, "needs the name \"" + name +
                                     "\", which has a meaning already; expected another name for "
                                     "the element or for what has it");
      right = false;
    } else {
      taken_.add(name, 0.0);
    }
    return name;
  }

  void add(const NetworkElement& element, const NetworkElement::Port& port) {
    const std::string full = element.name + port.suffix;
    const auto index = static_cast<Index>(branches.size());
    NetworkBranch branch{.name = full,
                         .from = nodes_.at(port.from),
                         .to = nodes_.at(port.to),
                         .kind = port.kind,
                         .role = port.role,
                         .law = port.law,
                         .current_name = name(port.domain->through + full, element.pointer),
                         .voltage_name = name(port.domain->across + full, element.pointer)};
    if (port.domain == &domains::thermal && port.kind == Kind::voltage)
      branch.guess = kRoomTemperature;
    if (port.role == Role::port)
      for (const char* letter : {"u_", "y_"}) name(letter + full, element.pointer);
    words_.currents[branch.current_name] = index;
    words_.voltages[branch.voltage_name] = index;
    if (!port.state.empty()) {
      branch.state_name = name(port.state + element.name, element.pointer);
      states.back().push_back(words_.vocabulary.coordinates.size());
      words_.vocabulary.coordinates.append({branch.state_name, {}});
    }
    branches.push_back(std::move(branch));
  }

  // The potentials that laws depend on, as the voltages of branches without current: so they are
  // unknowns, whatever the laws are.
  void add_voltmeters(const std::vector<NetworkElement>& elements) {
    of_elements = branches.size();
    const auto kinds = node_domains(nodes_, elements);
    std::map<std::string, Index> potentials;
    for (std::size_t node = 1; node < nodes_.names.size(); ++node)
      if (kinds[node])
        potentials[name(kinds[node]->node + nodes_.names[node], nodes_.pointers[node])] =
            static_cast<Index>(node);
    for (const NetworkElement& element : elements)
      for (const WrittenFormula& formula : element.formulas)
        for (const std::string& used : used_in(formula)) {
          const auto node = potentials.find(used);
          if (node == potentials.end() || words_.voltages.count(used)) continue;
          words_.voltages[used] = static_cast<Index>(branches.size());
          branches.push_back({.name = used,
                              .from = node->second,
                              .to = 0,
                              .kind = Kind::voltage,
                              .role = Role::coupler,
                              .law = [](const NetworkVariables&) { return Expr(0.0); },
                              .current_name = "i_" + used,
                              .voltage_name = used});
        }
  }

  std::vector<std::string> used_in(const WrittenFormula& formula) {
    try {
      return names_used(formula.text);
    } catch (const FormulaError& error) {
      findings_.problem(formula.pointer, error.what());
      right = false;
      return {};
    }
  }

  const NetworkNodes& nodes_;
  NetworkWords& words_;
  Findings& findings_;
  SymbolTable taken_;
};

// Definitions may depend on what laws give, which may depend on definitions of states and t: they
// are checked with the names alone.
void check_definitions(Vocabulary& vocabulary, const NetworkWords& words,
                       const std::vector<std::string>& potentials, Findings& findings) {
  SymbolTable known;
  vocabulary.unknowns.add_to(known, ExprVector::Zero(vocabulary.unknowns.size()));
  NameList names;
  const auto add = [&](const std::string& name) {
    if (known.find(name)) return;
    known.add(name, 0.0);
    names.append({name, {}});
  };
  for (const auto& [name, branch] : words.currents) add(name);
  for (const auto& [name, branch] : words.voltages) add(name);
  for (const std::string& name : potentials) add(name);
  vocabulary.derived.push_back(
      {names,
       [size = names.size()](const Vocabulary::Arguments& given) -> std::optional<ExprVector> {
         if (!given.velocity || !given.t) return std::nullopt;
         return ExprVector(ExprVector::Constant(size, *given.t));
       }});
  courant::check_definitions(vocabulary, findings);
  vocabulary.derived.clear();
}

// Whether laws and energies are right; laws know currents, voltages and potentials besides.
bool check_formulas(const std::vector<NetworkElement>& elements, const NetworkWords& words,
                    const std::vector<std::string>& known, Findings& findings) {
  Graph graph;
  const ExprVector x = graph.variables("x", words.vocabulary.coordinates.size());
  SymbolTable of_energies = words.vocabulary.symbols({.x = x, .t = graph.variable("t")});
  SymbolTable of_laws = of_energies;
  const auto add = [&](const std::string& name) {
    if (!of_laws.find(name)) of_laws.add(name, graph.variable(name));
  };
  for (const auto& [name, branch] : words.currents) add(name);
  for (const auto& [name, branch] : words.voltages) add(name);
  for (const std::string& name : known) add(name);
  std::set<std::string> wrong;  // places: a formula that is repeated is wrong once
  for (const NetworkElement& element : elements) {
    const auto check_all = [&](const std::vector<WrittenFormula>& formulas,
                               const SymbolTable& symbols) {
      for (const WrittenFormula& formula : formulas) {
        if (wrong.count(formula.pointer)) continue;
        Findings own;
        if (!check(formula, symbols, own)) wrong.insert(formula.pointer);
        findings.take_problems(own, element.turn);
      }
    };
    check_all(element.formulas, of_laws);
    check_all(element.energy_formulas, of_energies);
  }
  return wrong.empty();
}

// Currents, voltages and potentials as words of all other formulas.
Vocabulary::Derived quantities(const std::shared_ptr<const Network>& network,
                               const Vocabulary& vocabulary, std::size_t of_elements,
                               const NetworkNodes& nodes,
                               const std::vector<const NetworkDomain*>& kinds) {
  const auto unknowns = vocabulary.unknowns.element_names();
  const std::unordered_set<std::string> known(unknowns.begin(), unknowns.end());
  const auto is_new = [&](const std::string& name) { return !known.contains(name); };
  NameList names;
  std::vector<std::pair<Index, int>> source;  // 0: current, 1: voltage of a branch; 2: of a node
  for (std::size_t k = 0; k < of_elements; ++k) {
    const NetworkBranch& branch = network->branches()[k];
    for (const int which : {0, 1}) {
      const std::string& name = which == 0 ? branch.current_name : branch.voltage_name;
      if (!is_new(name)) continue;
      names.append({name, {}});
      source.emplace_back(static_cast<Index>(k), which);
    }
  }
  for (std::size_t node = 1; node < nodes.names.size(); ++node) {
    const std::string name = kinds[node]->node + nodes.names[node];
    if (!is_new(name)) continue;
    names.append({name, {}});
    source.emplace_back(static_cast<Index>(node), 2);
  }
  return {names,
          [network, source](const Vocabulary::Arguments& given) -> std::optional<ExprVector> {
            if (!given.x || !given.velocity || !given.z || !given.t) return std::nullopt;
            const ExprVector effort =
                given.effort ? *given.effort : network->effort(*given.x, *given.z, *given.t);
            const Network::Ports ports =
                network->ports(*given.x, *given.velocity, effort, *given.z, *given.t);
            const ExprVector potentials = network->potentials(ports.voltage);
            ExprVector values(static_cast<Index>(source.size()));
            for (Index k = 0; k < values.size(); ++k) {
              const auto& [index, which] = source[as_size(k)];
              values[k] = which == 0   ? ports.current[index]
                          : which == 1 ? ports.voltage[index]
                                       : potentials[index];
            }
            return values;
          }};
}

}  // namespace

Registry<NetworkElement, NetworkSite>& element_kinds() {
  static Registry<NetworkElement, NetworkSite> kinds([] {
    ElementKinds all = electrical_elements();
    for (const ElementKinds& more :
         {mechanical_elements(), transducer_elements(), thermofluid_elements(), port_elements()})
      all.insert(all.end(), more.begin(), more.end());
    for (auto& kind : all)
      kind.description.keys.push_back(optional_key(
          "repeat", takes::repetition(), "the element once for each value of some indices"));
    return all;
  }());
  return kinds;
}

std::optional<Model> read_network(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  model.vocabulary = read_vocabulary(system);
  const auto words = std::make_shared<NetworkWords>();
  const auto nodes = read_nodes(system, model.vocabulary.symbols({}));
  const auto elements = read_elements(system, {model.vocabulary, words});
  if (!nodes || !elements || !check_topology(*nodes, *elements, findings)) return std::nullopt;

  words->vocabulary = model.vocabulary;
  const Assembly assembly(*nodes, *elements, *words, findings);
  const auto coupled = couple(*elements, findings);
  if (!assembly.right || !coupled) return std::nullopt;
  if (words->vocabulary.coordinates.size() == 0) {
    findings.problem(system.place().pointer() + "/elements",
                     "nothing stores energy; expected a capacitor, an inductor, a mass, …");
    return std::nullopt;
  }
  const auto kinds = node_domains(*nodes, *elements);
  std::vector<std::string> potentials;
  for (std::size_t node = 1; node < kinds.size(); ++node)
    potentials.push_back(kinds[node]->node + nodes->names[node]);
  check_definitions(words->vocabulary, *words, potentials, findings);
  model.vocabulary = words->vocabulary;
  if (!check_formulas(*elements, *words, potentials, findings) ||
      !check_circles(*elements, *words, assembly.branches, findings))
    return std::nullopt;

  const auto energy = [elements = *elements, states = assembly.states, coupled = *coupled](
                          const ExprVector& x, const Expr& t) {
    Expr sum = 0.0;
    const auto own = [&](std::size_t element) {
      ExprVector result(static_cast<Index>(states[element].size()));
      for (Index k = 0; k < result.size(); ++k) result[k] = x[states[element][as_size(k)]];
      return result;
    };
    for (std::size_t k = 0; k < elements.size(); ++k)
      if (elements[k].energy &&
          std::find(coupled.members.begin(), coupled.members.end(), k) == coupled.members.end())
        sum += elements[k].energy(own(k), x, t);
    ExprVector flux(static_cast<Index>(coupled.members.size()));
    for (Index k = 0; k < flux.size(); ++k) flux[k] = own(coupled.members[as_size(k)])[0];
    return flux.size() > 0 ? sum + coupled.energy(flux) : sum;
  };
  const auto network =
      std::make_shared<Network>(static_cast<Index>(nodes->names.size()), assembly.branches, energy);
  model.vocabulary.derived.push_back(
      quantities(network, model.vocabulary, assembly.of_elements, *nodes, kinds));
  if (network->port_count() > 0)
    model.vocabulary.derived.push_back(
        {assembly.outputs, [network](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
           if (!at.x || !at.z || !at.t) return std::nullopt;
           return network->output(
               *at.x, at.effort ? *at.effort : network->effort(*at.x, *at.z, *at.t), *at.z);
         }});
  model.description = "network of " + std::to_string(elements->size()) + " elements between " +
                      std::to_string(nodes->names.size()) + " nodes";
  model.system = network;
  model.starts_at_zero = true;
  return model;
}

}  // namespace courant
