#include "courant/cli/confinement.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "courant/cli/command.hpp"

namespace courant::cli {
namespace {

const std::atomic<bool>* stop_is_heeded = nullptr;
std::atomic<bool> is_over{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set by a signal handler");

void end_of_time(int) {
  is_over = true;
  if (stop_is_heeded != nullptr && *stop_is_heeded) {
    std::raise(SIGINT);
    return;
  }
  constexpr char message[] = "courant: the experiment takes more than 60 s of the processor\n";
  static_assert(Confinement::kSeconds == 60, "the message says so");
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof message - 1);
  _exit(failed);
}

// Lowers a limit; `later`: how much more the kernel waits before it kills.
void lower(decltype(RLIMIT_CPU) what, rlim_t most, rlim_t later = 0) {
  rlimit limit = {};
  if (getrlimit(what, &limit) != 0) return;
  limit.rlim_max = std::min(limit.rlim_max, most + later);
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  if (later > 0 && limit.rlim_cur == limit.rlim_max && limit.rlim_max > 1) --limit.rlim_cur;
  setrlimit(what, &limit);
}

}  // namespace

void Confinement::begin(const std::atomic<bool>* heeds_stop) {
  stop_is_heeded = heeds_stop;
  std::signal(SIGXCPU, end_of_time);
  constexpr rlim_t megabyte = rlim_t{1} << 20;
  lower(RLIMIT_CORE, 0);
  lower(RLIMIT_FSIZE, kFileMegabytes * megabyte);
  lower(RLIMIT_CPU, kSeconds, 10);
#if !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)  // which reserve more addresses than there are
  lower(RLIMIT_AS, kMegabytes * megabyte);
#endif
}

bool Confinement::is_out_of_time() { return is_over; }

std::string Confinement::time_in_words() {
  return "takes more than " + std::to_string(kSeconds) + " s of the processor";
}

}  // namespace courant::cli
