// EnsembleFolder: an ensemble in its folder.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "courant/running/ensemble_run.hpp"
#include "courant/running/growing_file.hpp"
#include "courant/running/run_files.hpp"
#include "courant/running/run_folder.hpp"

namespace courant {

// Keeps an ensemble as files (docs/ensembles.md has them): experiment.json, ensemble.npy with columns.json,
// members.jsonl, events.csv where there are events, summary.json and statistics.csv. A kill at any moment leaves whole
// members, and one that goes on leaves the bytes of one that was never stopped, but for times in the summary. Nothing
// is written before begin().
class EnsembleFolder final : public EnsembleKeeper {
 public:
  EnsembleFolder(std::filesystem::path path, ExistingRun existing);

  // These throw UnusableFolder, those after them OutputError.
  void check(const Experiment& experiment) override;
  void begin(const Experiment& experiment, const EnsembleOpening& opening,
             const std::function<void(const EnsembleMember&)>& recall) override;
  std::string id() const override { return folder_->id(); }
  void append(const EnsembleMember& member) override;
  void tell(const Json& summary, const std::string& statistics) override;

 private:
  std::filesystem::path file(const char* name) const { return path_ / name; }
  std::string header() const;  // of ensemble.npy
  void recall_members(const std::function<void(const EnsembleMember&)>& recall);
  void flush();

  std::filesystem::path path_;
  ExistingRun existing_;
  EnsembleOpening opening_;
  std::optional<RunFolder> folder_;
  std::optional<GrowingFile> numbers_, members_, events_;
  Index count_ = 0;  // members that are written
  std::chrono::steady_clock::time_point flushed_ = {};
};

// statistics.csv and summary.json of an ensemble's folder: what its figure is made of.
struct EnsembleTables {
  Json summary;
  TrajectoryTable statistics;  // t, q.mean, q.standard_deviation, q.min, q.max, …
};

// Throws RunFileError.
EnsembleTables read_ensemble_tables(const std::filesystem::path& folder);

}  // namespace courant
