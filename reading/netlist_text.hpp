// The text of a SPICE netlist: lines, words, numbers and expressions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace courant::netlist {

// What is wrong with a line.
struct LineError {
  int line;
  std::string what;
};

// A line with those that continue it: its words in lower case, `{…}` and '…' as one word with
// braces; "(", ")" and "," are spaces, "=" is a word.
struct Line {
  int number;
  std::vector<std::string> words;
  std::vector<std::string> written;  // the same in the case of the text
};

// All lines after the title but comments. `title` is the first line.
std::vector<Line> lines_of(std::string_view text, std::string& title);

// `4.7k`, `10uF`, `1meg`; nothing if it is no number.
std::optional<double> number(std::string_view word);
// Names of parameters in a scope: what each is called in the experiment.
using Scope = std::map<std::string, std::string>;

// A number, a name or an expression in braces, as a formula. Throws LineError if it is none.
std::string formula(const std::string& word, const Scope& scope, int line);

}  // namespace courant::netlist
