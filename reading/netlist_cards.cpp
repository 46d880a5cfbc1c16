#include "courant/reading/netlist_cards.hpp"

#include <algorithm>
#include <set>

namespace courant::netlist {
namespace {

// Cards and commands that say what to show and how accurately: an experiment has its own ways.
bool only_shows(const std::string& word) {
  static const std::set<std::string> known = {
      ".print",  ".plot", ".save",     ".probe",   ".options", ".option", ".op",      ".width",
      ".meas",   ".four", ".backanno", ".measure", "run",      "print",   "plot",     "save",
      "set",     "unset", "display",   "listing",  "echo",     "write",   "wrdata",   "let",
      "gnuplot", "meas",  "measure",   "hardcopy", "quit",     "exit",    "asciiplot"};
  return known.contains(word);
}

class DeckReader {
 public:
  DeckReader(Deck& deck, LineProblems& problems) : deck_(deck), problems_(problems) {}

  void read() {
    for (const Line& line : deck_.lines) problems_.guard([&] { read_line(line); });
    if (part_ != &deck_.whole)
      problems_.add(part_->line, "this .subckt has no .ends; expected one after its elements");
    if (control_ > 0) problems_.add(control_, ".control has no .endc; expected one");
  }

 private:
  void read_line(const Line& line) {
    const std::string& first = line.words[0];
    if (control_ > 0) {
      if (first == ".endc")
        control_ = 0;
      else if (!only_shows(first))
        throw LineError{line.number, "the command " + first +
                                         " is not supported; expected run, and what shows results"};
    } else if (first == ".control") {
      control_ = line.number;
    } else if (first == ".subckt") {
      begin(card_of(line));
    } else if (first == ".ends") {
      if (part_ == &deck_.whole)
        throw LineError{line.number, "ends no .subckt; expected one before"};
      part_ = &deck_.whole;
    } else if (first == ".model") {
      add_model(card_of(line));
    } else if (first == ".param") {
      const Card card = card_of(line);
      if (card.words.size() > 1 || card.assigned.empty())
        throw LineError{line.number, "expected .param name=value …"};
      for (const Assignment& assignment : card.assigned) part_->parameters.push_back(assignment);
    } else if (first == ".tran") {
      deck_.transient = card_of(line);
    } else if (first == ".ic") {
      add_potentials(line, deck_.initial);
    } else if (first == ".nodeset") {
      add_potentials(line, deck_.nodesets);
    } else if (first == ".title") {
      deck_.title.clear();
      for (std::size_t i = 1; i < line.written.size(); ++i)
        deck_.title += (i > 1 ? " " : "") + line.written[i];
    } else if (first[0] == '.' && !only_shows(first)) {
      throw LineError{line.number, first + " is not supported"};
    } else if (first[0] != '.') {
      part_->elements.push_back(line);
    }
  }

  void begin(const Card& card) {
    const int line = card.line->number;
    if (part_ != &deck_.whole)
      throw LineError{line,
                      "a .subckt inside another is not supported; expected .ends of that in "
                      "line " +
                          std::to_string(part_->line) + " before"};
    const std::string& name = card.word(1, "name");
    const auto [known, is_new] = deck_.subcircuits.try_emplace(name);
    // Its elements are read all the same.
    part_ = is_new ? &known->second : &second_;
    part_->line = line;
    for (std::size_t i = 2; i < card.words.size(); ++i)
      if (card.words[i] != "params:") part_->nodes.push_back(card.words[i]);
    part_->header = card.assigned;
    if (!is_new)
      throw LineError{line, "the subcircuit " + name + " is that of line " +
                                std::to_string(known->second.line) + " again"};
  }

  void add_potentials(const Line& line, std::vector<InitialPotential>& potentials) {
    const auto wrong = [&] {
      return LineError{line.number, "expected " + line.words[0] + " v(node)=value …"};
    };
    if (line.words.size() % 4 != 1 || line.words.size() == 1) throw wrong();
    for (std::size_t i = 1; i < line.words.size(); i += 4) {
      if (line.words[i] != "v" || line.words[i + 2] != "=") throw wrong();
      potentials.push_back({line.words[i + 1], line.words[i + 3], line.number});
    }
  }

  void add_model(const Card& card) {
    const int line = card.line->number;
    const std::string& name = card.word(1, "name");
    if (card.word(2, "type") != "d")
      throw LineError{line,
                      "models of the type " + card.words[2] + " are not supported; expected D"};
    const auto [known, is_new] = part_->models.try_emplace(name);
    if (!is_new)
      throw LineError{line, "the model " + name + " is that of line " +
                                std::to_string(known->second.line) + " again"};
    DiodeModel& model = known->second;
    model.line = line;
    std::vector<std::string> wrong;
    for (const auto& [key, value, where] : card.assigned) {
      if (key == "is")
        model.saturation = value;
      else if (key == "n")
        model.emission = value;
      else if (number(value) != std::optional(0.0) && key != "bv" && key != "ibv" && key != "tnom")
        wrong.push_back(key);
    }
    if (!wrong.empty())
      throw LineError{line, std::string(wrong.size() == 1 ? "the parameter " : "the parameters ") +
                                in_words(wrong) + " of a diode " +
                                (wrong.size() == 1 ? "is" : "are") +
                                " not supported; expected is or n"};
  }

  Deck& deck_;
  LineProblems& problems_;
  Part* part_ = &deck_.whole;
  Part second_;      // a subcircuit whose name is taken
  int control_ = 0;  // the line of .control, inside
};

}  // namespace

std::string in_words(const std::vector<std::string>& names) {
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i)
    words += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return words;
}

void LineProblems::add(int line, const std::string& what) {
  const std::pair problem(line, what);
  if (std::find(problems_.begin(), problems_.end(), problem) == problems_.end())
    problems_.push_back(problem);
}

void LineProblems::guard(const std::function<void()>& action) {
  try {
    action();
  } catch (const LineError& error) {
    add(error.line, error.what);
  }
}

void LineProblems::require_none() const {
  if (problems_.empty()) return;
  auto sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.first > 0 && (b.first == 0 || a.first < b.first);  // the whole last
  });
  std::vector<Problem> told;
  for (const auto& [line, what] : sorted)
    told.push_back({line > 0 ? "line " + std::to_string(line) : "the netlist", what});
  throw ExperimentError(told);
}

const std::string& Card::word(std::size_t i, const char* what) const {
  if (i >= words.size())
    throw LineError{line->number, std::string("has no ") + what + "; expected one"};
  return words[i];
}

std::optional<std::string> Card::value(const std::string& key) const {
  std::optional<std::string> last;
  for (const Assignment& assignment : assigned)
    if (assignment.name == key) last = assignment.value;
  return last;
}

const std::string& Card::value_of(std::size_t i, const std::string& key) const {
  if (i < words.size()) return words[i];
  for (const Assignment& assignment : assigned)
    if (assignment.name == key) return assignment.value;
  return word(i, "value");
}

void Card::allow(std::size_t count, const std::vector<std::string>& keys) const {
  if (words.size() > count)
    throw LineError{line->number,
                    "does not end before \"" + line->written[count] + "\"; expected nothing there"};
  for (const Assignment& assignment : assigned)
    if (std::find(keys.begin(), keys.end(), assignment.name) == keys.end())
      throw LineError{line->number, "the parameter " + assignment.name + " is not supported"};
}

Card card_of(const Line& line) {
  Card card{&line, line.words, {}};
  const auto first = std::find(card.words.begin(), card.words.end(), "=");
  if (first == card.words.end()) return card;
  const auto i = static_cast<std::size_t>(first - card.words.begin());
  if (i == 0) throw LineError{line.number, "begins with ="};
  for (std::size_t k = i - 1; k < card.words.size(); k += 3) {
    if (k + 2 >= card.words.size() || card.words[k + 1] != "=")
      throw LineError{line.number, "expected name = value at the end"};
    card.assigned.push_back({card.words[k], card.words[k + 2], line.number});
  }
  card.words.resize(i - 1);
  return card;
}

Deck read_deck(std::string_view text, LineProblems& problems) {
  Deck deck;
  problems.guard([&] { deck.lines = lines_of(text, deck.title); });
  DeckReader(deck, problems).read();
  return deck;
}

}  // namespace courant::netlist
