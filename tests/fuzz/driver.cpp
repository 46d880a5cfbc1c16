// The entry points of libFuzzer without it: the files of the corpus as they are, in an order by chance,
// and after each of them a mutation of any, then mutations alone.
//
//   fuzz_… [-runs=N] [-max_total_time=SECONDS] [-timeout=SECONDS] [-seed=N] [-max_len=N] FOLDER…
//
// A finding is an execution that crashes, or that takes more than -timeout seconds of the processor
// (20) or four times as many of a clock. Its input is left in crash-input, and the status is 1.
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data,
                                                                     std::size_t size,
                                                                     std::size_t most,
                                                                     unsigned seed);
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace {

std::mt19937& generator() {
  static std::mt19937 only;
  return only;
}

std::size_t below(std::size_t bound) {
  return std::uniform_int_distribution<std::size_t>(0, bound - 1)(generator());
}

std::string input;                        // of the execution that goes on
std::atomic<std::size_t> executions = 0;  // that have begun

void write_input() { std::ofstream("crash-input", std::ios::binary) << input; }

// For handlers of signals, in which a program that ends anyway may do this much.
[[noreturn]] void leave_input(const std::string& reason) {
  write_input();
  std::cerr << "Finding: " << reason << " Its input, that of execution " << executions
            << " of this seed, is in crash-input." << std::endl;
  _exit(1);
}

void leave_crash(int signal) {
  leave_input("an execution ended by signal " + std::to_string(signal) + ".");
}

// Crashes are for the sanitizer to report, where there is one; std::abort is not.
void catch_crashes() {
  std::signal(SIGABRT, leave_crash);
  if (__sanitizer_set_death_callback != nullptr)
    __sanitizer_set_death_callback(write_input);
  else
    for (const int signal : {SIGSEGV, SIGFPE, SIGILL}) std::signal(signal, leave_crash);
}

// Looks once a second how long the execution that goes on has taken. It is the only timer of the
// driver, begins after its handler is there and is never set again, so that no signal of it can
// come when none is expected. The command that is fuzzed may have other ones, but for SIGALRM.
class Watch {
 public:
  static void begin(double most_seconds) {
    most_ = most_seconds;
    next();
    std::signal(SIGALRM, look);
    const itimerval timer = {.it_interval = {1, 0}, .it_value = {1, 0}};
    setitimer(ITIMER_REAL, &timer, nullptr);
  }
  static void next() {
    processor_ = seconds(CLOCK_PROCESS_CPUTIME_ID);
    clock_ = seconds(CLOCK_MONOTONIC);
  }

 private:
  static double seconds(clockid_t of) {
    timespec now = {};
    clock_gettime(of, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  static void look(int) {
    if (seconds(CLOCK_PROCESS_CPUTIME_ID) - processor_ > most_)
      leave_input("an execution took more than " + std::to_string(static_cast<int>(most_)) +
                  " s of the processor.");
    if (seconds(CLOCK_MONOTONIC) - clock_ > 4.0 * most_)
      leave_input("an execution took more than " + std::to_string(static_cast<int>(4.0 * most_)) +
                  " s.");
  }

  // When the execution that goes on began.
  static inline std::atomic<double> processor_ = 0.0, clock_ = 0.0;
  static inline std::atomic<double> most_ = 0.0;
  static_assert(std::atomic<double>::is_always_lock_free, "read by the handler of a signal");
};

void execute() {
  ++executions;
  Watch::next();
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

}  // namespace

// One letter, or some of them that stand elsewhere, in the place of others.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most) {
  std::vector<std::uint8_t> bytes(data, data + size);
  const auto at = static_cast<std::ptrdiff_t>(below(size + 1));
  const std::size_t length =
      std::min<std::size_t>(below(8) + 1, size - static_cast<std::size_t>(at));
  switch (below(4)) {
    case 0:
      bytes.erase(bytes.begin() + at, bytes.begin() + at + static_cast<std::ptrdiff_t>(length));
      break;
    case 1:
      bytes.insert(bytes.begin() + at,
                   static_cast<std::uint8_t>(below(4) > 0 ? 32 + below(95) : below(256)));
      break;
    case 2:
      if (at < static_cast<std::ptrdiff_t>(size))
        bytes[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(32 + below(95));
      break;
    default: {
      const std::vector<std::uint8_t> piece(
          bytes.begin() + at, bytes.begin() + at + static_cast<std::ptrdiff_t>(length));
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(size + 1)), piece.begin(),
                   piece.end());
    }
  }
  bytes.resize(std::min(bytes.size(), most));
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

namespace {

struct Arguments {
  std::size_t executions = 10'000, most_bytes = 4096, seconds = 1'000'000, timeout = 20;
  std::vector<std::string> corpus;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Options that only libFuzzer has are passed over.
Arguments read_arguments(const std::vector<std::string>& words) {
  Arguments arguments;
  for (const std::string& word : words) {
    const auto value = [&] { return std::stoul(word.substr(word.find('=') + 1)); };
    if (word.starts_with("-runs="))
      arguments.executions = value();
    else if (word.starts_with("-max_total_time="))
      arguments.seconds = value();
    else if (word.starts_with("-timeout="))
      arguments.timeout = value();
    else if (word.starts_with("-max_len="))
      arguments.most_bytes = value();
    else if (word.starts_with("-seed="))
      generator().seed(static_cast<unsigned>(value()));
    else if (!word.starts_with("-"))
      for (const auto& entry : std::filesystem::directory_iterator(word))
        if (entry.is_regular_file() && entry.file_size() <= arguments.most_bytes)
          arguments.corpus.push_back(text_of(entry.path()));
  }
  if (arguments.corpus.empty()) arguments.corpus.emplace_back();
  std::sort(arguments.corpus.begin(), arguments.corpus.end());  // not as the folder lists them
  std::shuffle(arguments.corpus.begin(), arguments.corpus.end(), generator());
  return arguments;
}

// One mutation, and in one case of three another one after each: what is changed often is refused
// for the first thing that is wrong with it.
std::string mutated(const std::string& start, std::size_t most) {
  std::string text = start;
  std::size_t size = text.size();
  text.resize(most);
  auto* data = reinterpret_cast<std::uint8_t*>(text.data());
  do {
    size = LLVMFuzzerCustomMutator != nullptr
               ? LLVMFuzzerCustomMutator(data, size, most, static_cast<unsigned>(generator()()))
               : LLVMFuzzerMutate(data, size, most);
  } while (below(3) == 0);
  text.resize(size);
  return text;
}

}  // namespace

int main(int count, char** words) {
  const Arguments arguments = read_arguments({words + 1, words + count});
  catch_crashes();
  Watch::begin(static_cast<double>(arguments.timeout));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(arguments.seconds);
  std::size_t execution = 0;
  for (; execution < arguments.executions && std::chrono::steady_clock::now() < end; ++execution) {
    const std::vector<std::string>& corpus = arguments.corpus;
    input = execution % 2 == 0 && execution / 2 < corpus.size()
                ? corpus[execution / 2]
                : mutated(corpus[below(corpus.size())], arguments.most_bytes);
    execute();
  }
  std::cout << execution << " executions\n";
}
