// What reading an experiment found: its problems, and what it leaves to defaults.
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace courant {

using Json = nlohmann::ordered_json;

// Something wrong with an experiment. `where` is a JSON pointer, `line 3, column 7` in a text that
// is not JSON, or empty for the whole.
struct Problem {
  std::string where;
  std::string what;

  std::string line() const;  // "where: what"
};

// An experiment that cannot be carried out as it is written. what() has a line `where: what` for
// each of the problems, of which there is at least one.
class ExperimentError : public std::invalid_argument {
 public:
  explicit ExperimentError(std::vector<Problem> problems);
  ExperimentError(std::string where, std::string what);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

// Problems are collected, so that a reader is told all of them at once.
class Findings {
 public:
  void problem(std::string where, std::string what);
  void default_value(std::string pointer, Json value);
  // Those of others, with an addition at the end of each problem.
  void take_problems(const Findings& others, const std::string& addition);
  void take_defaults(const Findings& others);

  bool clean() const { return problems_.empty(); }
  const std::vector<Problem>& problems() const { return problems_; }
  // Throws ExperimentError unless clean(). Of the problems at one place it has three, and how many
  // more there are.
  void require_clean() const;

  // The document with the defaults filled in.
  Json completed(Json document) const;

 private:
  std::vector<Problem> problems_;
  std::vector<std::pair<std::string, Json>> defaults_;  // parents before their children
};

}  // namespace courant
