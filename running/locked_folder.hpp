// LockedFolder: a folder that one run, sweep or study writes to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "courant/core/files/output_file.hpp"

namespace courant {

// A folder that something cannot be written to, found before anything was written: one line.
class UnusableFolder : public RefusedOutput {
 public:
  using RefusedOutput::RefusedOutput;
};

// Throws UnusableFolder with the path in front.
[[noreturn]] void refuse_folder(const std::filesystem::path& path, const std::string& what);

// A folder that is made if it was not there, and locked while the object lives. What a kill left
// half-written in it is gone. One that was made and is empty at the end goes, with those above it that were made.
class LockedFolder {
 public:
  // Throws UnusableFolder, with the words `in_use` if it is locked.
  LockedFolder(std::filesystem::path path, const std::string& in_use);
  ~LockedFolder();
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Throws OutputError if another folder, or none, has its name by now. To be asked before a file is
  // written by name.
  void require_still_there() const;

  // Whether something is being written to the folder.
  static bool is_in_use(const std::filesystem::path& path);
  // Throws UnusableFolder if no folder can be made or written there; changes nothing.
  static void check_place(const std::filesystem::path& path);

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // the innermost is the first
  int descriptor_ = -1;
};

}  // namespace courant
