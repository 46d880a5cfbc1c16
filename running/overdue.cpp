#include "courant/running/overdue.hpp"

#include <chrono>
#include <ctime>
#include <utility>

namespace courant {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPatience = 2s, kComputed = 1s, kOften = 20ms;

// Of the processor, on all threads.
std::chrono::duration<double> computed() {
  return std::chrono::duration<double>(static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
}

}  // namespace

Overdue::Overdue(const std::atomic<bool>* stop, std::function<void()> end) {
  if (!stop || !end) return;
  thread_ = std::jthread([stop, end = std::move(end)](const std::stop_token& over) {
    const auto wait_while = [&](auto&& condition) {
      while (!over.stop_requested() && condition()) std::this_thread::sleep_for(kOften);
    };
    wait_while([&] { return !*stop; });
    const auto asked = Clock::now();
    const auto before = computed();
    wait_while([&] { return Clock::now() - asked < kPatience || computed() - before < kComputed; });
    if (!over.stop_requested()) end();
  });
}

}  // namespace courant
