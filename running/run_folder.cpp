#include "courant/running/run_folder.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

#include "courant/core/files/own_file.hpp"
#include "courant/running/run_files.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

// What runs and their reports write. The checkpoint is the first to be removed: what is left of the
// others begins anew.
constexpr std::array kFiles = {"checkpoint.json", "summary.json",  "trajectory.csv",
                               "trajectory.npy",  "columns.json",  "experiment.json",
                               "events.csv",      "report.html",   "ensemble.npy",
                               "members.jsonl",   "statistics.csv"};

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json json_in(const fs::path& file) {
  try {
    return read_json(file);
  } catch (const RunFileError&) {
    return {};
  }
}

// Whether the files are those of a run: its summary says so, or its experiment where it was killed
// before there was one.
bool is_of_a_run(const fs::path& folder) {
  const Json summary = json_in(folder / "summary.json");
  if (summary.is_object()) return summary.contains("status") && summary.contains("ladder");
  const Json experiment = json_in(folder / "experiment.json");
  return experiment.is_object() && experiment.contains("$run");
}

// Whether the run with this experiment wrote the file: what runs do not write in its format, or
// without events or an ensemble, is not its own, nor is a report that was edited.
bool is_own(const fs::path& file, const Json& experiment) {
  const std::string name = file.filename().string();
  if (name == "report.html") return mark_of(file).has_value();
  const Json output = experiment.value("output", Json());
  const bool is_npy = output.is_object() && output.value("format", Json()) == "npy";
  if (name == "ensemble.npy" || name == "members.jsonl" || name == "statistics.csv")
    return experiment.contains("ensemble");
  if (name == "columns.json" && experiment.contains("ensemble")) return true;
  if (name == "trajectory.npy" || name == "columns.json") return is_npy;
  if (name == "trajectory.csv") return !is_npy;
  return name != "events.csv" || experiment.contains("events");
}

std::string new_id() {
  std::random_device random;
  std::string id;
  for (int i = 0; i < 16; ++i) id += "0123456789abcdef"[random() % 16];
  return id;
}

bool has_entry(const fs::path& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));  // a link that leads nowhere is one, too
}

[[noreturn]] void refuse_foreign(const fs::path& file) {
  refuse_folder(file, "is there already, and no run wrote it; expected another folder (-o)");
}

// The files of an earlier run, if they may be replaced.
std::vector<fs::path> replaceable(const fs::path& path, bool replace) {
  std::vector<fs::path> found, foreign;
  Json experiment = json_in(path / "experiment.json");
  if (!experiment.is_object()) experiment = Json::object();
  for (const char* name : kFiles)
    if (const fs::path file = path / name; has_entry(file))
      (is_own(file, experiment) ? found : foreign).push_back(file);
  std::erase_if(foreign, [](const fs::path& file) { return file.filename() == "report.html"; });
  if (!found.empty() && !is_of_a_run(path)) refuse_foreign(found.front());
  if (!foreign.empty()) refuse_foreign(foreign.front());
  if (!found.empty() && !replace)
    refuse_folder(
        path,
        "there is a run in this folder; expected another folder (-o), --force to replace it, or "
        "--resume to go on with it");
  return found;
}

void remove_files(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    std::error_code error;
    fs::remove(file, error);
    if (error) refuse_folder(file, "cannot be replaced: " + error.message());
  }
}

constexpr const char* kRunIsWritten =
    "another run is being written to this folder; expected another folder (-o)";

}  // namespace

void RunFolder::check(const fs::path& path, ExistingRun existing, const Experiment& experiment) {
  LockedFolder::check_place(path);
  if (LockedFolder::is_in_use(path)) refuse_folder(path, kRunIsWritten);
  if (existing == ExistingRun::resume)
    unfinished_run(path, experiment);
  else
    replaceable(path, existing == ExistingRun::replace);
}

void RunFolder::remove(const fs::path& path) {
  if (!is_of_a_run(path)) return;
  remove_files(replaceable(path, true));
  std::error_code not_empty;
  fs::remove(path, not_empty);
}

namespace {

// A run that is to go on is there already.
fs::path existing(fs::path path, bool is_to_go_on) {
  std::error_code unreadable;
  if (is_to_go_on && !fs::is_directory(path, unreadable))
    refuse_folder(path, "there is no run in this folder that could go on");
  return path;
}

}  // namespace

RunFolder::RunFolder(fs::path path, ExistingRun existing_run, const Experiment& experiment)
    : folder_(existing(std::move(path), existing_run == ExistingRun::resume), kRunIsWritten) {
  const fs::path& there = folder_.path();
  try {
    if (existing_run == ExistingRun::resume) {
      run_ = unfinished_run(there, experiment);
      if (const fs::path report = there / "report.html"; mark_of(report))
        remove_files({report});  // of the run as it was
    } else {
      run_.id = new_id();
      remove_files(replaceable(there, existing_run == ExistingRun::replace));
    }
    Json document = experiment.document;
    document["$run"] = run_.id;
    write_file(there / "experiment.json", json_text(document));
  } catch (const RefusedOutput&) {
    throw;
  } catch (const OutputError& error) {
    throw UnusableFolder(error.what());
  }
}

fs::path RunFolder::checkpoint_file() const { return path() / "checkpoint.json"; }

void RunFolder::remove_rows() const {
  const Json experiment = json_in(path() / "experiment.json");
  std::vector<fs::path> own;
  for (const char* name : {"trajectory.csv", "trajectory.npy", "events.csv"})
    if (const fs::path file = path() / name; has_entry(file) && is_own(file, experiment))
      own.push_back(file);
  remove_files(own);
}

void RunFolder::write_checkpoint(const Checkpoint& checkpoint) const {
  folder_.require_still_there();
  courant::write_checkpoint(checkpoint_file(), checkpoint);
}

void RunFolder::write_summary(const RunSummary& summary) { write_summary(to_json(summary)); }

void RunFolder::write_summary(const Json& summary) {
  constexpr std::size_t message = 1 << 14;  // more than a summary says of how a run ended
  folder_.require_still_there();
  const fs::path file = path() / "summary.json";
  const std::string text = json_text(summary);
  try {
    write_file(file, text);
  } catch (const OutputError&) {
    if (!last_word_) throw;
    last_word_.reset();
    return write_file(file, text);
  }
  if (!last_word_) last_word_.emplace(path(), text.size() + message);
}

}  // namespace courant
