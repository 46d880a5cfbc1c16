// The folder of a run and the files in it.
#pragma once

#include <filesystem>
#include <string>

#include "courant/reading/findings.hpp"
#include "courant/running/output_file.hpp"

namespace courant {

// A folder that no run can be written to, found before anything was written: one line.
class UnusableFolder : public OutputError {
 public:
  using OutputError::OutputError;
};

// A folder that belongs to one run: made if it was not there, and locked while the object lives, so
// that no other run writes to it. The files of an earlier run are gone if they may be replaced; what
// no run wrote is never removed.
//
// The run has an id, random hexadecimal digits, which is in summary.json ("id") and in
// experiment.json ("$run"): files of two runs do not pass for those of one.
class RunFolder {
 public:
  // Makes the folder and writes experiment.json. Throws UnusableFolder, before anything is changed,
  // if there is a run that may not be replaced, another run is being written, there are files of
  // these names that no run wrote, or the folder cannot be written.
  RunFolder(std::filesystem::path path, bool replace, Json experiment);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  // Throws UnusableFolder if the constructor would; changes nothing. To be asked before anything is
  // computed.
  static void check(const std::filesystem::path& path, bool replace);

  // Whether a run is being written to the folder.
  static bool is_in_use(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const std::string& id() const { return id_; }
  // Throws OutputError.
  void write_summary(const Json& summary) const;

 private:
  std::filesystem::path path_;
  std::string id_;
  int lock_ = -1;
};

}  // namespace courant
