#include "courant/cli/waiting.hpp"

#include <condition_variable>
#include <mutex>
#include <ostream>
#include <utility>

namespace courant::cli {
namespace {

void show(const std::stop_token& stop, std::ostream& out, const std::string& what,
          std::chrono::milliseconds patience) {
  std::mutex mutex;
  std::condition_variable_any ended;
  std::unique_lock lock(mutex);
  const auto begin = std::chrono::steady_clock::now();
  const auto wait_until = [&](auto moment) {
    return !ended.wait_until(lock, stop, moment, [&] { return stop.stop_requested(); }) &&
           !stop.stop_requested();
  };
  bool shown = false;
  for (auto moment = begin + patience; wait_until(moment); moment += std::chrono::seconds(1)) {
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begin);
    out << "\r\x1b[K" << what << " … " << seconds.count() << " s" << std::flush;
    shown = true;
  }
  if (shown) out << "\r\x1b[K" << std::flush;
}

}  // namespace

Waiting::Waiting(const Console& console, std::string what, std::chrono::milliseconds patience) {
  if (!console.is_terminal) return;
  thread_ = std::jthread([&out = console.err, what = std::move(what), patience](
                             const std::stop_token& stop) { show(stop, out, what, patience); });
}

}  // namespace courant::cli
