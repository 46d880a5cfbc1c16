// Names of a file of another program as names of formulas.
#pragma once

#include <map>
#include <set>
#include <string>

namespace courant {

// The text with _ for what is no letter and no digit, and `_plus` and `_minus` for + and - at its end.
std::string identifier(const std::string& text);

// Different names for different ones: `o+`, `x1.m` and `R-1` are o_plus, x1_m and R_1 or, where that
// is another one's name, R_1_2. A name that is an identifier is kept.
class DifferentNames {
 public:
  // All words of the file: what stands there is no name for anything else.
  explicit DifferentNames(std::set<std::string> words) : taken_(std::move(words)) {}

  const std::string& of(const std::string& written);

 private:
  std::set<std::string> taken_;
  std::map<std::string, std::string> names_;
};

}  // namespace courant
