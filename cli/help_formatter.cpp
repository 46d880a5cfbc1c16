#include "courant/cli/help_formatter.hpp"

#include <sstream>

#include "courant/core/words/text_layout.hpp"

namespace courant::cli {
namespace {

constexpr std::size_t further = 6;

// Where the next word ends, with the | or before the space that follows it.
std::size_t word_end(const std::string& text, std::size_t begin) {
  const std::size_t end = text.find_first_of(" |", text.find_first_not_of(' ', begin));
  return end == std::string::npos ? text.size() : text[end] == '|' ? end + 1 : end;
}

std::string folded(const std::string& line, std::size_t description, std::size_t columns) {
  if (text_width(line) <= columns) return line;
  const bool is_described = line.size() > description && line[description] != ' ' &&
                            line.find_first_not_of(' ') <= description &&
                            line.substr(description - 2, 2) == "  ";
  const std::string indent(is_described ? description : further, ' ');
  const std::size_t begin = is_described ? description : line.find_first_not_of(' ');
  std::string text, row = line.substr(0, begin);
  for (std::size_t at = begin, end = at; at < line.size(); at = end) {
    end = word_end(line, at);
    std::string word = line.substr(at, end - at);
    if (row.size() > indent.size() && text_width(row) + text_width(word) > columns) {
      text += row + '\n';
      row = indent;
      word.erase(0, word.find_first_not_of(' '));
    }
    row += word;
  }
  return text + row;
}

}  // namespace

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  std::istringstream lines(CLI::Formatter::make_help(app, std::move(name), mode));
  std::string text, line;
  while (std::getline(lines, line)) text += folded(line, get_column_width(), columns_) + '\n';
  return text;
}

}  // namespace courant::cli
