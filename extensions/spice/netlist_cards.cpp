#include "courant/extensions/spice/netlist_cards.hpp"

#include <algorithm>
#include <deque>
#include <set>

namespace courant::netlist {
namespace {

// Cards that say what to show and how accurately, or ask for another analysis: an experiment has its own ways.
bool is_passed_over(const std::string& word) {
  static const std::set<std::string> known = {
      ".print",  ".plot",    ".save",  ".probe",   ".options",  ".option",  ".opt",
      ".op",     ".width",   ".meas",  ".four",    ".ac",       ".dc",      ".tf",
      ".noise",  ".sens",    ".pz",    ".disto",   ".temp",     ".graph",   ".wave",
      ".step",   ".measure", ".sp",    ".pss",     ".backanno", ".csparam", ".list",
      ".status", ".stat",    ".store", ".fourier", ".fanout"};
  return known.contains(word);
}

class DeckReader {
 public:
  DeckReader(Deck& deck, LineProblems& problems) : deck_(deck), problems_(problems) {}

  void read() {
    for (const Line& line : deck_.lines) problems_.guard([&] { read_line(line); }, line.origin);
    if (!deck_.transient) deck_.transient = commanded_;
    for (const Part* open : open_)
      problems_.add(open->line, "this .subckt has no .ends; expected one after its elements");
    if (control_ > 0) problems_.add(control_, ".control has no .endc; expected one");
  }

 private:
  void read_line(const Line& line) {
    const std::string& first = line.words[0];
    if (control_ > 0) {
      if (first == ".endc") control_ = 0;
      if (first == "tran" && !commanded_) {
        if (has_times(line))
          commanded_ = card_of(line);
        else
          deck_.from_given = deck_.from_given || line.words.back() == "uic";
      }
    } else if (first == ".control") {
      control_ = line.number;
      pass(first);
    } else if (first == ".global") {
      deck_.globals.insert(line.words.begin() + 1, line.words.end());
    } else if (first == ".subckt") {
      begin(card_of(line));
    } else if (first == ".ends") {
      if (open_.empty()) throw LineError{line.number, "ends no .subckt; expected one before"};
      open_.pop_back();
    } else if (first == ".model") {
      add_model(line);
    } else if (first == ".param") {
      const Card card = card_of(line);
      if (card.words.size() > 1) throw LineError{line.number, "expected .param name=value …"};
      for (const Assignment& assignment : card.assigned) part().parameters.push_back(assignment);
    } else if (first == ".tran" || first == ".transient") {
      if (has_times(line)) deck_.transient = card_of(line);
    } else if (first == ".ic") {
      add_potentials(line, deck_.initial);
    } else if (first == ".nodeset") {
      add_potentials(line, deck_.nodesets);
    } else if (first == ".title") {
      deck_.title.clear();
      for (std::size_t i = 1; i < line.written.size(); ++i)
        deck_.title += (i > 1 ? " " : "") + line.written[i];
    } else if (first[0] == '.' && is_passed_over(first)) {
      take_temperature(line);
      pass(first);
    } else if (first[0] == '.') {
      throw LineError{line.number, first + " is not supported"};
    } else {
      part().elements.push_back(line);
    }
  }

  Part& part() { return open_.empty() ? deck_.whole : *open_.back(); }

  // `.tran` and `tran $&end`, whose times commands know, have none.
  static bool has_times(const Line& line) {
    return line.words.size() > 1 && line.words[1] != "trace" &&
           line.text.find('$') == std::string::npos;
  }

  void take_temperature(const Line& line) {
    const auto& words = line.words;
    std::string found;
    if (words[0] == ".temp" && words.size() > 1) found = words[1];
    if (words[0].starts_with(".opt"))
      for (std::size_t i = 1; i + 2 < words.size(); ++i)
        if (words[i] == "temp" && words[i + 1] == "=") found = words[i + 2];
    if (!found.empty() && number(found) != std::optional(27.0)) deck_.temperature = found;
  }

  void pass(const std::string& card) {
    if (std::ranges::find(deck_.passed, card) == deck_.passed.end()) deck_.passed.push_back(card);
  }

  void begin(const Card& card) {
    const int line = card.line->number;
    const std::string& name = card.word(1, "name");
    const std::string path = part().path.empty() ? name : part().path + "/" + name;
    const auto [known, is_new] = deck_.subcircuits.try_emplace(path);
    // Its elements are read all the same.
    open_.push_back(is_new ? &known->second : &seconds_.emplace_back());
    part().line = line;
    part().path = path;
    for (std::size_t i = 2; i < card.words.size(); ++i)
      if (card.words[i] != "params:") part().nodes.push_back(card.words[i]);
    part().header = card.assigned;
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
  void add_model(const Line& line) {
    const Card card{&line, line.words, {}};
    const std::string& name = card.word(1, "name");
    const std::string& type = card.word(2, "type");
    const auto [known, is_new] = part().models.try_emplace(name);
    if (!is_new)
      throw LineError{line.number, "the model " + name + " is that of line " +
                                       std::to_string(known->second.line) + " again"};
    DeviceModel& model = known->second;
    model.line = line.number;
    model.type = type;
    // `name = value`, `name value` or a name alone; a value may be a list of numbers.
    std::string* last = nullptr;
    for (std::size_t i = 3; i < line.words.size(); ++i) {
      const std::string& word = line.words[i];
      if (number(word) && last) {
        *last += "," + word;
        continue;
      }
      const bool has_sign = i + 1 < line.words.size() && line.words[i + 1] == "=";
      const std::size_t next = has_sign ? i + 2 : i + 1;
      const bool has_value = next < line.words.size() && (has_sign || number(line.words[next]));
      if (word == "=" || (has_sign && !has_value))
        throw LineError{line.number, "expected name = value at the end"};
      last = &(model.values[word] = has_value ? line.words[next] : "1");
      if (has_value) i = next;
    }
  }

  Deck& deck_;
  LineProblems& problems_;
  std::vector<Part*> open_;        // subcircuits that have begun
  std::deque<Part> seconds_;       // those whose name is taken
  int control_ = 0;                // the line of .control, inside
  std::optional<Card> commanded_;  // tran of the commands there
};

}  // namespace

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
