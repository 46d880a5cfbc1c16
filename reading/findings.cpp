#include "courant/reading/findings.hpp"

namespace courant {
namespace {

std::string lines(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += (problem.where.empty() ? "" : problem.where + ": ") + problem.what;
  }
  return text;
}

}  // namespace

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

void Findings::require_clean() const {
  if (!clean()) throw ExperimentError(problems_);
}

Json Findings::completed(Json document) const {
  for (const auto& [pointer, value] : defaults_) document[Json::json_pointer(pointer)] = value;
  return document;
}

}  // namespace courant
