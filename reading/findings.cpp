#include "courant/reading/findings.hpp"

#include <map>

namespace courant {
namespace {

std::string lines(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.line();
  }
  return text;
}

}  // namespace

std::string Problem::line() const { return (where.empty() ? "" : where + ": ") + what; }

ExperimentError::ExperimentError(std::vector<Problem> problems)
    : std::invalid_argument(lines(problems)), problems_(std::move(problems)) {}

ExperimentError::ExperimentError(std::string where, std::string what)
    : ExperimentError(std::vector<Problem>{{std::move(where), std::move(what)}}) {}

void Findings::problem(std::string where, std::string what) {
  problems_.push_back({std::move(where), std::move(what)});
}

void Findings::default_value(std::string pointer, Json value) {
  defaults_.emplace_back(std::move(pointer), std::move(value));
}

void Findings::take_problems(const Findings& others, const std::string& addition) {
  for (const Problem& other : others.problems_) problem(other.where, other.what + addition);
}

void Findings::take_defaults(const Findings& others) {
  defaults_.insert(defaults_.end(), others.defaults_.begin(), others.defaults_.end());
}

void Findings::require_clean() const {
  if (clean()) return;
  constexpr int most = 3;
  std::map<std::string, int> count;
  std::vector<Problem> told;
  for (const Problem& problem : problems_)
    if (++count[problem.where] <= most) told.push_back(problem);
  for (const auto& [where, all] : count)
    if (all > most) told.push_back({where, "has " + std::to_string(all - most) + " more problems"});
  throw ExperimentError(told);
}

Json Findings::completed(Json document) const {
  for (const auto& [pointer, value] : defaults_) document[Json::json_pointer(pointer)] = value;
  return document;
}

}  // namespace courant
