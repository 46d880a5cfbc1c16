#include "courant/reading/network_topology.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <set>
#include <span>

#include "courant/core/language/formula.hpp"
#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/structures/kirchhoff.hpp"

namespace courant {
namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;
using Port = elements::Element::Branch;

// `a`, `a and b`, `a, b and c`, and only the first of many.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  if (names.size() > most)
    return word_list(std::span(names).first(most)) + " and " + std::to_string(names.size() - most) +
           " more";
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return list;
}

// A port with its element and the graph's number of its nodes.
struct Edge {
  const NetworkElement* element;
  const Port* port;
  std::size_t from, to;
};

std::vector<Edge> edges_of(const NetworkNodes& nodes, const std::vector<NetworkElement>& elements) {
  std::vector<Edge> edges;
  for (const NetworkElement& element : elements)
    for (const Port& port : element.element.branches)
      edges.push_back({&element, &port, as_size(nodes.at(element.terminal(port.from))),
                       as_size(nodes.at(element.terminal(port.to)))});
  return edges;
}

bool check_names(const std::vector<NetworkElement>& elements, Findings& findings) {
  std::map<std::string, std::string> first;
  bool right = true;
  for (const NetworkElement& element : elements) {
    const auto [known, is_new] = first.emplace(element.name, element.pointer);
    if (is_new) continue;
    findings.problem(element.pointer + "/name", "two elements have the name " +
                                                    in_quotes(element.name) + ", the other is " +
                                                    known->second);
    right = false;
  }
  return right;
}

bool check_terminals(const NetworkNodes& nodes, const std::vector<NetworkElement>& elements,
                     Findings& findings) {
  bool right = true;
  for (const NetworkElement& element : elements)
    for (const NetworkTerminal& terminal : element.terminals) {
      if (terminal.node.empty() || nodes.index.count(terminal.node)) continue;
      findings.problem(terminal.pointer, "unknown node " + in_quotes(terminal.node) +
                                             did_you_mean(terminal.node, nodes.names) +
                                             element.turn);
      right = false;
    }
  return right;
}

bool is_source(const Port& port, Kind kind) {
  return port.role == Role::source && port.kind == kind;
}

// "voltage source", "torque source": the type with a space.
std::string words_of(const NetworkElement& element) {
  std::string words = element.type;
  std::replace(words.begin(), words.end(), '-', ' ');
  return words;
}

bool check_shorts(const std::vector<Edge>& edges, const NetworkNodes& nodes, Findings& findings) {
  bool right = true;
  for (const Edge& edge : edges) {
    if (edge.from != edge.to) continue;
    right = false;
    const std::string node = in_quotes(nodes.names[edge.from]);
    findings.problem(edge.element->pointer,
                     "the " + words_of(*edge.element) + " " + edge.element->name +
                         " is shorted: both its ends are at the node " + node);
  }
  return right;
}

bool check_domains(const std::vector<Edge>& edges, const NetworkNodes& nodes, Findings& findings) {
  std::vector<const Edge*> first(nodes.names.size(), nullptr);
  bool right = true;
  for (const Edge& edge : edges)
    for (const std::size_t node : {edge.from, edge.to}) {
      if (node == 0) continue;
      if (!first[node]) first[node] = &edge;
      if (first[node]->port->domain == edge.port->domain) continue;
      const NetworkTerminal terminal =
          edge.element->terminal(node == edge.from ? edge.port->from : edge.port->to);
      findings.problem(terminal.pointer,
                       "the node " + in_quotes(nodes.names[node]) + " is " +
                           first[node]->port->domain->name + " for " + first[node]->element->name +
                           " and " + edge.port->domain->name + " for " + edge.element->name);
      right = false;
    }
  return right;
}

bool check_ground(const std::vector<Edge>& edges, const NetworkNodes& nodes, Findings& findings) {
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> graph(nodes.names.size());
  std::vector<bool> used(nodes.names.size(), false);
  for (const Edge& edge : edges) {
    add_edge(edge.from, edge.to, graph);
    used[edge.from] = used[edge.to] = true;
  }
  bool right = true;
  std::vector<int> part(nodes.names.size());
  boost::connected_components(graph, part.data());
  std::map<int, std::vector<std::size_t>> floating;
  for (std::size_t node = 1; node < nodes.names.size(); ++node) {
    if (!used[node]) {
      findings.problem(nodes.pointers[node], "the node " + in_quotes(nodes.names[node]) +
                                                 " floats: no element is connected to it");
      right = false;
    } else if (part[node] != part[0]) {
      floating[part[node]].push_back(node);
    }
  }
  for (const auto& [number, members] : floating) {
    std::vector<std::string> names;
    for (const std::size_t node : members) names.push_back(in_quotes(nodes.names[node]));
    const bool one = names.size() == 1;
    findings.problem(nodes.pointers[members[0]], std::string(one ? "the node " : "the nodes ") +
                                                     listed(names) + (one ? " floats" : " float") +
                                                     ": no element leads from there to the "
                                                     "ground " +
                                                     in_quotes(nodes.names[0]));
    right = false;
  }
  return right;
}

// The columns of loops or cut-sets as problems: `voltage sources V1 and V2 form a loop`.
void tell(const std::vector<const Edge*>& edges, const SparseMatrixXd& columns,
          const std::string& what, Findings& findings) {
  for (Index column = 0; column < columns.cols(); ++column) {
    std::vector<std::string> names;
    std::set<std::string> types;
    const Edge* last = nullptr;
    for (SparseMatrixXd::InnerIterator it(columns, column); it; ++it) {
      last = edges[as_size(it.row())];
      names.push_back(last->element->name);
      types.insert(words_of(*last->element));
    }
    if (!last) continue;
    const std::string type = types.size() == 1 ? *types.begin() : "source";
    findings.problem(last->element->pointer,
                     type + (names.size() > 1 ? "s " : " ") + listed(names) +
                         (names.size() > 1 ? " form a " : " forms a ") + what +
                         (what != "cut-set"   ? ""
                          : names.size() == 1 ? ": there is no other way for its current"
                                              : ": there is no other way for their current"));
  }
}

bool check_sources(const std::vector<Edge>& edges, const NetworkNodes& nodes, Findings& findings) {
  CircuitGraph voltages(nodes.names.size()), all(nodes.names.size());
  std::vector<const Edge*> of_voltages, of_all;
  for (const Edge& edge : edges) {
    if (is_source(*edge.port, Kind::current)) {
      add_edge(edge.from, edge.to, CircuitElement{}, voltages);
      of_voltages.push_back(&edge);
    }
    const bool is_last = is_source(*edge.port, Kind::voltage);
    add_edge(edge.from, edge.to, CircuitElement{"", is_last ? 1.0 : 0.0}, all);
    of_all.push_back(&edge);
  }
  const Kirchhoff of_sources(voltages), of_network(all);
  tell(of_voltages, of_sources.loops(), "loop", findings);
  // A cut-set with a source of current in the tree has nothing else.
  SparseMatrixXd cut_sets(static_cast<Index>(of_all.size()), 0);
  std::vector<Index> columns;
  for (std::size_t k = 0; k < of_network.tree().size(); ++k)
    if (is_source(*of_all[as_size(of_network.tree()[k])]->port, Kind::voltage))
      columns.push_back(static_cast<Index>(k));
  if (columns.empty()) return of_sources.links().empty();  // all cut-sets may be long together
  const SparseMatrixXd whole = of_network.cut_sets();
  cut_sets.resize(whole.rows(), static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    cut_sets.startVec(static_cast<Index>(k));
    for (SparseMatrixXd::InnerIterator it(whole, columns[k]); it; ++it)
      cut_sets.insertBack(it.row(), static_cast<Index>(k)) = it.value();
  }
  cut_sets.finalize();
  tell(of_all, cut_sets, "cut-set", findings);
  return false;
}

}  // namespace

Index NetworkNodes::at(const NetworkTerminal& terminal) const {
  return terminal.node.empty() ? 0 : index.at(terminal.node);
}

bool check_topology(const NetworkNodes& nodes, const std::vector<NetworkElement>& elements,
                    Findings& findings) {
  const bool names = check_names(elements, findings);
  if (!check_terminals(nodes, elements, findings)) return false;
  const std::vector<Edge> edges = edges_of(nodes, elements);
  const bool shorts = check_shorts(edges, nodes, findings);
  const bool domains = check_domains(edges, nodes, findings);
  const bool ground = check_ground(edges, nodes, findings);
  // A shorted source is a loop by itself, which is said.
  return shorts && check_sources(edges, nodes, findings) && names && domains && ground;
}

bool check_circles(const std::vector<NetworkElement>& elements, const NetworkWords& words,
                   const elements::NetworkAssembly& assembly, Findings& findings) {
  const std::vector<NetworkBranch>& branches = assembly.branches();
  // The elements whose laws give a variable.
  const auto owner = [&](const std::string& name) -> Index {
    Index branch = -1;
    if (const auto found = words.currents.find(name); found != words.currents.end()) {
      if (branches[as_size(found->second)].kind == Kind::voltage) branch = found->second;
    } else if (const auto other = words.voltages.find(name); other != words.voltages.end()) {
      if (branches[as_size(other->second)].kind == Kind::current) branch = other->second;
    }
    if (branch < 0) return -1;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Index first = assembly.places()[k].first_branch;
      if (branch >= first && branch < first + std::ssize(elements[k].element.branches))
        return static_cast<Index>(k);
    }
    return -1;
  };
  std::vector<std::vector<Index>> needs(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k)
    for (const WrittenFormula& formula : elements[k].formulas)
      for (const std::string& name : names_used(formula.text))
        if (const Index other = owner(name); other >= 0) needs[k].push_back(other);
  // Depth first, with the way here; 1: on the way, 2: done.
  std::vector<int> state(elements.size(), 0);
  std::vector<std::pair<Index, std::size_t>> way;
  for (std::size_t start = 0; start < elements.size(); ++start) {
    if (state[start] != 0) continue;
    way.assign(1, {static_cast<Index>(start), 0});
    state[start] = 1;
    while (!way.empty()) {
      auto& [element, next] = way.back();
      if (next == needs[as_size(element)].size()) {
        state[as_size(element)] = 2;
        way.pop_back();
        continue;
      }
      const Index other = needs[as_size(element)][next++];
      if (state[as_size(other)] == 1) {
        std::vector<std::string> names;
        for (auto it = way.begin(); it != way.end(); ++it)
          if (!names.empty() || it->first == other)
            names.push_back(elements[as_size(it->first)].name);
        findings.problem(elements[as_size(other)].pointer,
                         names.size() == 1
                             ? "the law of " + names[0] + " needs its own result"
                             : "the laws of " + listed(names) + " need each other's results");
        return false;
      }
      if (state[as_size(other)] == 0) {
        state[as_size(other)] = 1;
        way.emplace_back(other, 0);
      }
    }
  }
  return true;
}

std::vector<const elements::Domain*> node_domains(const NetworkNodes& nodes,
                                                  const std::vector<NetworkElement>& elements) {
  std::vector<const elements::Domain*> domains(nodes.names.size(), nullptr);
  for (const NetworkElement& element : elements)
    for (const Port& port : element.element.branches)
      for (const Index terminal : {port.from, port.to}) {
        const Index node = nodes.at(element.terminal(terminal));
        if (node > 0 && !domains[as_size(node)]) domains[as_size(node)] = port.domain;
      }
  return domains;
}

}  // namespace courant
