// Runs to draw.
#pragma once

#include <string>
#include <vector>

#include "../running/vortex_runs.hpp"
#include "courant/plotting/figure.hpp"
#include "courant/running/run_files.hpp"

namespace courant::test {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

inline Run vortices(const std::string& name, const std::string& method, const Path& path) {
  std::vector<std::string> names = {"t"};
  for (const char* axis : {"x", "y"}) {
    for (int j = 0; j < 4; ++j) names.push_back(axis + std::string("[") + std::to_string(j) + "]");
  }
  names.emplace_back("H");
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    columns[0].push_back(static_cast<double>(k));
    for (std::size_t i = 0; i < 8; ++i) columns[1 + i].push_back(path[k][i]);
    columns[9].push_back(energy(path[k]));
  }
  return {name, {names, columns}, read_run_summary(summary(path, method)), Json::object()};
}

inline Run table(const std::vector<std::string>& names, std::size_t rows,
                 double (*value)(std::size_t column, double t)) {
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t c = 0; c < names.size(); ++c) {
    for (std::size_t k = 0; k < rows; ++k) {
      const double t = 0.05 * static_cast<double>(k);
      columns[c].push_back(c == 0 ? t : value(c, t));
    }
  }
  const RunSummary summary{.status = RunStatus::completed,
                           .system = "s",
                           .method = "m",
                           .steps = static_cast<long>(rows - 1)};
  return {"table", {names, columns}, summary, Json::object()};
}

inline std::vector<std::string> labels(const std::vector<plot::Series>& series) {
  std::vector<std::string> all;
  for (const auto& one : series) all.push_back(one.label);
  return all;
}

}  // namespace courant::test
