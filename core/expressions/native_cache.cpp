#include "courant/core/expressions/native_cache.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <system_error>

#include "courant/core/expressions/host.hpp"
#include "courant/core/files/content_hash.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/files/work_folder.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTag = "CACHEDIR.TAG";
// As https://bford.info/cachedir has it.
constexpr const char* kTagContent =
    "Signature: 8a477f597d28d172789f06886806bc55\n"
    "# Compiled code of courant, which makes it again: `courant cache --clear` removes it.\n";
constexpr std::size_t kNameDigits = 32;

// Of the object as that of this entry: a whole object of another one has another sum.
std::string sum_of(const std::string& name, const std::string& object) {
  return std::to_string(object.size()) + ' ' + content_hash(name + object) + '\n';
}

// Whether it is a file of an entry, by its name.
bool is_of_entry(const fs::path& file) {
  const std::string name = file.stem().string(), extension = file.extension().string();
  return name.size() == kNameDigits &&
         name.find_first_not_of("0123456789abcdef") == std::string::npos &&
         (extension == ".c" || extension == ".so" || extension == ".sum");
}

// Something in a folder; nothing if it is empty. What has names like those of entries may be
// somebody's as well.
std::optional<fs::path> file_in(const fs::path& folder) {
  std::error_code error;
  for (const auto& item : fs::directory_iterator(folder, error)) return item.path();
  return std::nullopt;
}

// The folder that the environment names; empty if none.
fs::path wanted_folder() {
  const fs::path cache = environment_variable("COURANT_CACHE");
  const fs::path base = environment_variable("XDG_CACHE_HOME");
  const fs::path home = environment_variable("HOME");
  std::error_code error;
  if (!cache.empty()) return fs::absolute(cache, error);
  if (base.is_absolute()) return base / "courant";
  return home.is_absolute() ? home / ".cache" / "courant" : fs::path();
}

// Why a folder may not be used; empty if it may. Made and marked if need be.
std::string defect_of(const fs::path& folder) {
  constexpr const char* expected =
      "expected a folder that this user alone may write to in COURANT_CACHE, XDG_CACHE_HOME or "
      "HOME";
  if (folder.empty())
    return std::string("there is no folder to keep compiled code in; ") + expected;
  std::error_code error;
  fs::create_directories(folder.parent_path(), error);
  mkdir(folder.c_str(), 0700);
  struct stat status {};
  const bool ours = stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
                    status.st_uid == geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  if (!ours || access(folder.c_str(), W_OK | X_OK) != 0)
    return folder.string() + ": compiled code is not kept there; " + expected;
  if (content_of(folder / kTag) == kTagContent) return "";
  if (const auto foreign = file_in(folder))
    return folder.string() +
           ": compiled code is not kept there, beside files that are not of it: " +
           foreign->filename().string() + "; expected a folder that is empty or not there";
  try {
    write_file(folder / kTag, kTagContent);
  } catch (const OutputError& failure) {
    return failure.what();
  }
  return "";
}

}  // namespace

std::optional<NativeCache> NativeCache::open(std::string* defect) {
  const fs::path folder = wanted_folder();
  const std::string found = defect_of(folder);
  if (defect != nullptr) *defect = found;
  if (!found.empty()) return std::nullopt;
  return NativeCache(folder);
}

std::optional<fs::path> NativeCache::find(const std::string& content) const {
  const std::string name = content_hash(content);
  const fs::path object = file(name, ".so"), sum = file(name, ".sum");
  std::error_code error;
  if (!fs::exists(sum, error) || content_of(file(name, ".c")) != content ||
      content_of(sum) != sum_of(name, content_of(object)))
    return std::nullopt;
  const auto now = fs::file_time_type::clock::now();
  if (now - fs::last_write_time(sum, error) > std::chrono::hours(24))
    fs::last_write_time(sum, now, error);
  return object;
}

fs::path NativeCache::add(const std::string& content, const fs::path& source,
                          const fs::path& object) const {
  const std::string name = content_hash(content);
  const fs::path sum = object.parent_path() / "sum";
  try {
    write_file(sum, sum_of(name, content_of(object)));
    fs::rename(source, file(name, ".c"));
    fs::rename(object, file(name, ".so"));
    fs::rename(sum, file(name, ".sum"));
  } catch (const std::runtime_error&) {  // a full disk, a folder of that name: it is not kept
    return fs::exists(object) ? object : file(name, ".so");
  }
  prune({});
  return file(name, ".so");
}

std::vector<NativeCache::Entry> NativeCache::entries() const {
  std::map<std::string, Entry> found;
  std::error_code error;
  for (const auto& item : fs::directory_iterator(folder_, error)) {
    std::error_code unreadable;
    if (!is_of_entry(item.path()) || !item.is_regular_file(unreadable)) continue;
    Entry& entry = found[item.path().stem().string()];
    entry.name = item.path().stem().string();
    std::error_code gone;  // removed by another program
    const auto size = item.file_size(gone);
    const auto written = item.last_write_time(gone);
    if (gone) continue;
    entry.bytes += size;
    entry.used = std::max(entry.used, written);
  }
  std::vector<Entry> list;
  for (auto& [name, entry] : found) list.push_back(std::move(entry));
  std::sort(list.begin(), list.end(),
            [](const Entry& a, const Entry& b) { return a.used > b.used; });
  return list;
}

void NativeCache::prune(const Limits& limits) const {
  const auto now = fs::file_time_type::clock::now();
  std::uintmax_t kept = 0;
  std::error_code ignored;
  for (const Entry& entry : entries()) {
    const bool is_young = limits.age.count() > 0 && now - entry.used < limits.age;
    if (is_young && kept + entry.bytes <= limits.bytes) {
      kept += entry.bytes;
      continue;
    }
    for (const char* extension : {".sum", ".so", ".c"})
      fs::remove(file(entry.name, extension), ignored);
  }
  WorkFolder::remove_left_behind(folder_);
}

}  // namespace courant
