#include <algorithm>
#include <stdexcept>

#include "courant/core/language/declaration.hpp"
#include "courant/core/language/formula.hpp"
#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"
#include "courant/reading/coupled_inductors.hpp"
#include "courant/reading/network_branches.hpp"
#include "courant/reading/network_quantities.hpp"
#include "courant/reading/network_topology.hpp"
#include "courant/reading/repetition.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {
namespace {

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

}  // namespace

Registry<NetworkElement, NetworkSite>& element_kinds() {
  static Registry<NetworkElement, NetworkSite> kinds([] {
    ElementKinds all = electrical_elements();
    for (const ElementKinds& more :
         {transistor_elements(), mechanical_elements(), transducer_elements(),
          thermofluid_elements(), port_elements()})
      all.insert(all.end(), more.begin(), more.end());
    for (auto& kind : all)
      kind.description.keys.push_back(optional_key(
          "repeat", takes::repetition(), "the element once for each value of some indices"));
    return all;
  }());
  return kinds;
}

namespace {

std::optional<Model> read_elements_and_nodes(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  model.vocabulary = read_vocabulary(system);
  const auto words = std::make_shared<NetworkWords>();
  const auto nodes = read_nodes(system, model.vocabulary.symbols({}));
  const auto elements = read_elements(system, {model.vocabulary, words});
  if (!nodes || !elements || !check_topology(*nodes, *elements, findings)) return std::nullopt;

  words->vocabulary = model.vocabulary;
  NetworkBranches branches(*nodes, *elements, *words, findings);
  if (!branches.right || !couple(*elements, branches.assembly, findings)) return std::nullopt;
  if (words->vocabulary.coordinates.size() == 0) {
    findings.problem(system.place().pointer() + "/elements",
                     "nothing stores energy; expected a capacitor, an inductor, a mass, …");
    return std::nullopt;
  }
  const auto kinds = node_domains(*nodes, *elements);
  const std::vector<std::string> potentials = potential_names(*nodes, kinds);
  check_network_definitions(words->vocabulary, *words, potentials, findings);
  model.vocabulary = words->vocabulary;
  if (!check_formulas(*elements, *words, potentials, findings) ||
      !check_circles(*elements, *words, branches.assembly, findings))
    return std::nullopt;

  const std::shared_ptr<const Network> network = branches.assembly.network();
  model.vocabulary.derived.push_back(
      network_quantities(network, model.vocabulary, branches.of_elements, *nodes, kinds));
  if (network->port_count() > 0)
    model.vocabulary.derived.push_back(
        {branches.outputs, [network](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
           if (!at.x || !at.z || !at.t) return std::nullopt;
           return network->output(
               *at.x, at.effort ? *at.effort : network->effort(*at.x, *at.z, *at.t), *at.z);
         }});
  model.description = "network of " + std::to_string(elements->size()) + " elements between " +
                      std::to_string(nodes->names.size()) + " nodes";
  model.system = network;
  model.kinds = std::move(branches.kinds);
  model.efforts = std::move(branches.efforts);
  model.starts_at_zero = true;
  return model;
}

}  // namespace

std::optional<Model> read_network(ObjectReader& system) {
  try {
    return read_elements_and_nodes(system);
  } catch (const std::length_error& error) {  // of loops and ways through the network
    system.place().findings().problem(system.place().pointer() + "/elements",
                                      without_place(error.what()));
    return std::nullopt;
  }
}

}  // namespace courant
