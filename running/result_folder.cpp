#include "courant/running/result_folder.hpp"

#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "courant/core/files/input_file.hpp"
#include "courant/running/run_folder.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

std::string article(const std::string& kind) { return "a " + kind; }

std::vector<fs::path> files_of(const fs::path& path, const std::string& kind) {
  std::vector<fs::path> found;
  for (const char* extension : {"json", "csv", "svg"}) {
    std::error_code error;
    const fs::path file = path / (kind + "." + extension);
    if (fs::exists(fs::symlink_status(file, error))) found.push_back(file);
  }
  return found;
}

// Everything that it wrote.
void remove_all_of(const fs::path& path, const std::string& kind) {
  const auto remove = [](const fs::path& file) {
    std::error_code error;
    fs::remove(file, error);
    if (error) refuse_folder(file, "cannot be replaced: " + error.message());
  };
  for (const fs::path& name : ResultFolder::runs_of(ResultFolder::result_in(path, kind))) {
    const fs::path folder = path / name;
    if (fs::is_symlink(folder)) {  // what it leads to was put elsewhere, to be kept
      remove(folder);
      continue;
    }
    RunFolder::remove(folder);
    if (!ResultFolder::result_in(folder, "study").is_null())
      for (const fs::path& file : files_of(folder, "study")) remove(file);
    std::error_code not_empty;
    fs::remove(folder, not_empty);
  }
  for (const fs::path& file : files_of(path, kind)) remove(file);
}

constexpr const char* kResultIsWritten =
    "something is being written to this folder; expected another folder (-o)";

}  // namespace

Json ResultFolder::result_in(const fs::path& path, const std::string& kind) {
  std::ifstream stream = input_file(path / (kind + ".json"));
  const Json result = Json::parse(stream, nullptr, false);
  return result.is_object() && result.value("kind", Json()) == kind ? result : Json();
}

std::vector<fs::path> ResultFolder::runs_of(const Json& result) {
  std::vector<fs::path> folders;
  if (!result.is_object()) return folders;
  const Json runs = result.value("runs", Json::array());
  if (!runs.is_array()) return folders;
  for (const Json& run : runs) {
    const Json name = run.is_object() ? run.value("folder", Json()) : Json();
    if (!name.is_string()) continue;
    const fs::path folder(name.get<std::string>());
    if (folder.has_filename() && !folder.has_parent_path() && folder != "." && folder != "..")
      folders.push_back(folder);
  }
  return folders;
}

void ResultFolder::check(const fs::path& path, const std::string& kind, bool replace, bool resume) {
  LockedFolder::check_place(path);
  if (LockedFolder::is_in_use(path)) refuse_folder(path, kResultIsWritten);
  const std::vector<fs::path> files = files_of(path, kind);
  if (files.empty()) return;
  if (result_in(path, kind).is_null())
    refuse_folder(files.front(),
                  "is there already, and no " + kind + " wrote it; expected another folder (-o)");
  if (!replace && !resume)
    refuse_folder(path,
                  "there is " + article(kind) +
                      " in this folder; expected another folder (-o), or --force to replace it");
}

namespace {

const fs::path& checked(const fs::path& path, const std::string& kind, bool replace, bool resume) {
  ResultFolder::check(path, kind, replace, resume);
  return path;
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& path, std::string kind, bool replace, bool resume)
    : folder_(checked(path, kind, replace, resume), kResultIsWritten), kind_(std::move(kind)) {
  if (!resume) remove_all_of(path, kind_);
}

fs::path ResultFolder::file(const std::string& extension) const {
  return path() / (kind_ + "." + extension);
}

void ResultFolder::write(const Json& result, const std::string& csv, const std::string& svg) const {
  folder_.require_still_there();
  Json whole = {{"kind", kind_}};
  whole.update(result);
  write_file(file("json"), whole.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  write_file(file("csv"), csv);
  if (!svg.empty()) write_file(file("svg"), svg);
}

}  // namespace courant
