// What an experiment of a stranger may use.
#pragma once

#include <atomic>
#include <string>

namespace courant::cli {

// The limits of a process that runs an experiment whose author nobody knows: of memory, of the size
// of each file, of the time of the processor. Limits that the process has already, and that are
// lower, stay. They hold until the process ends.
class Confinement {
 public:
  static constexpr unsigned kSeconds = 60;      // of the processor
  static constexpr unsigned kMegabytes = 2000;  // of memory
  static constexpr unsigned kFileMegabytes = 256;

  // When the time is over, what goes on is interrupted, if `heeds_stop` says that it looks at
  // interrupts; else the process ends with a message and the status `failed`. Once in a process.
  static void begin(const std::atomic<bool>* heeds_stop);

  // Whether the time is over.
  static bool is_out_of_time();
  static std::string time_in_words();  // "takes more than 60 s of the processor"
};

}  // namespace courant::cli
