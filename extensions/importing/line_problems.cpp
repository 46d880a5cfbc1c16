#include "courant/extensions/importing/line_problems.hpp"

#include <algorithm>

#include "courant/reading/findings.hpp"

namespace courant {

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
    told.push_back({line > 0 ? "line " + std::to_string(line) : whole_, what});
  throw ExperimentError(told);
}

}  // namespace courant
