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

// Whether a message has "::" in it that is not the end of a place: "/method:: unknown key" of a key "method:".
inline bool has_scope(const std::string& message) {
  for (std::size_t at = message.find("::"); at != std::string::npos;
       at = message.find("::", at + 1))
    if (message.compare(at, 3, ":: ") != 0) return true;
  return false;
}

// No names of C++, no noise. `input`: what the user wrote, whose own words may be repeated.
inline void require_words_for_users(const std::string& message, const std::string& input) {
  require(!has_scope(message) || has_scope(input), "\"::\" is in a message", message);
  for (const char* wrong : {"0.000000", "-nan", "bad_alloc", "exception", "std"})
    require(message.find(wrong) == std::string::npos || input.find(wrong) != std::string::npos,
            std::string("\"") + wrong + "\" is in a message", message);
}

}  // namespace courant::fuzz
