#include "courant/extensions/spice/netlist.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/extensions/spice/netlist_circuit_reader.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reading/linear_spectrum.hpp"
#include "courant/reading/unused_parameters.hpp"

namespace courant {
namespace {

using namespace netlist;

// How often a step that cannot be made is halved.
constexpr int kHalvings = 10;
// By which steps are chosen: about what simulators of circuits have.
constexpr double kTolerance = 1e-3;

// Parameters of which only values are left, as of the widths of transistors, would be no use of the experiment to change.
void drop_unused_parameters(Json& experiment) {
  Json& system = experiment["system"];
  for (auto unused = unused_parameters(experiment); !unused.empty();
       unused = unused_parameters(experiment))
    for (const Problem& parameter : unused) {
      const Json::json_pointer place(parameter.where);
      experiment.at(place.parent_pointer()).erase(place.back());
    }
  if (system.contains("parameters") && system["parameters"].empty()) system.erase("parameters");
}

class Import {
 public:
  Import(std::string_view text, const IncludedText& included)
      : deck_(read_deck(text, problems_, included)),
        title_(deck_.title),
        circuit_(read_circuit(deck_, problems_)),
        times_(circuit_.times),
        largest_step_(circuit_.largest_step) {
    for (const InitialPotential& initial : deck_.initial)
      problems_.guard([&] { add_initial(initial); });
    for (const InitialPotential& guess : deck_.nodesets) problems_.guard([&] { add_guess(guess); });
    problems_.require_none();
    check_network();
    initial_ = initial();
    problems_.require_none();
    if (!is_nonlinear()) is_stiff_ = has_time_constants_below(rows_interval());
  }

  Json experiment() const {
    Json system = {{"type", "network"}};
    if (!circuit_.parameters.empty()) system["parameters"] = circuit_.parameters;
    system["nodes"] = circuit_.nodes;
    system["elements"] = circuit_.elements;
    const double steps = times_.end / rows_interval();
    Json observe = Json::object();
    for (std::size_t node = 1; node < circuit_.nodes.size(); ++node) {
      if (node == circuit_.resting ||
          std::ranges::find(circuit_.switches, node, &NetlistSwitch::memory) !=
              circuit_.switches.end())
        continue;
      const std::string name = "potential_" + circuit_.name_of(node);
      observe[name] = name;
    }
    for (const std::string& name : circuit_.sources) observe["i_" + name] = "i_" + name;
    Json all = {{"title", title_.empty() ? "A netlist" : title_},
                {"system", system},
                {"initial", initial_},
                {"method", method()},
                {"time", time()},
                {"observe", observe},
                {"output", {{"interval", times_.end / steps}}}};
    for (const NetlistSwitch& one : circuit_.switches) {
      all["events"][one.name + "_on"] = {{"zero", one.control + " - " + one.high},
                                         {"direction", "rising"},
                                         {"set", {{one.state, 1}}}};
      all["events"][one.name + "_off"] = {{"zero", one.control + " - " + one.low},
                                          {"direction", "falling"},
                                          {"set", {{one.state, 0}}}};
    }
    drop_unused_parameters(all);
    return all;
  }
  const std::vector<Problem>& notes() const { return notes_; }

 private:
  // Diodes next to coils make time constants down to 1e-16 s, with which the midpoint rule rings. Where they
  // cut coils off, derivatives of the constraints grow beyond all bounds: Method 1 has none, and the last of
  // its damped steps ends where the constraints hold. So with every law that is not linear; linear
  // circuits by their time constants.
  Json method() const {
    if (is_nonlinear())
      return {
          {"type", "discretize-first"}, {"discretization", "midpoint"}, {"damping", "l-stable"}};
    Json method = {{"type", "constrain-first"}, {"discretization", "midpoint"}};
    if (is_stiff_) method["damping"] = "l-stable";
    return method;
  }
  bool is_nonlinear() const {
    return std::ranges::any_of(circuit_.fixed.elements, [](const StaticElement& element) {
      return element.kind == StaticElement::Kind::diode || element.law;
    });
  }

  // Steps end where sources bend; where a law does not let one be made, it is made in shorter ones. The first number of
  // .tran says how often rows are written; how long steps are the waveforms decide.
  Json time() const {
    Json time = {{"tolerance", kTolerance}, {"end", times_.end}};
    for (const auto& [first, period] : circuit_.corners)
      if (period > 0.0)
        time["corners"].push_back({{"first", first}, {"period", period}});
      else
        time["corners"].push_back(first);
    if (is_nonlinear()) time["halvings"] = kHalvings;
    return time;
  }

  // The time between rows: a whole part of the run.
  double rows_interval() const {
    const double longest = largest_step_ > 0.0 ? std::min(largest_step_, times_.step) : times_.step;
    return times_.end / std::ceil(times_.end / longest * (1.0 - 1e-12));
  }

  // Whether a motion of the linear circuit decays faster than steps of h follow.
  bool has_time_constants_below(double h) const {
    const Experiment linear = read_experiment_document(experiment());
    return fastest_decay(*linear.model.system,
                         VectorXd::Zero(linear.model.vocabulary.coordinates.size())) *
               h >
           1.0;
  }

  // One note of what is so on several lines, or on a line of a subcircuit that is used more than once.
  void note(int line, const std::string& what) {
    std::vector<std::string>& lines = lines_of_notes_[what];
    const std::string number = std::to_string(line);
    if (std::ranges::find(lines, number) != lines.end()) return;
    lines.push_back(number);
    if (lines.size() == 1)
      notes_.push_back({"line " + number, what});
    else
      std::ranges::find(notes_, what, &Problem::what)->where = "lines " + in_words(lines);
  }

  double value_of(const InitialPotential& initial) const {
    return circuit_.value_of(formula(initial.value, circuit_.scope, initial.line), initial.line);
  }

  // The node that is meant, 0 for the ground.
  std::size_t node_of(const InitialPotential& initial) const {
    std::size_t place = 0;
    if (initial.node != "0" && initial.node != "gnd") {
      const auto found = circuit_.nodes_by_name.find(initial.node);
      if (found == circuit_.nodes_by_name.end()) {
        std::vector<std::string> names;
        for (const auto& [name, index] : circuit_.nodes_by_name) names.push_back(name);
        throw LineError{initial.line, "unknown node \"" + initial.node + "\"" +
                                          did_you_mean(initial.node, names)};
      }
      place = found->second;
    }
    if (place == 0 && value_of(initial) != 0.0)
      throw LineError{initial.line, "the ground is at 0 V; expected another node"};
    return place;
  }

  // .nodeset: where an operating point is looked for first.
  void add_guess(const InitialPotential& guess) {
    const std::size_t place = node_of(guess);
    const double value = value_of(guess);
    if (circuit_.from_given) note(guess.line, ".nodeset has no effect with uic in .tran");
    const auto same = [&](const auto& other) { return other.node == place; };
    if (place == 0 || std::ranges::any_of(circuit_.fixed.held, same)) return;
    circuit_.at_rest = circuit_.at_rest && value == 0.0;
    std::erase_if(circuit_.fixed.guessed, same);
    circuit_.fixed.guessed.push_back({place, value});
  }

  void add_initial(const InitialPotential& initial) {
    const std::size_t place = node_of(initial);
    const double value = value_of(initial);
    if (place == 0) return;
    given_[place] = formula(initial.value, circuit_.scope, initial.line);
    given_values_[place] = value;
    given_lines_[place] = initial.line;
    circuit_.at_rest = circuit_.at_rest && value == 0.0;
    std::erase_if(circuit_.fixed.held, [&](const auto& held) { return held.node == place; });
    circuit_.fixed.held.push_back({place, value});
  }

  // What is wrong with the network itself, at the lines of its elements.
  void check_network() {
    try {
      read_experiment_document(experiment());
      return;
    } catch (const ExperimentError& error) {
      std::map<int, std::size_t> told;  // which element of a line: another instance says the same
      for (const Problem& problem : error.problems()) {
        const auto [line, element, about] = place_of(problem.where);
        if (line > 0 && told.emplace(line, element).first->second != element) continue;
        problems_.add(line, about + problem.what);
      }
    }
    problems_.require_none();
  }

  struct LinePlace {
    int line;
    std::size_t element;
    std::string about;  // before what is said
  };
  LinePlace place_of(const std::string& pointer) const {
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < pointer.size();) {
      const std::size_t end = std::min(pointer.find('/', i + 1), pointer.size());
      keys.push_back(pointer.substr(i + 1, end - i - 1));
      i = end;
    }
    if (keys.size() > 2 && keys[0] == "system") {
      if (keys[1] == "elements") {
        const auto k = static_cast<std::size_t>(std::stoul(keys[2]));
        const std::string name = circuit_.elements[k]["name"].get<std::string>();
        return {circuit_.element_lines[k], k,
                keys.size() > 3 ? "the " + keys[3] + " of " + name + " " : ""};
      }
      if (keys[1] == "nodes") {
        const auto k = static_cast<std::size_t>(std::stoul(keys[2]));
        return {circuit_.node_lines[k], k, ""};
      }
      if (keys[1] == "parameters") return {circuit_.parameter_lines.at(keys[2]), 0, ""};
    }
    if (!keys.empty() && keys[0] == "time" && deck_.transient)
      return {deck_.transient->line->number, 0, ""};
    return {0, 0, pointer.empty() ? "" : pointer + ": "};
  }

  Json initial() {
    tell_what_has_no_effect();
    if (!deck_.passed.empty())
      notes_.push_back(
          {"the netlist", in_words(deck_.passed) + (deck_.passed.size() == 1 ? " is" : " are") +
                              " passed over: what a transient is does not depend on it"});
    if (!deck_.temperature.empty())
      notes_.push_back(
          {"the netlist", "the temperature is 27 °C here, not " + deck_.temperature + " °C"});
    if (!deck_.transient)
      notes_.push_back({"the netlist", "no .tran says how long to go on: the experiment ends at " +
                                           number_text(times_.end) +
                                           " s, which is `end` of its `time`"});
    for (const auto& [line, what] : circuit_.notes) note(line, what);
    if (circuit_.resting) {
      const std::string node = circuit_.name_of(*circuit_.resting);
      notes_.push_back({"the netlist", "nothing stores energy, and a network needs a state: C_" +
                                           node + " beside R_" + node +
                                           ", on a node of their own, have one that stays 0"});
      return {{"q_C_" + node, 0}};
    }
    if (circuit_.from_given) return given_values();
    Json initial = Json::object();
    bool begins_empty = circuit_.at_rest;
    if (!begins_empty && !set_switches(circuit_.fixed, circuit_.switches)) {
      begins_empty = true;
      note(circuit_.lines[circuit_.switches.front().element],
           "switches have no state at rest: each operating point moves one of them; it begins with "
           "empty capacitors and inductors, as with uic");
    }
    add_states_of_switches(initial);
    if (begins_empty) {
      for (const NetlistStorage& storage : circuit_.storages) initial[storage.state] = 0;
      for (const NetlistJunction& junction : circuit_.junctions) initial[junction.state] = 0;
      return initial;
    }
    const auto found = operating_point(circuit_.fixed);
    if (const auto* none = std::get_if<NoOperatingPoint>(&found)) {
      tell(*none);
      return initial;
    }
    const VectorXd& potential = std::get<OperatingPoint>(found).potential;
    const VectorXd& current = std::get<OperatingPoint>(found).current;
    for (const NetlistStorage& storage : circuit_.storages) {
      const StaticElement& element = circuit_.fixed.elements[storage.element];
      const auto at = [&](std::size_t node) { return potential[static_cast<Index>(node)]; };
      double value =
          element.value * (storage.is_capacitor ? at(element.from) - at(element.to)
                                                : current[static_cast<Index>(storage.element)]);
      if (!storage.is_capacitor)
        for (const auto& [first, second, mutual] : circuit_.fixed.couplings)
          if (first == storage.element || second == storage.element)
            value +=
                mutual * current[static_cast<Index>(first == storage.element ? second : first)];
      initial[storage.state] = value;
    }
    const auto voltage_of = [&](std::size_t k) {
      const StaticElement& element = circuit_.fixed.elements[k];
      return potential[static_cast<Index>(element.from)] -
             potential[static_cast<Index>(element.to)];
    };
    for (const NetlistJunction& junction : circuit_.junctions)
      initial[junction.state] =
          junction.at(voltage_of(junction.element), voltage_of(junction.other));
    return initial;
  }

  void add_states_of_switches(Json& initial) const {
    for (const NetlistSwitch& one : circuit_.switches) initial[one.state] = one.begins_on ? 1 : 0;
  }

  void tell(const NoOperatingPoint& none) {
    const std::string expected =
        "; expected one to start from, or uic in .tran, with initial values by ic= and .ic";
    if (none.elements.empty()) return problems_.add(0, none.why + expected);
    std::vector<std::string> names;
    int line = 0;
    for (const std::size_t element : none.elements) {
      names.push_back(circuit_.names[element]);
      line = std::max(line, circuit_.lines[element]);
    }
    problems_.add(
        line, in_words(names) + " form " + none.why + ": there is no operating point" + expected);
  }

  // With uic: from ic=, else from .ic, where the potential of other nodes is 0. Charges of junctions are those at these
  // potentials.
  Json given_values() {
    Json initial = Json::object();
    StaticCircuit begin = circuit_.fixed;
    begin.couplings.clear();
    for (const NetlistStorage& storage : circuit_.storages) {
      const StaticElement& element = circuit_.fixed.elements[storage.element];
      std::optional<std::string> given = storage.given;
      if (!given && storage.is_capacitor) {
        const auto from = given_.find(element.from), to = given_.find(element.to);
        if (from != given_.end() && to != given_.end())
          given = "(" + from->second + " - " + to->second + ")";
        else if (from != given_.end())
          given = from->second;
        else if (to != given_.end())
          given = "(-" + to->second + ")";
      }
      initial[storage.state] = given ? written_value(storage.value + "*" + *given) : Json(0);
      StaticElement& stands = begin.elements[storage.element];
      stands.kind =
          storage.is_capacitor ? StaticElement::Kind::voltage : StaticElement::Kind::current;
      stands.value = given ? circuit_.value_of(*given, storage.line) : 0.0;
    }
    set_switches(begin, circuit_.switches);
    add_states_of_switches(initial);
    for (const NetlistJunction& junction : circuit_.junctions)
      initial[junction.state] =
          junction.at(given_voltage(junction.element), given_voltage(junction.other));
    return initial;
  }

  // With uic, across an element.
  double given_voltage(std::size_t element) const {
    const auto potential = [&](std::size_t node) {
      const auto terminal = circuit_.terminals.find(node);
      const auto given =
          given_values_.find(terminal == circuit_.terminals.end() ? node : terminal->second);
      return given == given_values_.end() ? 0.0 : given->second;
    };
    const StaticElement& between = circuit_.fixed.elements[element];
    return potential(between.from) - potential(between.to);
  }

  void tell_what_has_no_effect() {
    for (const NetlistStorage& storage : circuit_.storages)
      if (storage.given && !circuit_.from_given)
        note(storage.line, "ic= has no effect without uic in .tran");
    if (!circuit_.from_given) return;
    const auto meets = [&](std::size_t element, std::size_t node) {
      const auto is_at = [&](std::size_t end) {
        const auto terminal = circuit_.terminals.find(end);
        return end == node || (terminal != circuit_.terminals.end() && terminal->second == node);
      };
      const StaticElement& between = circuit_.fixed.elements[element];
      return is_at(between.from) || is_at(between.to);
    };
    for (const auto& given : given_lines_) {
      const std::size_t node = given.first;
      if (std::ranges::none_of(circuit_.storages,
                               [&](const NetlistStorage& storage) {
                                 return storage.is_capacitor && !storage.given &&
                                        meets(storage.element, node);
                               }) &&
          std::ranges::none_of(circuit_.junctions, [&](const NetlistJunction& junction) {
            return meets(junction.element, node);
          }))
        note(given.second, "the potential of " + circuit_.name_of(node) +
                               " has no effect: with uic it is that of capacitors without ic= and "
                               "of junctions with a "
                               "charge, and there is none at this node");
    }
  }

  LineProblems problems_{"the netlist"};
  std::vector<Problem> notes_;
  std::map<std::string, std::vector<std::string>> lines_of_notes_;
  Deck deck_;
  std::string title_;
  NetlistCircuit circuit_;
  Times times_;
  double largest_step_;
  std::map<std::size_t, std::string> given_;  // potentials of nodes, by .ic
  std::map<std::size_t, double> given_values_;
  std::map<std::size_t, int> given_lines_;
  Json initial_ = Json::object();
  bool is_stiff_ = false;
};

}  // namespace

Json import_netlist(std::string_view text, std::vector<Problem>* notes,
                    const IncludedText& included) {
  const Import import(text, included);
  if (notes) *notes = import.notes();
  return import.experiment();
}

}  // namespace courant
