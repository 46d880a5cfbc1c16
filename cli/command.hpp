// What the subcommands of `courant` share.
#pragma once

#include <atomic>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace courant::cli {

// The exit status of the command.
enum Status { done = 0, wrong = 2, failed = 3, interrupted = 130 };

// Where the command reads and writes.
struct Console {
  std::istream& in;
  std::ostream& out;
  std::ostream& err;
  bool is_terminal = false;  // of err: progress is shown
  bool colour = false;       // of out
  bool unicode = true;       // of out
  static constexpr std::size_t kUsualColumns = 98;
  std::size_t columns = kUsualColumns;      // of out: text is wrapped there
  const std::atomic<bool>* stop = nullptr;  // set by an interrupt
  // Set by the command while it looks at `stop`; at other times an interrupt ends the program.
  std::atomic<bool>* heeds_stop = nullptr;
};

// One line on console.err, `courant: …`, whatever stands in `what`.
void print_error(const Console& console, const std::string& what);

// Ends the program, from any thread, after an interrupt that its work did not obey in time (Overdue).
// `tell` says what is known, and gives the exit status.
[[noreturn]] void end_overdue(const Console& console, const std::function<Status()>& tell);

// A subcommand adds itself to the application, and `action` when it was chosen: what to do, and the
// exit status of that.
struct Session {
  Console console;
  std::function<int(const Console&)> action = {};
};

void add_run(CLI::App& app, Session& session);
void add_constraints(CLI::App& app, Session& session);
void add_check(CLI::App& app, Session& session);
void add_study(CLI::App& app, Session& session);
void add_list(CLI::App& app, Session& session);
void add_schema(CLI::App& app, Session& session);
void add_sweep_command(CLI::App& app, Session& session);
void add_import(CLI::App& app, Session& session);
void add_export(CLI::App& app, Session& session);
void add_report(CLI::App& app, Session& session);
void add_plot(CLI::App& app, Session& session);
void add_new(CLI::App& app, Session& session);
void add_cache(CLI::App& app, Session& session);
void add_tour(CLI::App& app, Session& session);
void add_man(CLI::App& app, Session& session);
void add_completion(CLI::App& app, Session& session);

// The command: `arguments` without the name of the program. Errors go to console.err, one line
// each, `courant: …`.
int command(const std::vector<std::string>& arguments, const Console& console);

}  // namespace courant::cli
