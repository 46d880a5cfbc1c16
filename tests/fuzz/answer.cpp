#include "answer.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <map>
#include <sstream>

#include "courant/cli/command.hpp"
#include "words.hpp"

namespace courant::fuzz {

namespace {

std::atomic<bool> rings{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set by a signal handler");

// Rings after so much time of the processor, unless it is destroyed before. A thread that waits instead
// would cost more, with the sanitizers, than most of the commands.
class Alarm {
 public:
  explicit Alarm(std::chrono::microseconds patience) {
    rings = false;
    struct sigaction action = {};
    action.sa_handler = [](int) { rings = true; };
    action.sa_flags = SA_RESTART;
    sigaction(SIGVTALRM, &action, nullptr);
    set(patience);
  }
  ~Alarm() { set(std::chrono::microseconds(0)); }
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;

 private:
  static void set(std::chrono::microseconds patience) {
    const itimerval timer = {.it_interval = {}, .it_value = {0, patience.count()}};
    setitimer(ITIMER_VIRTUAL, &timer, nullptr);
  }
};

// Tells in the end how many commands ended how, so that it is seen how far they came.
class Statuses {
 public:
  ~Statuses() {
    std::cerr << "Exit statuses:";
    for (const auto& [status, count] : counts_) std::cerr << ' ' << status << " of " << count;
    std::cerr << '\n';
  }
  void count(int status) { ++counts_[status]; }

 private:
  std::map<int, long> counts_;
};

}  // namespace

Answer require_answer(const std::vector<std::string>& arguments, const std::string& input) {
  std::istringstream in(input);
  std::ostringstream out, err;
  int status = 0;
  {
    const Alarm alarm(std::chrono::milliseconds(50));
    status = cli::command(arguments, {.in = in, .out = out, .err = err, .stop = &rings});
  }
  static Statuses statuses;
  statuses.count(status);
  const std::string errors = err.str();
  require_words_for_users(errors, input);
  for (const char letter : errors)
    require((letter < 0 || letter >= 32 || letter == '\n') && letter != 127,
            "a control character is in a message", errors);
  require(status == cli::done || status == cli::wrong || status == cli::failed ||
              status == cli::interrupted,
          "a status that is not documented", std::to_string(status));
  require(status != cli::wrong || errors.starts_with("courant: "), "status 2 without a message",
          errors);
  return {.status = status, .out = out.str(), .err = errors};
}

const std::string& run_folder() {
  static const std::string folder = empty_folder() + "/run";
  return folder;
}

std::string empty_folder() {
  const auto folder =
      std::filesystem::temp_directory_path() / ("courant_fuzz_" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

}  // namespace courant::fuzz
