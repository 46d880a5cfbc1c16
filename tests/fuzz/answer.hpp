// The command as it is fuzzed.
#pragma once

#include <string>
#include <vector>

namespace courant::fuzz {

struct Answer {
  int status;
  std::string out, err;
};

// The command answers these arguments and this standard input as the documentation promises: with
// one of its exit statuses, with a message where the status is 2, in words for users. What can be
// stopped is, after a twentieth of a second of the processor.
Answer require_answer(const std::vector<std::string>& arguments, const std::string& input);

// A folder for the files of this process, empty whenever it is asked for.
std::string empty_folder();

// A folder for a run of this process, which is not there at first.
const std::string& run_folder();

}  // namespace courant::fuzz
