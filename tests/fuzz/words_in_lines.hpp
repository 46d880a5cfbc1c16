// Texts whose lines are words, as their mutations see them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "mutation.hpp"

namespace courant::fuzz {

using Lines = std::vector<std::vector<std::string>>;  // of words

inline Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream of_line(line);
    lines.emplace_back();
    for (std::string word; of_line >> word;) lines.back().push_back(word);
  }
  return lines;
}

inline std::string text_of(const Lines& lines) {
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) text += (i > 0 ? " " : "") + line[i];
    text += '\n';
  }
  return text;
}

// mutate_text() of such a text, by changes of its lines.
template <class Change>
std::size_t mutate_lines(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                         const Change& change) {
  return mutate_text(data, size, most, seed,
                     [&](const std::string& text, std::size_t times, Generator& generator) {
                       Lines lines = lines_of(text);
                       if (lines.size() < 2) return std::string();
                       for (; times > 0 && !lines.empty(); --times) change(lines, generator);
                       return text_of(lines);
                     });
}

// Changes a word of a line: by one of another line, by one of `words`, which may also come behind the line, or as the
// format itself changes it, `own(line, word)`.
template <class Own>
void mutate_word(Lines& lines, std::size_t at, const std::vector<std::string>& words,
                 Generator& generator, const Own& own) {
  std::vector<std::string>& line = lines[at];
  if (line.empty()) return;
  std::string& word = line[below(line.size(), generator)];
  const std::vector<std::string>& other = lines[below(lines.size(), generator)];
  switch (below(4, generator)) {
    case 0:
      if (!other.empty()) word = std::string(other[below(other.size(), generator)]);
      return;
    case 1:
      line.push_back(words[below(words.size(), generator)]);
      return;
    case 2:
      own(line, word);
      return;
    default:
      word = words[below(words.size(), generator)];
  }
}

}  // namespace courant::fuzz
