// The folder of a run and the files in it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "courant/reading/experiment.hpp"
#include "courant/running/locked_folder.hpp"
#include "courant/running/run_summary.hpp"
#include "courant/running/unfinished_run.hpp"

namespace courant {

// What becomes of a run that is in the folder already.
enum class ExistingRun {
  refuse,
  replace,
  resume,  // it goes on, and there must be one
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
  // these names that no run wrote, or the folder cannot be written; and as unfinished_run does for a
  // run that is to go on.
  RunFolder(std::filesystem::path path, ExistingRun existing, const Experiment& experiment);

  // Throws if the constructor would; changes nothing. To be asked before anything is computed.
  static void check(const std::filesystem::path& path, ExistingRun existing,
                    const Experiment& experiment);

  // Removes the files of the run in a folder, and the folder if it is empty then. Nothing where there
  // is none.
  static void remove(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return folder_.path(); }
  const std::string& id() const { return run_.id; }
  // Where a run goes on; nothing if it begins.
  const std::optional<Checkpoint>& checkpoint() const { return run_.checkpoint; }
  std::filesystem::path checkpoint_file() const;
  // Removes the rows of a run that begins anew. Throws UnusableFolder where they cannot be removed.
  void remove_rows() const;
  // Throw OutputError, also where another folder has its name by now. The first summary reserves room on the disk
  // for one that says why the run ended, which is written even when all else is full.
  void write_checkpoint(const Checkpoint& checkpoint) const;
  void write_summary(const RunSummary& summary);
  void write_summary(const Json& summary);  // of an ensemble, which has what a run has, and more

 private:
  LockedFolder folder_;
  UnfinishedRun run_;
  std::optional<ReservedSpace> last_word_;
};

}  // namespace courant
