// The options --sweep and --jobs of several subcommands.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "courant/cli/command.hpp"
#include "courant/running/sweep.hpp"

namespace CLI {
class App;
}

namespace courant::cli {

// The options of a sweep as they were typed.
struct SweepArguments {
  std::vector<std::string> ranges;  // as given to --sweep; empty: no sweep
  unsigned jobs = 0;                // threads; 0: as many as there are cores
  std::string shard;                // as given to --shard; empty: all of it
  bool resume = false;
};

// Of a command whose --resume has other uses, that is its own; --jobs is for ensembles too then.
void add_sweep(CLI::App& command, SweepArguments& arguments, bool has_resume = false);

// What a sweep does with each of its cases.
struct SweepTask {
  std::string file;                   // of the experiment, for messages
  std::vector<std::string> settings;  // of --set
  SweepArguments sweep;
  std::filesystem::path folder;  // of its files; empty: none are written
  bool replace = false;          // an earlier sweep in the folder
  bool json = false;             // prints the table as JSON
  bool quiet = false;
  // `folder` is that of the sweep.
  std::function<Json(const SweepCase&, const std::filesystem::path& folder)> action;
  // The columns of the table on the screen, beside what is swept and the status: names among the
  // values, and their heads. Those that no case has are left out.
  std::vector<std::pair<std::string, std::string>> columns;
};

// Does it on all cores, shows the table, writes table and figure. The exit status is 0 if every case
// was completed and came out as expected, 3 if one did not, 130 if it was interrupted, 2 if nothing
// can be begun: no case can be read, the folder cannot be used.
int run_sweep(const Console& console, const SweepTask& task);

// runs/<name of FILE>-<suffix>.
std::filesystem::path default_folder(const std::string& file, const std::string& suffix = "");

}  // namespace courant::cli
