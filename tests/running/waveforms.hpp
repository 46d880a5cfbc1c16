// Tables of waveforms, of a run or of ngspice.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace courant {

// Columns by name; the first is the time.
struct Waveforms {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
  // Linear between the rows.
  double at(double t, std::size_t column) const {
    const auto after = std::lower_bound(rows.begin() + 1, rows.end() - 1, t,
                                        [](const auto& row, double time) { return row[0] < time; });
    const auto &left = *(after - 1), &right = *after;
    const double share = right[0] > left[0] ? (t - left[0]) / (right[0] - left[0]) : 0.0;
    return left[column] + share * (right[column] - left[column]);
  }
};

inline Waveforms read_table(const std::filesystem::path& path, char separator) {
  std::ifstream file(path);
  Waveforms table;
  std::string line;
  const auto words = [&] {
    if (separator == ',') std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream stream(line);
    return std::vector<std::string>(std::istream_iterator<std::string>(stream), {});
  };
  if (std::getline(file, line)) table.names = words();
  while (std::getline(file, line)) {
    std::vector<double> row;
    for (const std::string& word : words()) row.push_back(std::strtod(word.c_str(), nullptr));
    if (!row.empty()) table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace courant
