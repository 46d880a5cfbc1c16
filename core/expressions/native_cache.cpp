#include "courant/core/expressions/native_cache.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <system_error>

#include "courant/core/expressions/host.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCompilation = "courant-compile-";

// 128 bits: FNV-1a from two starting points.
std::string hash_of(const std::string& content) {
  std::string digits;
  for (std::uint64_t hash : {0xCBF29CE484222325ULL, 0x84222325CBF29CE4ULL}) {
    for (const char c : content) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
    for (int shift = 60; shift >= 0; shift -= 4)
      digits += "0123456789abcdef"[(hash >> shift) & 0xF];
  }
  return digits;
}

std::string sum_of(const std::string& object) {
  return std::to_string(object.size()) + ' ' + hash_of(object) + '\n';
}

}  // namespace

std::optional<NativeCache> NativeCache::open() {
  fs::path folder = environment_variable("COURANT_CACHE");
  if (folder.empty()) {
    const fs::path base = environment_variable("XDG_CACHE_HOME");
    const fs::path home = environment_variable("HOME");
    if (base.is_absolute())
      folder = base / "courant";
    else if (home.is_absolute())
      folder = home / ".cache" / "courant";
    else
      return std::nullopt;
  }
  std::error_code error;
  folder = fs::absolute(folder, error);
  fs::create_directories(folder.parent_path(), error);
  mkdir(folder.c_str(), 0700);
  struct stat status {};
  const bool ours = stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
                    status.st_uid == geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  if (!ours || access(folder.c_str(), W_OK | X_OK) != 0) return std::nullopt;
  return NativeCache(folder);
}

std::optional<fs::path> NativeCache::find(const std::string& content) const {
  const std::string name = hash_of(content);
  const fs::path object = file(name, ".so"), sum = file(name, ".sum");
  std::error_code error;
  if (!fs::exists(sum, error) || content_of(file(name, ".c")) != content ||
      content_of(sum) != sum_of(content_of(object)))
    return std::nullopt;
  const auto now = fs::file_time_type::clock::now();
  if (now - fs::last_write_time(sum, error) > std::chrono::hours(24))
    fs::last_write_time(sum, now, error);
  return object;
}

fs::path NativeCache::add(const std::string& content, const fs::path& source,
                          const fs::path& object) const {
  const std::string name = hash_of(content);
  const fs::path sum = object.parent_path() / "sum";
  std::ofstream(sum, std::ios::binary) << sum_of(content_of(object));
  fs::rename(source, file(name, ".c"));
  fs::rename(object, file(name, ".so"));
  fs::rename(sum, file(name, ".sum"));
  prune({});
  return file(name, ".so");
}

std::vector<NativeCache::Entry> NativeCache::entries() const {
  std::map<std::string, Entry> found;
  std::error_code error;
  for (const auto& item : fs::directory_iterator(folder_, error)) {
    const std::string extension = item.path().extension().string();
    if (extension != ".c" && extension != ".so" && extension != ".sum") continue;
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
  remove_leftovers();
}

void NativeCache::remove_leftovers() const {
  std::error_code ignored;
  std::vector<fs::path> abandoned;
  for (const auto& item : fs::directory_iterator(folder_, ignored)) {
    if (!item.path().filename().string().starts_with(kCompilation)) continue;
    const int descriptor = ::open(item.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) continue;
    // A folder is locked in the moment after it is made.
    const auto age = fs::file_time_type::clock::now() - item.last_write_time(ignored);
    if (age > std::chrono::seconds(10) && flock(descriptor, LOCK_EX | LOCK_NB) == 0)
      abandoned.push_back(item.path());
    close(descriptor);
  }
  for (const fs::path& folder : abandoned) fs::remove_all(folder, ignored);
}

CompilationFolder::CompilationFolder(const fs::path& parent)
    : path_((parent / (std::string(kCompilation) + "XXXXXX")).string()), lock_(-1) {
  if (mkdtemp(path_.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(),
                            "CCompiler::compile: no folder can be made in " + parent.string());
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) flock(lock_, LOCK_EX | LOCK_NB);
}

CompilationFolder::~CompilationFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (lock_ >= 0) close(lock_);
}

}  // namespace courant
