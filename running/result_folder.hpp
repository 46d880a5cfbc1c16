// The folder of a sweep or a study.
#pragma once

#include <filesystem>
#include <string>

#include "courant/reading/findings.hpp"

namespace courant {

// A folder with <kind>.json, <kind>.csv and <kind>.svg, which belong together and to one sweep or
// study, and with folders of the runs that the first of them lists. Made if it was not there, and
// locked while the object lives. What an earlier one wrote, its runs too, is gone if it may be
// replaced; nothing else is ever removed.
class ResultFolder {
 public:
  // `kind` is "sweep" or "study". Throws UnusableFolder, before anything is changed, if there is one
  // that may not be replaced, another is being written, there are files of these names that nothing
  // like that wrote, or the folder cannot be written.
  ResultFolder(std::filesystem::path path, std::string kind, bool replace);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  // Throws UnusableFolder if the constructor would; changes nothing. To be asked before anything is
  // computed.
  static void check(const std::filesystem::path& path, const std::string& kind, bool replace);

  const std::filesystem::path& path() const { return path_; }
  // <kind>.<extension> in the folder.
  std::filesystem::path file(const std::string& extension) const;

  // Both files. `result` is an object; "kind" becomes its first key. The folders of runs are those
  // of its entries "runs", each with a "folder". Throws OutputError.
  void write(const Json& result, const std::string& csv) const;

 private:
  std::filesystem::path path_;
  std::string kind_;
  int lock_ = -1;
};

}  // namespace courant
