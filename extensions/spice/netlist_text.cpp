#include "courant/extensions/spice/netlist_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace courant::netlist {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return result;
}

// What DOS wrote at the end of a text.
constexpr char kEndOfFile = '\x1a';

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
    if (c == '{' || c == '\'' || c == '"') {
      finish();
      const std::size_t end = text.find(c == '{' ? '}' : c, i + 1);
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
  if (is("mil")) return std::pair(value * 25.4e-6, letters);
  const char* exponent = is("meg") ? "e6"
                         : is("t") ? "e12"
                         : is("g") ? "e9"
                         : is("k") ? "e3"
                         : is("m") ? "e-3"
                         : is("u") ? "e-6"
                         : is("n") ? "e-9"
                         : is("p") ? "e-12"
                         : is("f") ? "e-15"
                                   : "";
  // As one decimal number: 100 times the double 1e-9 is not 1e-7.
  const std::string_view digits(begin, static_cast<std::size_t>(after - begin));
  const double factor = std::stod(std::string("1") + exponent);
  if (digits.find_first_of("eE") != std::string_view::npos)
    return std::pair(value * factor, letters);
  const std::string whole = std::string(digits) + exponent;
  std::from_chars(whole.data(), whole.data() + whole.size(), value);
  return std::pair(value, letters);
}

}  // namespace

namespace {

struct Joined {
  int number;
  std::string origin, text;
};

std::string first_word(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return lower(text.substr(begin, text.find_first_of(" \t", begin) - begin));
}

// The words of .include and .lib: file names, in quotes or not.
std::vector<std::string> quoted_words(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_space(text[i])) continue;
    const bool quoted = text[i] == '"' || text[i] == '\'';
    const std::size_t begin = quoted ? i + 1 : i;
    std::size_t end = quoted ? text.find(text[i], begin) : text.find_first_of(" \t", begin);
    if (end == std::string::npos) end = text.size();
    words.push_back(text.substr(begin, end - begin));
    i = end;
  }
  return words;
}

// Lines that go on are joined, comments left out, included files put in their places.
class Joining {
 public:
  explicit Joining(const IncludedText& included) : included_(included) {}

  // `file`: empty for the netlist itself, whose first line is its title. `section`: the only one of a .lib
  // that is taken, if it is not empty.
  void read(std::string_view text, const std::string& file, int including,
            const std::string& section, std::string& title) {
    if (++depth_ > kDeepest) throw LineError{including, "files include each other without end"};
    int number = 0;
    bool taken = section.empty();
    std::size_t first_own = joined_.size();
    for (std::size_t begin = 0; begin < text.size();) {
      std::size_t end = text.find('\n', begin);
      if (end == std::string_view::npos) end = text.size();
      std::string line(text.substr(begin, end - begin));
      begin = end + 1;
      ++number;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (number == 1 && file.empty()) {
        title = line;
        continue;
      }
      const std::size_t comment =
          std::min({line.find(';'), line.find("$ "), line.find("//"), line.find(kEndOfFile)});
      if (comment != std::string::npos) line.resize(comment);
      const std::size_t first = line.find_first_not_of(" \t");
      if (first == std::string::npos || line[first] == '*' || line[first] == '#') continue;
      const int where = file.empty() ? number : including;
      const std::string origin = file.empty() ? "" : file + ", line " + std::to_string(number);
      const std::string word = first_word(line);
      const std::vector<std::string> words = quoted_words(line);
      if (!file.empty() && word == ".lib" && words.size() == 2) {  // begins a section
        taken = lower(words[1]) == section;
        continue;
      }
      if (word == ".endl") {
        taken = section.empty();
        continue;
      }
      if (!taken) continue;
      if (word == ".end" && file.empty()) return;
      if (word == ".end") break;
      if (line[first] == '+') {
        if (joined_.size() == first_own) throw LineError{where, "continues no line"};
        joined_.back().text += " " + line.substr(first + 1);
      } else if (word == ".include" || word == ".inc" || word == ".lib") {
        if (words.size() < 2) throw LineError{where, "has no file; expected one"};
        const std::string inner = words.size() > 2 && word == ".lib" ? lower(words[2]) : "";
        read(text_of(words[1], where), words[1], where, inner, title);
        first_own = joined_.size();
      } else {
        joined_.push_back({where, origin, line});
      }
    }
    --depth_;
  }

  std::vector<Joined>& joined() { return joined_; }

 private:
  static constexpr int kDeepest = 10;

  std::string text_of(const std::string& file, int line) const {
    if (!included_)
      throw LineError{line, "includes " + file + ", but there is no folder to look in"};
    try {
      return included_(file);
    } catch (const std::runtime_error& error) {
      throw LineError{line, "the file " + file + " " + error.what()};
    }
  }

  const IncludedText& included_;
  std::vector<Joined> joined_;
  int depth_ = 0;
};

// The arguments in the parentheses that begin at `open`, and where these end.
std::pair<std::vector<std::string>, std::size_t> arguments_at(const std::string& text,
                                                              std::size_t open, int line) {
  std::vector<std::string> arguments(1);
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(' && depth++ == 0) continue;
    if (c == ')' && --depth == 0) return {arguments, i + 1};
    if (c == ',' && depth == 1)
      arguments.emplace_back();
    else
      arguments.back() += c;
  }
  throw LineError{line, "has a ( without its )"};
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t{}'\"="),
                    end = text.find_last_not_of(" \t{}'\"");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

// Functions that .func and .param f(x)=… define.
class Functions {
 public:
  // Whether the line defines one.
  bool take(const Joined& line) {
    const std::string word = first_word(line.text);
    if (word != ".func" && word != ".param") return false;
    const std::size_t begin =
        line.text.find_first_not_of(" \t", line.text.find(word[1]) + word.size() - 1);
    const std::size_t open = line.text.find('(');
    if (begin == std::string::npos || open == std::string::npos) return false;
    const std::string name = lower(trimmed(line.text.substr(begin, open - begin)));
    if (name.empty() ||
        !std::ranges::all_of(name, [](char c) { return is_letter(c) || is_digit(c); }))
      return false;
    auto [parameters, end] = arguments_at(line.text, open, line.number);
    for (std::string& parameter : parameters) parameter = lower(trimmed(parameter));
    functions_[name] = {parameters, trimmed(line.text.substr(end))};
    return true;
  }

  std::string expanded(std::string text, int line) const {
    if (functions_.empty()) return text;
    constexpr int most = 1000;
    for (int count = 0; count < most; ++count) {
      const auto call = next_call(text);
      if (!call) return text;
      const auto& [begin, open, function] = *call;
      const auto [values, end] = arguments_at(text, open, line);
      if (values.size() != function->parameters.size())
        throw LineError{line, "the function " + text.substr(begin, open - begin) + " has " +
                                  std::to_string(values.size()) + " arguments; expected " +
                                  std::to_string(function->parameters.size())};
      text = text.substr(0, begin) + "(" + put_in(*function, values) + ")" + text.substr(end);
    }
    throw LineError{line, "functions of .func call each other without end"};
  }

 private:
  struct Body {
    std::vector<std::string> parameters;
    std::string text;
  };
  struct Call {
    std::size_t begin, open;
    const Body* function;
  };

  std::optional<Call> next_call(const std::string& text) const {
    for (std::size_t i = 0; i < text.size();) {
      if (!is_letter(text[i])) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
      const std::size_t open = text.find_first_not_of(" \t", end);
      const auto found = functions_.find(lower(text.substr(i, end - i)));
      if (found != functions_.end() && open != std::string::npos && text[open] == '(')
        return Call{i, open, &found->second};
      i = end;
    }
    return std::nullopt;
  }

  static std::string put_in(const Body& function, const std::vector<std::string>& values) {
    std::string result;
    const std::string& text = function.text;
    for (std::size_t i = 0; i < text.size();) {
      std::size_t end = i;
      while (end < text.size() && (is_letter(text[end]) || (end > i && is_digit(text[end])))) ++end;
      if (end == i) {
        // The digits and letters of a number are no name.
        end = i + 1;
        if (is_digit(text[i]))
          while (end < text.size() &&
                 (is_letter(text[end]) || is_digit(text[end]) || text[end] == '.'))
            ++end;
        result += text.substr(i, end - i);
        i = end;
        continue;
      }
      const std::string word = text.substr(i, end - i);
      const auto found = std::ranges::find(function.parameters, lower(word));
      result +=
          found == function.parameters.end()
              ? word
              : "(" +
                    trimmed(values[static_cast<std::size_t>(found - function.parameters.begin())]) +
                    ")";
      i = end;
    }
    return result;
  }

  std::map<std::string, Body> functions_;
};

}  // namespace

namespace {

// The words of commands, whose quotes are theirs.
std::vector<std::string> words_of_command(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

std::vector<Line> lines_of(std::string_view text, std::string& title,
                           const IncludedText& included) {
  Joining joining(included);
  joining.read(text, "", 0, "", title);
  Functions functions;
  std::erase_if(joining.joined(), [&](const Joined& line) { return functions.take(line); });
  std::vector<Line> lines;
  bool commands = false;
  for (const auto& [where, origin, content] : joining.joined()) {
    const std::string first = first_word(content);
    if (first == ".endc") commands = false;
    const std::string whole = commands ? content : functions.expanded(content, where);
    Line line{
        where, whole, {}, commands ? words_of_command(whole) : words_of(whole, where), origin};
    commands = commands || first == ".control";
    for (const std::string& word : line.written) line.words.push_back(lower(word));
    if (!line.words.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<double> number(std::string_view word) {
  const auto found = leading_number(word);
  return found && found->second == word.size() ? std::optional(found->first) : std::nullopt;
}

}  // namespace courant::netlist
