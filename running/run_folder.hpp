// The folder of a run and the files in it.
#pragma once

#include <filesystem>

#include "courant/reading/findings.hpp"
#include "courant/running/output_file.hpp"

namespace courant {

// A folder that no run can be written to, found before anything was written: one line.
class UnusableFolder : public OutputError {
 public:
  using OutputError::OutputError;
};

// A folder that is ready for a run: made if it was not there, with the experiment in it; the files
// of an earlier run are gone if they may be replaced. The constructor throws UnusableFolder, before
// anything is changed, if there is a run that may not be replaced, or the folder cannot be written.
class RunFolder {
 public:
  RunFolder(std::filesystem::path path, bool replace, const Json& experiment);

  const std::filesystem::path& path() const { return path_; }
  // Throws OutputError.
  void write_summary(const Json& summary) const;

 private:
  std::filesystem::path path_;
};

}  // namespace courant
