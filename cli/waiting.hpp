// Words for somebody who waits at a terminal.
#pragma once

#include <chrono>
#include <string>
#include <thread>

#include "courant/cli/command.hpp"

namespace courant::cli {

// One line on a terminal, "constraint algorithm … 12 s", from the first second of waiting until the
// object is gone, which leaves no trace. Nothing where there is no terminal.
class Waiting {
 public:
  Waiting(const Console& console, std::string what,
          std::chrono::milliseconds patience = std::chrono::seconds(1));

 private:
  std::jthread thread_;
};

}  // namespace courant::cli
