// A folder for files on the way.
#pragma once

#include <filesystem>
#include <string>

namespace courant {

// A new folder that this user alone may enter, gone with its object, whatever is in it. It is locked
// while it is in use, by which those that a kill left behind are known.
class WorkFolder {
 public:
  // In the folder for temporary files, or in `parent`. Throws OutputError.
  explicit WorkFolder(const std::filesystem::path& parent = temporary_folder());
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::filesystem::path path() const { return path_; }

  // Removes those in `parent` that a kill left behind.
  static void remove_left_behind(const std::filesystem::path& parent);
  static bool is_name(const std::string& name);

  static std::filesystem::path temporary_folder();

 private:
  std::string path_;
  int lock_ = -1;
};

}  // namespace courant
