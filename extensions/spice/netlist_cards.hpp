// The cards of a SPICE netlist: which elements, parameters and subcircuits it has.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "courant/extensions/spice/netlist_sources.hpp"
#include "courant/extensions/spice/netlist_text.hpp"
#include "courant/reading/findings.hpp"

namespace courant::netlist {

// `name = value` of a netlist, with the number of its line.
struct Assignment {
  std::string name, value;
  int line;
};
using Assignments = std::vector<Assignment>;

// The words of a line before its first assignment, and the assignments `name = value` at its end.
struct Card {
  const Line* line;
  std::vector<std::string> words;
  Assignments assigned;

  // Throws LineError if there is none.
  const std::string& word(std::size_t i, const char* what) const;
  // Nothing if it is not assigned.
  std::optional<std::string> value(const std::string& key) const;
  // The word or, where words end before it, what is assigned to the key. Throws LineError.
  const std::string& value_of(std::size_t i, const std::string& key) const;
  // Throws LineError if there are more words than that, or assignments to other keys.
  void allow(std::size_t words, const std::vector<std::string>& keys) const;
};
// Throws LineError.
Card card_of(const Line& line);

// What .model says: `d`, `npn`, … and its parameters.
struct DeviceModel {
  int line = 0;
  std::string type;
  std::map<std::string, std::string> values = {};

  // The value of a parameter as it is written, or what it is where it is not given.
  std::string value(const std::string& key, const std::string& otherwise) const;
};

// The netlist itself, or one of its subcircuits.
struct Part {
  int line = 0;
  std::string path = {};  // `outer/inner`, of a subcircuit that stands in another one
  std::vector<std::string> nodes = {};
  Assignments header = {};      // parameters that an instance may set
  Assignments parameters = {};  // of .param
  std::map<std::string, DeviceModel> models = {};
  std::vector<Line> elements = {};
};

// A potential of .ic or .nodeset, as it is written.
struct InitialPotential {
  std::string node, value;
  int line;
};

// A netlist in its parts, before anything is evaluated.
struct Deck {
  std::string title;
  Part whole;
  std::map<std::string, Part> subcircuits;  // by their paths
  std::optional<Card> transient;
  bool from_given = false;  // uic of a tran of the commands whose times these know
  std::vector<Line> lines;  // which the cards point to
  std::vector<InitialPotential> initial, nodesets;
  std::set<std::string> globals = {};  // nodes that are the same in all subcircuits
  std::string temperature = {};        // of .temp or .options, in °C, where it is not 27
  // Cards that do not change a transient, each once: .ac, .print, .control, ….
  std::vector<std::string> passed = {};
};

// What the name means in a part whose path is given: what stands in the part itself, or next around it. `find` has a
// pointer to it for a path, or none.
template <typename Find>
auto in_scope(std::string path, const Find& find) {
  auto found = find(path);
  while (!found && !path.empty()) {
    const std::size_t slash = path.rfind('/');
    path.resize(slash == std::string::npos ? 0 : slash);
    found = find(path);
  }
  return found;
}

// Reads all cards but those of elements. What says what to show, how accurately, or asks for another analysis is passed
// over, and so is what stands between .control and .endc; but where there is no .tran, that of the commands is taken. A .tran without
// times goes on with that before.
Deck read_deck(std::string_view text, LineProblems& problems, const IncludedText& included = {});

}  // namespace courant::netlist
