// What every message to a user has to be, whatever was asked.
#pragma once

#include <cstdlib>
#include <iostream>
#include <string>

namespace courant::fuzz {

// Ends the program with these words unless `holds`.
inline void require(bool holds, const std::string& what, const std::string& found) {
  if (holds) return;
  std::cerr << "Wrong answer: " << what << ":\n" << found << std::endl;
  std::abort();
}

// No names of C++, no noise. `input`: what the user wrote, whose own words may be repeated.
inline void require_words_for_users(const std::string& message, const std::string& input) {
  for (const char* wrong : {"::", "0.000000", "-nan", "bad_alloc", "exception", "std"})
    require(message.find(wrong) == std::string::npos || input.find(wrong) != std::string::npos,
            std::string("\"") + wrong + "\" is in a message", message);
}

}  // namespace courant::fuzz
