#include "courant/cli/command_main.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
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

// A check of an index or a size has failed, which no experiment may reach: one line, and a status, in the
// place of a dumped core.
void on_failed_check(int) {
  constexpr char message[] =
      "courant: a check inside the program failed: this is a mistake of courant, not of what it "
      "was "
      "given\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof message - 1);
  _exit(courant::cli::failed);
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

// Of the terminal, or what COLUMNS says; wider text is hard to read.
std::size_t columns_of_text() {
  constexpr std::size_t least = 40, otherwise = courant::cli::Console::kUsualColumns, most = 120;
  std::size_t columns = otherwise;
  winsize size{};
  if (set("COLUMNS")) {
    const std::string_view text = std::getenv("COLUMNS");
    std::from_chars(text.data(), text.data() + text.size(), columns);
  } else if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    columns = size.ws_col;
  }
  return std::clamp(columns, least, most);
}

}  // namespace

int courant::command_main(int argc, char** argv) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, on_interrupt);
  std::signal(SIGABRT, on_failed_check);
  std::signal(SIGXFSZ, SIG_IGN);  // writing fails instead
  const bool out_is_terminal = isatty(STDOUT_FILENO) == 1;
  const courant::cli::Console console{
      .in = std::cin,
      .out = std::cout,
      .err = std::cerr,
      .is_terminal = isatty(STDERR_FILENO) == 1,
      .colour = out_is_terminal && !set("NO_COLOR"),
      .unicode = is_utf8() || !out_is_terminal,
      .columns = columns_of_text(),
      .stop = &interrupt_requested,
      .heeds_stop = &interrupt_heeded,
  };
  return courant::cli::command(std::vector<std::string>(argv + 1, argv + argc), console);
}
