#include "courant/running/damage_of_lines.hpp"

#include <algorithm>
#include <fstream>

#include "courant/core/files/input_file.hpp"

namespace courant {

std::string damage_of_rows(std::uintmax_t first, std::uintmax_t last) {
  if (first == last) return "row " + std::to_string(first) + " is not as it was written";
  return "rows " + std::to_string(first) + " to " + std::to_string(last) +
         " are not as they were written";
}

std::optional<std::string> damage_of_lines(const std::filesystem::path& file,
                                           const HashedBytes::Record& record) {
  const Difference there = difference(file, 0, record);
  if (there.is_none()) return std::nullopt;
  std::ifstream stream = input_file(file);
  std::uintmax_t line = 0, at = 0, first = 0,
                 last = 0;  // lines from 1, of which the first is the head
  bool is_torn = false;
  for (char c = 0; at < there.to && stream.get(c); ++at) {
    if (at == there.from) first = line + 1;
    if (at >= there.from) last = line + 1;
    if (at >= there.from && static_cast<unsigned char>(c) < 0x20 && c != '\n') {
      is_torn = true;
      break;
    }
    if (c == '\n') ++line;
  }
  if (last == 0) return "ends before row " + std::to_string(std::max<std::uintmax_t>(line, 1));
  if (is_torn) first = last;
  if (last == 1) return "its first line is not as it was written";
  return damage_of_rows(std::max<std::uintmax_t>(first, 2) - 1, last - 1);
}

}  // namespace courant
