// Words in a row.
#pragma once

#include <concepts>
#include <functional>
#include <ranges>
#include <string>
#include <string_view>

namespace courant {

// The words of a range with `between` between each two: "a, b, c". `word` gives the word of an element.
template <std::ranges::input_range Range, class Word>
requires std::invocable<Word&, std::ranges::range_reference_t<const Range>> std::string word_list(
    const Range& range, Word word, std::string_view between = ", ") {
  std::string list;
  bool is_first = true;
  for (const auto& element : range) {
    if (!is_first) list += between;
    is_first = false;
    list += std::invoke(word, element);
  }
  return list;
}
template <std::ranges::input_range Range>
std::string word_list(const Range& words, std::string_view between = ", ") {
  return word_list(words, std::identity(), between);
}

}  // namespace courant
