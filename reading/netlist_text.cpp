#include "courant/reading/netlist_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace courant::netlist {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return result;
}

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::vector<std::string> words_of(const std::string& text, int line) {
  std::vector<std::string> words;
  std::string word;
  const auto finish = [&] {
    if (!word.empty()) words.push_back(word);
    word.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '{' || c == '\'') {
      finish();
      const std::size_t end = text.find(c == '{' ? '}' : '\'', i + 1);
      if (end == std::string::npos)
        throw LineError{line, std::string("an expression begins with ") + c + " and does not end"};
      words.push_back("{" + text.substr(i + 1, end - i - 1) + "}");
      i = end;
    } else if (is_space(c) || c == '(' || c == ')' || c == ',') {
      finish();
    } else if (c == '=') {
      finish();
      words.emplace_back("=");
    } else {
      word += c;
    }
  }
  finish();
  return words;
}

// The number at the start of a text, and how many characters it takes, with the letters behind it.
std::optional<std::pair<double, std::size_t>> leading_number(std::string_view text) {
  double value = 0.0;
  const bool plus = !text.empty() && text[0] == '+';
  const char* begin = text.data() + (plus ? 1 : 0);
  const char* end = text.data() + text.size();
  if (begin == end || !(is_digit(*begin) || *begin == '.' || *begin == '-')) return std::nullopt;
  const auto [after, error] = std::from_chars(begin, end, value);
  if (error != std::errc()) return std::nullopt;
  auto length = static_cast<std::size_t>(after - text.data());
  std::size_t letters = length;
  while (letters < text.size() && is_letter(text[letters])) ++letters;
  const std::string unit = lower(text.substr(length, letters - length));
  const auto is = [&](const char* prefix) { return unit.rfind(prefix, 0) == 0; };
  value *= is("meg")   ? 1e6
           : is("mil") ? 25.4e-6
           : is("t")   ? 1e12
           : is("g")   ? 1e9
           : is("k")   ? 1e3
           : is("m")   ? 1e-3
           : is("u")   ? 1e-6
           : is("n")   ? 1e-9
           : is("p")   ? 1e-12
           : is("f")   ? 1e-15
                       : 1.0;
  return std::pair(value, letters);
}

}  // namespace

std::vector<Line> lines_of(std::string_view text, std::string& title) {
  struct Joined {
    int number;
    std::string text;
  };
  std::vector<Joined> joined;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) end = text.size();
    std::string line(text.substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1) {
      title = line;
      continue;
    }
    const std::size_t comment = std::min(line.find(';'), line.find("$ "));
    if (comment != std::string::npos) line.resize(comment);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '*') continue;
    if (line[first] == '+') {
      if (joined.empty()) throw LineError{number, "continues no line"};
      joined.back().text += " " + line.substr(first + 1);
    } else {
      joined.push_back({number, line});
    }
  }
  std::vector<Line> lines;
  for (const auto& [where, content] : joined) {
    Line line{where, {}, words_of(content, where)};
    for (const std::string& word : line.written) line.words.push_back(lower(word));
    if (!line.words.empty() && line.words[0] == ".end") break;
    if (!line.words.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<double> number(std::string_view word) {
  const auto found = leading_number(word);
  return found && found->second == word.size() ? std::optional(found->first) : std::nullopt;
}

std::string digits(double value) {
  char buffer[32];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

std::string formula(const std::string& word, const Scope& scope, int line) {
  if (const auto value = number(word)) return digits(*value);
  const bool braces = word.front() == '{';
  const std::string text = braces ? word.substr(1, word.size() - 2) : word;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    if (is_digit(text[i]) || text[i] == '.') {
      const auto found = leading_number(rest);
      if (!found) throw LineError{line, "\"" + text + "\" has no number where one begins"};
      result += digits(found->first);
      i += found->second;
    } else if (is_letter(text[i])) {
      std::size_t end = i;
      while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
      const std::string name = text.substr(i, end - i);
      const std::size_t next = text.find_first_not_of(' ', end);
      const bool is_function = next != std::string::npos && text[next] == '(';
      if (const auto known = scope.find(name); known != scope.end())
        result += known->second;
      else if (is_function || name == "pi")
        result += name == "ln" ? "log" : name;
      else
        throw LineError{line, "unknown parameter \"" + name + "\""};
      i = end;
    } else if (rest.substr(0, 2) == "**") {
      result += "^";
      i += 2;
    } else {
      result += text[i++];
    }
  }
  return braces ? "(" + result + ")" : result;
}

}  // namespace courant::netlist
