#include "courant/running/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

#include "courant/running/run_files.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

// What a run and its report write; experiment.json and summary.json tell whose they are.
// The checkpoint is the first to be removed: what is left of the others begins anew.
constexpr std::array kFiles = {"checkpoint.json", "summary.json", "trajectory.csv",
                               "trajectory.npy",  "columns.json", "experiment.json",
                               "events.csv",      "report.html"};
// What write_file leaves when it is killed.
constexpr std::array kTorn = {"summary.json.new", "columns.json.new", "checkpoint.json.new",
                              "experiment.json.new"};

void write_json(const fs::path& file, const Json& json) {
  write_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
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

std::string new_id() {
  std::random_device random;
  std::string id;
  for (int i = 0; i < 16; ++i) id += "0123456789abcdef"[random() % 16];
  return id;
}

// The files of an earlier run, if they may be replaced.
std::vector<fs::path> replaceable(const fs::path& path, bool replace) {
  std::vector<fs::path> found;
  for (const char* name : kFiles)
    if (file_exists(path / name)) found.push_back(path / name);
  if (found.empty()) return found;
  if (!is_of_a_run(path))
    refuse_folder(found.front(),
                  "is there already, and no run wrote it; expected another folder (-o)");
  if (!replace)
    refuse_folder(
        path,
        "there is a run in this folder; expected another folder (-o), --force to replace it, or "
        "--resume to go on with it");
  for (const char* name : kTorn)
    if (file_exists(path / name)) found.push_back(path / name);
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

void RunFolder::check_place(const fs::path& path) {
  // Only the attempt tells of names that are too long, and of file systems without folders.
  std::error_code error;
  std::vector<fs::path> missing;
  fs::path nearest = fs::absolute(path, error).lexically_normal();
  for (; !file_exists(nearest) && nearest.has_relative_path(); nearest = nearest.parent_path())
    missing.push_back(nearest);
  error =
      fs::is_directory(nearest) ? std::error_code() : make_error_code(std::errc::not_a_directory);
  std::vector<fs::path> made;
  while (!error && !missing.empty()) {
    if (fs::create_directory(missing.back(), error)) made.push_back(missing.back());
    missing.pop_back();
  }
  for (std::error_code ignored; !made.empty(); made.pop_back()) fs::remove(made.back(), ignored);
  if (error) refuse_folder(path, "the folder cannot be made: " + error.message());
  if (nearest == fs::absolute(path, error).lexically_normal() &&
      access(nearest.c_str(), W_OK | X_OK) != 0)
    refuse_folder(path, "cannot be written: " + std::generic_category().message(errno));
}

void RunFolder::check(const fs::path& path, ExistingRun existing, const Experiment& experiment) {
  check_place(path);
  if (is_in_use(path)) refuse_folder(path, kRunIsWritten);
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

bool RunFolder::is_in_use(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

RunFolder::RunFolder(fs::path path, ExistingRun existing, const Experiment& experiment)
    : path_(std::move(path)) {
  const bool goes_on = existing == ExistingRun::resume;
  try {
    if (!goes_on) make_folder(path_);
    lock_.descriptor = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_.descriptor >= 0 && flock(lock_.descriptor, LOCK_EX | LOCK_NB) != 0 &&
        errno == EWOULDBLOCK)
      refuse_folder(path_, kRunIsWritten);
    if (goes_on)
      run_ = unfinished_run(path_, experiment);
    else
      run_.id = new_id();
    if (goes_on)
      remove_files({path_ / "report.html"});  // of the run as it was
    else
      remove_files(replaceable(path_, existing == ExistingRun::replace));
    Json document = experiment.document;
    document["$run"] = run_.id;
    write_json(path_ / "experiment.json", document);
  } catch (const OutputError& error) {
    throw UnusableFolder(error.what());
  }
}

fs::path RunFolder::checkpoint_file() const { return path_ / "checkpoint.json"; }

RunFolder::Lock::~Lock() {
  if (descriptor >= 0) ::close(descriptor);
}

void RunFolder::write_summary(const RunSummary& summary) const {
  write_json(path_ / "summary.json", to_json(summary));
}

}  // namespace courant
