#include "courant/cli/command_main.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "courant/cli/command.hpp"

namespace {

std::atomic<bool> interrupt_requested{false}, interrupt_heeded{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set by a signal handler");

// The first interrupt ends a run in order; a second one, or the first where there is nothing to be
// kept, ends the program.
void on_interrupt(int signal) {
  if (!interrupt_heeded) {
    constexpr char message[] = "\ncourant: interrupted\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof message - 1);
    _exit(courant::cli::interrupted);
  }
  interrupt_requested = true;
  std::signal(signal, SIG_DFL);
}

bool set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

// Whether the locale of the terminal can show more than ASCII.
bool is_utf8() {
  for (const char* variable : {"LC_ALL", "LC_CTYPE", "LANG"})
    if (set(variable)) {
      const std::string locale = std::getenv(variable);
      return locale.find("UTF-8") != std::string::npos || locale.find("utf8") != std::string::npos;
    }
  return false;
}

}  // namespace

int courant::command_main(int argc, char** argv) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, on_interrupt);
  const bool out_is_terminal = isatty(STDOUT_FILENO) == 1;
  const courant::cli::Console console{
      .in = std::cin,
      .out = std::cout,
      .err = std::cerr,
      .is_terminal = isatty(STDERR_FILENO) == 1,
      .colour = out_is_terminal && !set("NO_COLOR"),
      .unicode = is_utf8() || !out_is_terminal,
      .stop = &interrupt_requested,
      .heeds_stop = &interrupt_heeded,
  };
  return courant::cli::command(std::vector<std::string>(argv + 1, argv + argc), console);
}
