// What a message or a text has to say.
#pragma once

#include <string_view>

namespace courant {

// Whether the part is in the text.
inline bool says(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace courant
