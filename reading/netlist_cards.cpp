#include "courant/reading/netlist_cards.hpp"

#include <algorithm>
#include <set>

namespace courant::netlist {
namespace {

// Cards that say what to show and how accurately, or ask for another analysis: an experiment has its own ways.
bool is_passed_over(const std::string& word) {
  static const std::set<std::string> known = {
      ".print", ".plot",    ".save", ".probe", ".options",  ".option", ".opt",
      ".op",    ".width",   ".meas", ".four",  ".ac",       ".dc",     ".tf",
      ".noise", ".sens",    ".pz",   ".disto", ".temp",     ".graph",  ".wave",
      ".step",  ".measure", ".sp",   ".pss",   ".backanno", ".csparam"};
  return known.contains(word);
}

class DeckReader {
 public:
  DeckReader(Deck& deck, LineProblems& problems) : deck_(deck), problems_(problems) {}

  void read() {
    for (const Line& line : deck_.lines) problems_.guard([&] { read_line(line); }, line.origin);
    if (!deck_.transient) deck_.transient = commanded_;
    if (part_ != &deck_.whole)
      problems_.add(part_->line, "this .subckt has no .ends; expected one after its elements");
    if (control_ > 0) problems_.add(control_, ".control has no .endc; expected one");
  }

 private:
  void read_line(const Line& line) {
    const std::string& first = line.words[0];
    if (control_ > 0) {
      if (first == ".endc") control_ = 0;
      if (first == "tran" && !deck_.transient) commanded_ = card_of(line);
    } else if (first == ".control") {
      control_ = line.number;
      pass(first);
    } else if (first == ".global") {
      deck_.globals.insert(line.words.begin() + 1, line.words.end());
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
    } else if (first[0] == '.' && is_passed_over(first)) {
      pass(first);
    } else if (first[0] == '.') {
      throw LineError{line.number, first + " is not supported"};
    } else {
      part_->elements.push_back(line);
    }
  }

  void pass(const std::string& card) {
    if (std::ranges::find(deck_.passed, card) == deck_.passed.end()) deck_.passed.push_back(card);
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

  // What a model says is looked at where an element uses it.
  void add_model(const Card& card) {
    const int line = card.line->number;
    const std::string& name = card.word(1, "name");
    const std::string& type = card.word(2, "type");
    const auto [known, is_new] = part_->models.try_emplace(name);
    if (!is_new)
      throw LineError{line, "the model " + name + " is that of line " +
                                std::to_string(known->second.line) + " again"};
    known->second.line = line;
    known->second.type = type;
    for (const auto& [key, value, where] : card.assigned) known->second.values[key] = value;
    for (std::size_t i = 3; i < card.words.size(); ++i) known->second.values[card.words[i]] = "1";
  }

  Deck& deck_;
  LineProblems& problems_;
  Part* part_ = &deck_.whole;
  Part second_;                    // a subcircuit whose name is taken
  int control_ = 0;                // the line of .control, inside
  std::optional<Card> commanded_;  // tran of the commands there
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

void LineProblems::guard(const std::function<void()>& action, const std::string& origin) {
  try {
    action();
  } catch (const LineError& error) {
    add(error.line, origin.empty() ? error.what : "(" + origin + ") " + error.what);
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
  for (std::size_t k = i - 1; k < card.words.size();) {
    if (k + 2 >= card.words.size() || card.words[k + 1] != "=" || card.words[k + 2] == "=")
      throw LineError{line.number, "expected name = value at the end"};
    std::string value = card.words[k + 2];
    // Several values, as of tc=1m,2u: up to the next name.
    std::size_t next = k + 3;
    for (; next < card.words.size() && number(card.words[next]) &&
           (next + 1 == card.words.size() || card.words[next + 1] != "=");
         ++next)
      value += "," + card.words[next];
    card.assigned.push_back({card.words[k], value, line.number});
    k = next;
  }
  card.words.resize(i - 1);
  return card;
}

std::string DeviceModel::value(const std::string& key, const std::string& otherwise) const {
  const auto found = values.find(key);
  return found == values.end() ? otherwise : found->second;
}

Deck read_deck(std::string_view text, LineProblems& problems, const IncludedText& included) {
  Deck deck;
  problems.guard([&] { deck.lines = lines_of(text, deck.title, included); });
  DeckReader(deck, problems).read();
  return deck;
}

}  // namespace courant::netlist
