// The text of a SPICE netlist: lines, words, numbers and expressions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "courant/extensions/importing/included_text.hpp"
#include "courant/extensions/importing/line_problems.hpp"

namespace courant::netlist {

// A line with those that continue it: its words in lower case, `{…}` and '…' as one word with
// braces; "(", ")" and "," are spaces, "=" is a word.
struct Line {
  int number;
  std::string text =
      {};  // as written, joined, with calls of .func in place of which their bodies stand
  std::vector<std::string> words;
  std::vector<std::string> written;  // the same in the case of the text
  std::string origin = {};           // of an included file: `models.lib, line 7`
};

// All lines after the title but comments, with those of included files and what .func defines put in their
// places. `title` is the first line. Lines of included files have the number of the line that includes them.
std::vector<Line> lines_of(std::string_view text, std::string& title,
                           const IncludedText& included = {});

// `4.7k`, `10uF`, `1meg`; nothing if it is no number.
std::optional<double> number(std::string_view word);
// Names of parameters in a scope: what each is called in the experiment.
using Scope = std::map<std::string, std::string>;

}  // namespace courant::netlist
