#include "courant/reading/setting.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr std::size_t kMost = 100'000;  // values: a slip of the keyboard, rather than a sweep

[[noreturn]] void refuse(const std::string& option, const std::string& pointer,
                         const std::string& what) {
  throw ExperimentError(option + " " + pointer, what);
}

// The pointer and what stands after the =.
std::pair<std::string, std::string> split(const std::string& text, const std::string& option,
                                          const std::string& expected) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || text[0] != '/')
    refuse(option, text.substr(0, equals), "is not a change; expected " + expected);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

Json value_of(std::string_view text) {
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

// The pieces between separators that stand outside brackets, braces and quotes.
std::vector<std::string_view> pieces(std::string_view text, char separator) {
  std::vector<std::string_view> found;
  std::size_t begin = 0;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') {
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted) {
      if (c == '[' || c == '{' || c == '(') ++depth;
      if (c == ']' || c == '}' || c == ')') --depth;
      if (c == separator && depth <= 0) {
        found.push_back(text.substr(begin, i - begin));
        begin = i + 1;
      }
    }
  }
  found.push_back(text.substr(begin));
  return found;
}

// The cells of the row that begins at i, which becomes where the next one begins. In quotes a comma and a
// line end belong to a cell, and "" is a quote.
std::vector<std::string> row_of_cells(std::string_view text, std::size_t& i) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      cells.back() += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && c == ',')
      cells.emplace_back();
    else if (!quoted && c == '\n')
      break;
    else if (c != '\r' || quoted)
      cells.back() += c;
  }
  ++i;
  return cells;
}

// The tokens of a pointer, where those of elements of a list are the names that these have.
std::vector<std::string> tokens_by_name(const std::string& pointer, const Json& document) {
  std::vector<std::string> tokens;
  const Json* at = &document;
  for (const std::string_view token : pieces(std::string_view(pointer).substr(1), '/')) {
    const Json* const above = at;
    const auto place = number_in<std::size_t>(token);
    at = nullptr;
    if (above && above->is_array() && place && *place < above->size()) at = &(*above)[*place];
    if (above && above->is_object() && above->contains(token)) at = &above->at(std::string(token));
    const bool is_named = at && above->is_array() && at->is_object() && at->contains("name") &&
                          at->at("name").is_string();
    tokens.push_back(is_named ? at->at("name").get<std::string>() : std::string(token));
  }
  return tokens;
}

// The last n of them, with slashes between.
std::string end_of(const std::vector<std::string>& tokens, std::size_t n) {
  std::string end;
  for (std::size_t i = tokens.size() - std::min(n, tokens.size()); i < tokens.size(); ++i)
    end += (end.empty() ? "" : "/") + tokens[i];
  return end;
}

// n numbers from a to b, both of them exactly.
std::vector<Json> numbers(double a, double b, std::size_t n) {
  std::vector<Json> values;
  for (std::size_t i = 0; i < n; ++i) {
    const double share = n == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(n - 1);
    const double value = i + 1 == n && n > 1 ? b : a + (b - a) * share;
    const bool is_whole = std::abs(value) < 1e15 && value == std::floor(value);
    values.push_back(is_whole ? Json(static_cast<long>(value)) : Json(value));
  }
  return values;
}

}  // namespace

Setting read_setting(const std::string& text, const std::string& option) {
  auto [pointer, value] = split(text, option, "/json/pointer=VALUE, such as /time/step=0.1");
  return {std::move(pointer), value_of(value)};
}

void apply_setting(const Setting& setting, Json& document, const std::string& option) {
  try {
    const Json::json_pointer place(setting.pointer);
    const Json::json_pointer above = place.parent_pointer();
    Json* const parent = document.contains(above) ? &document.at(above) : nullptr;
    // The short form of a kind, "midpoint", stands for {"type": "midpoint"}; that of initial values for {"rest": true}.
    if (parent && *parent == "rest" && above == Json::json_pointer("/initial"))
      *parent = {{"rest", true}};
    else if (parent && parent->is_string() && !above.empty())
      *parent = {{"type", *parent}};
    if (!parent || !(parent->is_object() || (parent->is_array() && document.contains(place))))
      refuse(option, setting.pointer,
             "there is no such place in the experiment; expected one, or a new key of an object");
    document[place] = setting.value;
  } catch (const Json::exception&) {
    refuse(option, setting.pointer, "is not a JSON pointer; expected one such as /time/step");
  }
}

ValueRange read_range(const std::string& text, const std::string& option) {
  const std::string expected = "/json/pointer=a:b:n, such as /time/step=0.1:1:10, or =v,w,…";
  const auto [pointer, written] = split(text, option, expected);
  const std::vector<std::string_view> list = pieces(written, ',');
  const std::vector<std::string_view> ends = pieces(written, ':');
  ValueRange range{pointer, {}};
  if (list.size() == 1 && ends.size() == 3) {
    const auto a = number_in<double>(ends[0]), b = number_in<double>(ends[1]);
    const auto n = number_in<std::size_t>(ends[2]);
    if (!a || !b || !n || !std::isfinite(*a) || !std::isfinite(*b))
      refuse(option, pointer,
             "is " + written + "; expected a:b:n, n numbers from a to b, such as 0.1:1:10");
    if (*n == 0 || *n > kMost)
      refuse(option, pointer,
             "has " + std::to_string(*n) + " values; expected 1 to " + std::to_string(kMost));
    range.values = numbers(*a, *b, *n);
    return range;
  }
  // Of a formula or a text colons are no ends: what begins with a number, and is none, is meant for a range.
  if (list.size() == 1 && ends.size() > 1 && number_in<double>(ends[0]))
    refuse(option, pointer,
           "is " + written +
               "; expected a:b:n, n numbers from a to b, such as 0.1:1:10, or a list v,w,…");
  for (const std::string_view piece : list) {
    if (piece.empty()) refuse(option, pointer, "has a value that is empty; expected " + expected);
    range.values.push_back(value_of(piece));
  }
  return range;
}

std::vector<std::string> short_names(std::span<const std::string> pointers, const Json& document) {
  std::vector<std::vector<std::string>> tokens;
  for (const std::string& pointer : pointers) tokens.push_back(tokens_by_name(pointer, document));
  std::vector<std::string> names;
  for (const auto& own : tokens) {
    const auto is_shared = [&](std::size_t n) {
      return std::ranges::count_if(
                 tokens, [&](const auto& other) { return end_of(other, n) == end_of(own, n); }) > 1;
    };
    std::size_t n = 1;
    while (n < own.size() && is_shared(n)) ++n;
    names.push_back(end_of(own, n));
  }
  return names;
}

std::vector<ValueRange> read_cases(std::string_view text, const std::string& name,
                                   const std::string& option) {
  std::vector<ValueRange> ranges;
  long line = 0;
  const auto wrong = [&](const std::string& what) {
    refuse(option, name, "line " + std::to_string(line) + " " + what);
  };
  for (std::size_t i = 0; i < text.size();) {
    ++line;
    const std::vector<std::string> cells = row_of_cells(text, i);
    if (cells.size() == 1 && cells[0].empty()) continue;
    if (ranges.empty()) {
      for (const std::string& cell : cells) {
        if (cell.empty() || cell[0] != '/')
          wrong("has \"" + cell +
                "\"; expected a JSON pointer for each column, such as /time/step");
        ranges.push_back({cell, {}, !ranges.empty()});
      }
      continue;
    }
    if (cells.size() != ranges.size())
      wrong("has " + std::to_string(cells.size()) + " cells; expected " +
            std::to_string(ranges.size()) + ", one for each column");
    if (ranges[0].values.size() == kMost)
      wrong("is one case too many; expected at most " + std::to_string(kMost));
    for (std::size_t k = 0; k < cells.size(); ++k) ranges[k].values.push_back(value_of(cells[k]));
  }
  if (ranges.empty() || ranges[0].values.empty())
    refuse(option, name, "has no cases; expected a row for each under a row of JSON pointers");
  return ranges;
}

std::vector<std::vector<Setting>> combinations(std::span<const ValueRange> ranges) {
  std::vector<std::vector<Setting>> all = {{}};
  for (std::size_t first = 0, end = 0; first < ranges.size(); first = end) {
    end = first + 1;
    while (end < ranges.size() && ranges[end].is_tied) ++end;
    const std::size_t count = ranges[first].values.size();
    if (all.size() * count > kMost)
      refuse("--sweep", ranges[first].pointer,
             "makes more than " + std::to_string(kMost) + " combinations of values");
    std::vector<std::vector<Setting>> longer;
    for (const auto& settings : all)
      for (std::size_t i = 0; i < count; ++i) {
        longer.push_back(settings);
        for (std::size_t k = first; k < end; ++k)
          longer.back().push_back({ranges[k].pointer, ranges[k].values[i]});
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace courant
