#include "answer.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <thread>

#include "courant/cli/command.hpp"
#include "words.hpp"

namespace courant::fuzz {

namespace {

// Sets a flag after some time, unless it is destroyed before.
class Alarm {
 public:
  explicit Alarm(std::chrono::milliseconds patience)
      : thread_([this, patience](const std::stop_token& destroyed) {
          const auto moment = std::chrono::steady_clock::now() + patience;
          while (!destroyed.stop_requested() && std::chrono::steady_clock::now() < moment)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
          rings_ = true;
        }) {}
  const std::atomic<bool>& rings() const { return rings_; }

 private:
  std::atomic<bool> rings_{false};
  std::jthread thread_;
};

}  // namespace

void require_answer(const std::vector<std::string>& arguments, const std::string& input) {
  std::istringstream in(input);
  std::ostringstream out, err;
  int status = 0;
  {
    const Alarm alarm(std::chrono::milliseconds(200));
    status = cli::command(arguments, {.in = in, .out = out, .err = err, .stop = &alarm.rings()});
  }
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
}

std::string empty_folder() {
  const auto folder =
      std::filesystem::temp_directory_path() / ("courant_fuzz_" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

}  // namespace courant::fuzz
