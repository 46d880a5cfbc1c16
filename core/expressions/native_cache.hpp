// The folder in which compiled code is kept.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace courant {

// Shared objects by the content that they were compiled from, in $COURANT_CACHE, else
// $XDG_CACHE_HOME/courant, else ~/.cache/courant.
//
// An entry is three files with the hash of its content as name: the content (.c), the object (.so),
// and the object's length and a hash of name and object (.sum), which appears last. An object that is not what its .sum
// says was cut off by a full disk or a crash: loading it would end the program. One that is there under the name of
// another entry would compute something else. Files appear by an atomic rename, so that threads and programs may share
// the folder.
//
// The folder is marked as ours by a CACHEDIR.TAG, which backups heed too. A folder that cannot be
// written to, belongs to somebody else, may be written to by others, or has files of somebody else
// and no mark, is not used. In a marked one only names of our own form are read or removed.
class NativeCache {
 public:
  struct Entry {
    std::string name;
    std::uintmax_t bytes = 0;
    // Within a day.
    std::filesystem::file_time_type used = std::filesystem::file_time_type::min();
  };
  struct Limits {
    std::uintmax_t bytes = std::uintmax_t{512} << 20;
    std::chrono::hours age = std::chrono::hours(24 * 90);  // since an entry was last used
  };

  // The cache of this user, its folder made and marked if need be; nothing if there is none that may
  // be used, and `defect` says why.
  static std::optional<NativeCache> open(std::string* defect = nullptr);

  const std::filesystem::path& folder() const { return folder_; }

  // The object of a content, if there is a whole one.
  std::optional<std::filesystem::path> find(const std::string& content) const;

  // Moves a source, which is the content, and its object here; returns where the object is then: here,
  // or where it was if that cannot be. Prunes.
  std::filesystem::path add(const std::string& content, const std::filesystem::path& source,
                            const std::filesystem::path& object) const;

  // The entry that was used last comes first.
  std::vector<Entry> entries() const;

  // Removes what has not been used for long, and what was used least recently, down to the limits;
  // also what compilations that were killed have left behind.
  void prune(const Limits& limits) const;
  void clear() const { prune({.bytes = 0, .age = std::chrono::hours(0)}); }

 private:
  explicit NativeCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path file(const std::string& name, const char* extension) const {
    return folder_ / (name + extension);
  }

  std::filesystem::path folder_;
};

}  // namespace courant
