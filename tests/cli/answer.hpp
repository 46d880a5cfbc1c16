// What the command answers.
#pragma once

#include <atomic>
#include <sstream>
#include <string>
#include <vector>

#include "courant/cli/command.hpp"

namespace courant::test {

struct Answer {
  int status = 0;
  std::string out, err;
};

// The command with these arguments and this standard input; `stop` as in cli::command.
inline Answer courant_command(const std::vector<std::string>& arguments,
                              const std::string& input = "",
                              const std::atomic<bool>* stop = nullptr) {
  std::istringstream in(input);
  std::ostringstream out, err;
  const int status = cli::command(arguments, {.in = in, .out = out, .err = err, .stop = stop});
  return {status, out.str(), err.str()};
}

}  // namespace courant::test
