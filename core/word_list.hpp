// Words in a row.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace courant {

// The words with this between each two: "a, b, c".
inline std::string word_list(std::span<const std::string> words, std::string_view between = ", ") {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += between;
    list += words[i];
  }
  return list;
}

}  // namespace courant
