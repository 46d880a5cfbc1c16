#include "random_networks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "courant/core/numbers/as_size.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant::test {
namespace {

enum Type { R, C, L, V, I };

struct Element {
  Type type;
  Index from, to;
  double value = 0.0;
};

// Parts of the nodes 0 … n-1 that elements join.
class Parts {
 public:
  explicit Parts(Index nodes) : parent_(as_size(nodes)) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index of(Index node) const {
    while (parent_[as_size(node)] != node) node = parent_[as_size(node)];
    return node;
  }
  // Whether these were two parts before.
  bool join(Index a, Index b) {
    a = of(a);
    b = of(b);
    parent_[as_size(a)] = b;
    return a != b;
  }

 private:
  std::vector<Index> parent_;
};

class Dice {
 public:
  explicit Dice(std::mt19937& generator) : generator_(generator) {}
  double uniform(double a, double b) {
    return a + (b - a) * static_cast<double>(generator_()) / static_cast<double>(generator_.max());
  }
  double power_of_ten(double a, double b) { return std::pow(10.0, uniform(a, b)); }
  Index below(Index n) { return static_cast<Index>(generator_() % static_cast<unsigned long>(n)); }

 private:
  std::mt19937& generator_;
};

// The first nodes - 1 elements are a tree without current sources.
std::vector<Element> random_graph(Dice& dice, Index nodes) {
  std::vector<Element> elements;
  Parts of_voltages(nodes);
  // Inductors and current sources alone join the nodes below `border` with the others.
  const Index border = nodes > 4 && dice.below(2) == 0 ? 1 + dice.below(nodes - 1) : nodes;
  const auto add = [&](Index from, Index to) {
    Element element{static_cast<Type>(dice.below(3)), from, to};
    const bool crosses = (from < border) != (to < border),
               closes = std::ssize(elements) >= nodes - 1;
    const Index kind = dice.below(10);
    if (crosses) element.type = L;
    if (kind == 0 && !crosses && of_voltages.join(from, to)) element.type = V;
    if (kind == 1 && closes) element.type = I;
    elements.push_back(element);
  };
  for (Index node = 1; node < nodes; ++node) add(node, dice.below(node));
  for (Index more = 1 + dice.below(nodes); more > 0; --more) {
    const Index from = dice.below(nodes), to = dice.below(nodes);
    if (from != to) add(from, to);
  }
  if (border > 2 && nodes > 4 && dice.below(2) == 0) {
    const Index a = dice.below(border - 2);
    for (const auto& [from, to] : {std::pair{a, a + 1}, {a + 1, a + 2}, {a + 2, a}})
      elements.push_back({C, from, to});
  }
  const bool stores = std::any_of(elements.begin(), elements.end(), [](const Element& element) {
    return element.type == C || element.type == L;
  });
  if (!stores) elements.push_back({C, 0, 1});
  return elements;
}

double random_value(Dice& dice, Type type, Spread spread, double time, double volt, double ampere) {
  if (spread == Spread::units) {
    const double units[] = {volt / ampere, ampere * time / volt, volt * time / ampere, volt,
                            ampere};
    return dice.power_of_ten(-1.0, 1.0) * units[type];
  }
  const double decades[][2] = {{0.0, 6.0}, {-12.0, -3.0}, {-9.0, 0.0}, {-3.0, 3.0}, {-6.0, 1.0}};
  return dice.power_of_ten(decades[type][0], decades[type][1]);
}

// Potentials in which every voltage source has its voltage at t = 0.
VectorXd random_potentials(Dice& dice, Index nodes, const std::vector<Element>& elements,
                           double volt, double at_start) {
  VectorXd potential(nodes);
  for (Index node = 0; node < nodes; ++node) potential[node] = volt * dice.uniform(-1.0, 1.0);
  Parts known(nodes);
  for (const Element& element : elements) {
    if (element.type != V) continue;
    const double shift = potential[element.from] - potential[element.to] - element.value * at_start;
    const Index part = known.of(element.to);
    for (Index node = 0; node < nodes; ++node)
      if (known.of(node) == part) potential[node] += shift;
    known.join(element.from, element.to);
  }
  return potential;
}

// Currents with none left at any node: each element that closes a loop with the tree has a current of its
// own, a source its current at t = 0.
VectorXd random_currents(Dice& dice, Index nodes, const std::vector<Element>& elements,
                         double ampere, double at_start) {
  const Index count = std::ssize(elements);
  VectorXd current = VectorXd::Zero(count), left = VectorXd::Zero(nodes);
  for (Index k = count - 1; k >= nodes - 1; --k) {
    const Element& element = elements[as_size(k)];
    current[k] = element.type == I ? element.value * at_start : ampere * dice.uniform(-1.0, 1.0);
    left[element.from] -= current[k];
    left[element.to] += current[k];
  }
  // The tree leads from each node to a smaller one.
  for (Index k = nodes - 2; k >= 0; --k) {
    current[k] = left[elements[as_size(k)].from];
    left[elements[as_size(k)].to] += current[k];
  }
  return current;
}

std::string told(const ConstraintLadder& ladder) {
  std::ostringstream text;
  text << to_string(ladder.verdict) << ", index " << ladder.index << ", gauge "
       << ladder.gauge_dimension << ", ladder";
  for (const LadderLevel& level : ladder.levels)
    text << " (" << level.dim_S << ", " << level.dim_M << ")";
  return text.str();
}

std::string expected_of(const RandomNetwork& network) {
  const Index n = network.states, d = network.dependent();
  std::ostringstream text;
  text << "regular, index " << (d > 0 ? 1 : 0) << ", gauge 0, ladder (" << n << ", " << n - d
       << ") (" << n - d << ", " << n - d << ")";
  if (d > 0) text << " (" << n - d << ", " << n - d << ")";
  return text.str();
}

}  // namespace

RandomNetwork random_network(std::mt19937& generator, Index most_nodes, Spread spread) {
  Dice dice(generator);
  const bool in_units = spread == Spread::units;
  const auto unit = [&] { return in_units ? dice.power_of_ten(-9.0, 9.0) : 1.0; };
  const double time = unit(), volt = unit(), ampere = unit(), phase = 0.5;
  const Index nodes = 2 + dice.below(most_nodes - 1);
  std::vector<Element> elements = random_graph(dice, nodes);
  for (Element& element : elements)
    element.value = random_value(dice, element.type, spread, time, volt, ampere);
  const double at_start = std::sin(phase);
  const VectorXd potential = random_potentials(dice, nodes, elements, volt, at_start);
  const VectorXd current = random_currents(dice, nodes, elements, ampere, at_start);

  RandomNetwork network;
  Json names = Json::array(), list = Json::array();
  for (Index node = 0; node < nodes; ++node) names.push_back("n" + std::to_string(node));
  std::vector<double> state;
  Parts of_charges(nodes), of_others(nodes);
  Index joined = 0;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const auto& [type, from, to, value] = elements[k];
    const char* types[] = {"resistor", "capacitor", "inductor", "voltage-source", "current-source"};
    const std::string name = "RCLVI"[type] + std::to_string(k);
    Json element{{"type", types[type]},
                 {"name", name},
                 {"from", names[as_size(from)]},
                 {"to", names[as_size(to)]}};
    if (type == V || type == I) {
      const double frequency = in_units ? 1.0 / time : dice.power_of_ten(0.0, 9.0);
      element["value"] = Json(value).dump() + " * sin(" + Json(frequency).dump() + " * t + 0.5)";
    } else {
      element["value"] = value;
    }
    list.push_back(std::move(element));
    network.text += " " + name + " " + std::to_string(from) + "-" + std::to_string(to);
    if (type == C) state.push_back(value * (potential[from] - potential[to]));
    if (type == L) state.push_back(value * current[static_cast<Index>(k)]);
    if (type == C || type == V) network.capacitor_loops += !of_charges.join(from, to);
    if (type != L && type != I) joined += of_others.join(from, to);
  }
  network.inductor_cut_sets = nodes - 1 - joined;
  network.states = std::ssize(state);
  network.at_rest = VectorXd::Zero(network.states);
  network.consistent = Eigen::Map<const VectorXd>(state.data(), network.states);
  network.system = {
      {"type", "network"}, {"nodes", std::move(names)}, {"elements", std::move(list)}};
  return network;
}

LadderTally tally_ladders(std::mt19937& generator, int networks, Index most_nodes, Spread spread,
                          Starts starts, const Campaign& campaign) {
  LadderTally tally;
  for (int trial = 0; trial < networks; ++trial) {
    const RandomNetwork network = random_network(generator, most_nodes, spread);
    if (!campaign.has(trial)) continue;
    tally.with_loops += network.capacitor_loops > 0;
    tally.with_cut_sets += network.inductor_cut_sets > 0;
    Findings findings;
    const auto model = system_kinds().read(JsonReader(network.system, "/system", findings));
    if (!model) throw std::logic_error("random_network: a network was refused:" + network.text);
    const std::string expected = expected_of(network);
    for (const bool at_rest : {true, false}) {
      if (starts == Starts::in_turn && at_rest != (trial % 2 == 0)) continue;
      const VectorXd& x = at_rest ? network.at_rest : network.consistent;
      const ConstraintLadder ladder = ConstraintAlgorithm().run(model->system, {.x = x});
      const std::string found = told(ladder);
      ++tally.count;
      tally.right += found == expected;
      tally.ambiguous += ladder.is_ambiguous();
      if (found != expected && !ladder.is_ambiguous())
        tally.wrong.push_back("network " + std::to_string(trial) + (at_rest ? " at rest" : "") +
                              ": expected " + expected + ", found " + found + ":" + network.text);
    }
  }
  return tally;
}

}  // namespace courant::test
