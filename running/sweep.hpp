// Sweeps: an experiment for every value of one or more of its places.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/reading/setting.hpp"
#include "courant/running/result_folder.hpp"

namespace courant {

// One experiment of a sweep.
struct SweepCase {
  std::vector<Setting> settings;  // one for each swept place
  std::string name;               // of its folder, "03-theta=0.2": letters, digits and . = + - _ ,
  Json document;                  // with the settings
  std::size_t alike = 1;  // how many cases have the same code but for numbers, see RunOptions
};

// A case for each combination of values. Throws ExperimentError where a place cannot be changed.
std::vector<SweepCase> sweep_cases(const Json& document, std::span<const ValueRange> ranges);

// One of `of` parts of a sweep, which several machines can share: the cases number, number + of, ….
struct Shard {
  std::size_t number = 1, of = 1;
  // `2/4`. Throws ExperimentError.
  static Shard read(const std::string& text);
  std::string text() const { return std::to_string(number) + "/" + std::to_string(of); }
  std::vector<SweepCase> take(const std::vector<SweepCase>& all) const;
};

// What a sweep is of: two tables with the same are of one sweep.
Json sweep_head(const Json& document, std::span<const ValueRange> ranges, const Shard& shard = {});

// What the places of a table, or of its head, are called beside each other (short_names).
std::vector<std::string> swept_names(const Json& table);

// How a sweep is carried out, where its table goes, and who is told of it.
struct SweepOptions {
  unsigned threads = 1;
  const std::atomic<bool>* stop = nullptr;  // set by someone else: no further case begins
  // After each case, from one thread at a time, with the cases that have ended.
  std::function<void(std::size_t ended, std::size_t count)> on_progress = {};
  // Once it is asked to stop and cases do not end (Overdue): ends the program. The table is that of the cases that have
  // ended.
  std::function<void(const Json& table)> on_overdue = {};
  // The folder in which the table is, and is kept up to date; null for a sweep without files.
  const ResultFolder* folder = nullptr;
  // The table of an earlier sweep with the same head that goes on: what ended in it is not done again.
  Json earlier = {};
};

// Does the same with every case, on several threads, and makes the table of what comes out:
//
//   {"status": "completed", "sweep": [{"pointer": "/time/step", "values": [0.1, 0.2]}],
//    "experiment": {…}, "shard": "2/4" of a part,
//    "runs": [{"folder": "1-step=0.1", "settings": {"/time/step": 0.1}, "status": "completed",
//              "message": "", "values": {"H.max_drift": 1e-3, …}}, …]}
//
// `action` returns the entry's status, message and values, and "folder" if it wrote one; and "seconds", which is not
// in files: they depend on the sweep alone. What it
// throws is the message of the entry, with the status "wrong" for an ExperimentError and "failed"
// for anything else. Cases that do not begin have the status "interrupted"; so has the sweep then.
Json sweep(const Json& head, std::span<const SweepCase> cases,
           const std::function<Json(const SweepCase&)>& action, const SweepOptions& options);

// A table as files have it: without how long its cases took, which no two processes agree on.
Json without_seconds(Json table);

// The table of all parts of a sweep, as one process would have made it. Throws std::invalid_argument where they are not
// all parts of one sweep, or one of them is not finished.
Json merged_sweep(std::span<const Json> parts);

// The table as comma-separated values: folder, a column for each place, status, values, message.
std::string sweep_csv(const Json& table);

// Actions. A run of the case in a folder of its own in `folder`; its values are the number of
// steps and of expectations, what became of every observable, coordinate and constraint, and the
// work. Besides, "as_expected": whether it came out as expected. `resume`: a run that is in its folder goes
// on, and one that has ended is not made again.
Json run_of_case(const SweepCase& one, const std::filesystem::path& folder, Backend backend,
                 const std::atomic<bool>* stop, bool resume = false);
// The constraint algorithm at the initial point of the case; its values are verdict, index,
// degrees of freedom, and the gap of the weakest rank decision.
Json ladder_of_case(const SweepCase& one);

}  // namespace courant
