// Problems of a text, told by its lines.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace courant {

// What is wrong with a line.
struct LineError {
  int line;
  std::string what;
};

// What is wrong with the lines of a text.
class LineProblems {
 public:
  // `whole` is what the text is called where a problem is of no line: "the netlist".
  explicit LineProblems(std::string whole) : whole_(std::move(whole)) {}

  // Line 0 is the whole.
  void add(int line, const std::string& what);
  // Does it; a LineError is a problem. `origin`: of a line of an included file.
  void guard(const std::function<void()>& action, const std::string& origin = "");
  bool empty() const { return problems_.empty(); }
  // Throws ExperimentError, in the order of the lines, unless empty().
  void require_none() const;

 private:
  std::string whole_;
  std::vector<std::pair<int, std::string>> problems_;
};

// `rs`, `rs and cjo`, `rs, cjo and tt`
std::string in_words(const std::vector<std::string>& names);

}  // namespace courant
