#include "courant/cli/ensemble.hpp"

#include <chrono>
#include <optional>
#include <ostream>

#include "courant/cli/confinement.hpp"
#include "courant/cli/run_text.hpp"
#include "courant/cli/text.hpp"
#include "courant/cli/waiting.hpp"
#include "courant/running/ensemble_folder.hpp"
#include "courant/running/overdue.hpp"

namespace courant::cli {
namespace {

using Clock = std::chrono::steady_clock;

// How far it is, in one line that goes away.
std::function<void(Index, Index)> members_progress(const Console& console) {
  if (!console.is_terminal) return {};
  return [&out = console.err, last = Clock::time_point(), begin = Clock::now()](
             Index done, Index members) mutable {
    constexpr auto often = std::chrono::milliseconds(100);
    const auto now = Clock::now();
    if (done < members && now - last < often) return;
    last = now;
    out << "\r\x1b[K";
    if (done < members) {
      const double seconds = std::chrono::duration<double>(now - begin).count();
      out << done << " of " << members << " members, "
          << shown(seconds * static_cast<double>(members - done) / static_cast<double>(done), 2)
          << " s left";
    }
    out << std::flush;
  };
}

}  // namespace

int run_members(const Console& console, const EnsembleTask& task, const Experiment& experiment) {
  EnsembleFolder folder(task.folder, task.existing);
  EnsembleOptions options{.backend = task.backend,
                          .threads = task.jobs > 0 ? task.jobs : core_count(),
                          .stop = console.stop};
  std::optional<Waiting> waiting;
  if (!task.quiet) waiting.emplace(console, "constraint algorithm");
  options.on_ladder = [&](const LadderReport& ladder) {
    waiting.reset();
    if (console.heeds_stop) *console.heeds_stop = true;
    if (!task.quiet) print_opening(console, experiment, ladder);
  };
  if (!task.quiet) options.on_progress = members_progress(console);
  std::optional<Overdue> overdue;
  if (console.heeds_stop)
    overdue.emplace(console.stop, [&] {
      end_overdue(console, [&] {
        const bool is_out_of_time = Confinement::is_out_of_time();
        print_error(console, task.file + ": " +
                                 (is_out_of_time ? Confinement::time_in_words() : "interrupted"));
        return is_out_of_time ? failed : interrupted;
      });
    });
  const EnsembleOutcome outcome = run_ensemble(experiment, folder, options);
  overdue.reset();
  waiting.reset();
  if (console.heeds_stop) *console.heeds_stop = false;
  if (!task.quiet) print_ensemble(console, outcome, task.folder);
  if (Confinement::is_out_of_time()) {
    print_error(console, task.file + ": " + Confinement::time_in_words());
    return failed;
  }
  for (const std::string& problem : outcome.problems)
    print_error(console, task.file + ": /ensemble: " + problem);
  if (outcome.status != RunStatus::completed)
    print_error(console, task.file + ": " + outcome.message);
  if (outcome.status == RunStatus::interrupted) return interrupted;
  for (const ExpectationResult& result : outcome.expectations)
    if (!result.passed)
      print_error(console, task.file + ": " + result.pointer + ": " + result.description + ": " +
                               result.finding);
  return outcome.status == RunStatus::completed && outcome.as_expected() ? done : failed;
}

}  // namespace courant::cli
