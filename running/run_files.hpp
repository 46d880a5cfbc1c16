// Reading a finished run: a folder with its trajectory, its summary and its experiment.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "courant/running/run_summary.hpp"

namespace courant {

// A file of a run that cannot be read or is not what it should be. One line: `file:line: what it
// is`, or `file: /json/pointer: what it is`.
class RunFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Named columns of the same number of rows. The first is t; no two have the same name. Units, which
// stand in the heads of columns, belong to no name.
class TrajectoryTable {
 public:
  // Throws std::invalid_argument when the columns are not as many as the names or not all as long,
  // when a name repeats, or when the first is not t.
  TrajectoryTable(std::vector<std::string> names, std::vector<std::vector<double>> columns);

  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return columns_.front().size(); }
  bool contains(std::string_view name) const;
  // The values of a column; throws std::invalid_argument when there is none of this name.
  std::span<const double> column(std::string_view name) const;

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::size_t, std::less<>> places_;  // of the names among them
  std::vector<std::vector<double>> columns_;
};

// A run as its files tell it.
struct Run {
  std::string name;  // of the folder
  TrajectoryTable trajectory;
  RunSummary summary;
  nlohmann::ordered_json experiment;
  // By name: when each event occurred, and what was measured there.
  std::map<std::string, TrajectoryTable> events = {};

  // The columns by what they are: `constraint[i]`, the observables of the summary, and the rest but
  // t.
  std::vector<std::string> coordinates() const;
  std::vector<std::string> observables() const;
  std::vector<std::string> constraints() const;

  // What an axis says of a quantity: its label, or its name, and its unit: "distance [m]".
  std::string axis_label(const std::string& quantity) const;
};

// Reads trajectory.csv, or trajectory.npy with columns.json (an array of names), summary.json, experiment.json and, if
// there is one, events.csv. Of a run that did not end, which was killed or goes on, the rows that are whole are read,
// and the summary has a message that says so. Throws RunFileError, also where the files are of several runs.
Run read_run(const std::filesystem::path& directory);

// Whether a folder has an ensemble, which read_run() refuses.
bool is_ensemble_folder(const std::filesystem::path& directory);

// The folders of the runs that a folder stands for: those of its table that were made, where it is that of a sweep,
// otherwise the folder itself.
std::vector<std::filesystem::path> run_folders_in(const std::filesystem::path& directory);

// The parts, each usable alone. Throw RunFileError.
// `torn`: the last row may be cut off, and is then left out.
TrajectoryTable read_trajectory_csv(const std::filesystem::path& file, bool torn = false);
std::map<std::string, TrajectoryTable> read_events_csv(const std::filesystem::path& file,
                                                       bool torn = false);
TrajectoryTable read_trajectory_npy(const std::filesystem::path& file,
                                    std::vector<std::string> names, bool torn = false);
nlohmann::ordered_json read_json(const std::filesystem::path& file);
RunSummary read_summary(const std::filesystem::path& file);

}  // namespace courant
