// The folder of a sweep or a study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "courant/reading/findings.hpp"
#include "courant/running/locked_folder.hpp"

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
  // `resume`: one that is there goes on, and all that it wrote stays.
  ResultFolder(const std::filesystem::path& path, std::string kind, bool replace,
               bool resume = false);

  // Throws UnusableFolder if the constructor would; changes nothing. To be asked before anything is
  // computed.
  static void check(const std::filesystem::path& path, const std::string& kind, bool replace,
                    bool resume = false);

  // <kind>.json of what is in the folder; null if there is none.
  static Json result_in(const std::filesystem::path& path, const std::string& kind);

  // The folders of the runs of a <kind>.json: names, without a way out of its folder. What else it has there
  // is passed over.
  static std::vector<std::filesystem::path> runs_of(const Json& result);

  const std::filesystem::path& path() const { return folder_.path(); }
  // <kind>.<extension> in the folder.
  std::filesystem::path file(const std::string& extension) const;

  // Both files, and the figure if there is one. `result` is an object; "kind" becomes its first key. The folders of
  // runs are those of its entries "runs", each with a "folder". Throws OutputError.
  void write(const Json& result, const std::string& csv, const std::string& svg = "") const;

 private:
  LockedFolder folder_;
  std::string kind_;
};

}  // namespace courant
