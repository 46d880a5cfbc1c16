#include "courant/cli/text.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/core/words/word_list.hpp"

namespace courant::cli {
namespace {

// The words of a text; those of a formula that stand in parentheses together, and a sign and = with
// what follows, unless that is longer than `longest`.
std::vector<std::string> pieces(const std::string& text, std::size_t longest) {
  std::vector<std::string> result;
  std::string piece;
  std::size_t begin = 0;  // of the words that belong to the piece, in `words`
  std::vector<std::string> words;
  const auto finish = [&] {
    if (piece.empty()) return;
    const bool is_side = piece.starts_with("= ") && !result.empty();
    const std::size_t needed = text_width(piece) + (is_side ? text_width(result.back()) + 1 : 0);
    if (needed > longest)
      result.insert(result.end(), words.begin() + static_cast<std::ptrdiff_t>(begin), words.end());
    else if (is_side)
      result.back() += " " + piece;
    else
      result.push_back(piece);
    piece.clear();
    begin = words.size();
  };
  std::ptrdiff_t depth = 0;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    words.push_back(word);
    piece += (piece.empty() ? "" : " ") + word;
    depth += std::ranges::count(word, '(') - std::ranges::count(word, ')');
    if (depth <= 0 && word != "+" && word != "-" && word != "=") finish();
  }
  finish();
  return result;
}

// A cell in lines of at most `width` characters, broken between words; those after the first begin with `further`.
std::vector<std::string> lines_of(const std::string& cell, std::size_t width,
                                  const std::string& further) {
  if (text_width(cell) <= width) return {cell};
  std::vector<std::string> lines;
  std::string line, word;
  bool is_begun = false;
  std::istringstream in(cell);
  while (std::getline(in, word, ' ')) {
    if (is_begun && text_width(line) + 1 + text_width(word) > width) {
      lines.push_back(line);
      line = further + word;
    } else {
      line += (is_begun ? " " : "") + word;
    }
    is_begun = true;
  }
  lines.push_back(line);
  return lines;
}

}  // namespace

std::string shown(double value, int digits) { return number_text(value, digits); }

std::string shown(const Json& value, int digits) {
  if (value.is_number_integer()) return std::to_string(value.get<long>());
  if (value.is_number()) return shown(value.get<double>(), digits);
  if (value.is_null()) return "–";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string shown_name(const std::filesystem::path& file) { return printable(file.string()); }

std::string shown_if_known(double value, int digits) {
  return std::isnan(value) ? "–" : shown(value, digits);
}
std::string shown_if_known(std::optional<Index> value) {
  return value ? std::to_string(*value) : "–";
}

void print_wrapped(const Console& console, const std::string& text, const std::string& indent) {
  std::ostream& out = console.out;
  const std::size_t columns =
      console.columns > indent.size() + 20 ? console.columns - indent.size() : 20;
  const std::size_t spaces = text.find_first_not_of(' ');
  const std::string first(spaces == std::string::npos ? 0 : spaces, ' ');
  const std::string further = first + (first.empty() ? "" : "    ");
  std::string line = first;
  bool is_begun = false;
  for (const std::string& piece : pieces(text, first.empty() ? 0 : columns - further.size())) {
    if (is_begun && text_width(line) + 1 + text_width(piece) > columns) {
      out << indent << line << '\n';
      line = further;
      is_begun = false;
    }
    line += (is_begun ? " " : "") + piece;
    is_begun = true;
  }
  out << indent << line << '\n';
}

void TextTable::add(std::vector<std::string> row) {
  for (std::string& cell : row) cell = printable(cell);
  rows_.push_back(std::move(row));
}

void TextTable::print(std::ostream& out, const std::string& indent, std::size_t columns) const {
  constexpr std::size_t narrowest = 20;
  const std::string further = "    ";
  std::vector<std::size_t> widths;
  for (const auto& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], text_width(row[i]));
  }
  std::size_t others = indent.size();
  for (std::size_t i = 1; i < widths.size(); ++i) others += 2 + widths[i];
  widths[0] = std::min(widths[0], columns > others + narrowest ? columns - others : narrowest);
  for (const auto& row : rows_) {
    const std::vector<std::string> first = lines_of(row[0], widths[0], further);
    std::string line = indent + padded(first[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i)
      line += "  " + std::string(widths[i] - text_width(row[i]), ' ') + row[i];
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
    for (std::size_t k = 1; k < first.size(); ++k) out << indent << first[k] << '\n';
  }
}

std::string ladder_line(const LadderReport& ladder) {
  return word_list(
      ladder.dimensions(),
      [](const LadderReport::Dimensions& of) {
        const auto& [S, M] = of;
        return S ? "(" + std::to_string(*S) + ", " + shown_if_known(M) + ")" : "∅";
      },
      " ⊇ ");
}

}  // namespace courant::cli
