#include "document_mutation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "courant/cli/schema.hpp"

namespace courant::fuzz {

namespace {

// What an experiment may say, by its schema.
struct Vocabulary {
  std::vector<std::string> keys, words;

  Vocabulary() {
    std::set<std::string> keys_found, words_found;
    collect(Json::parse(cli::schema_text()), keys_found, words_found);
    keys.assign(keys_found.begin(), keys_found.end());
    words.assign(words_found.begin(), words_found.end());
  }

 private:
  static void collect(const Json& schema, std::set<std::string>& keys,
                      std::set<std::string>& words) {
    if (schema.is_object())
      for (const auto& [key, value] : schema.items()) {
        if (key == "properties" && value.is_object())
          for (const auto& [name, of_it] : value.items()) keys.insert(name);
        if (key == "const" && value.is_string()) words.insert(value.get<std::string>());
        if (key == "enum" && value.is_array())
          for (const Json& word : value)
            if (word.is_string()) words.insert(word.get<std::string>());
      }
    if (schema.is_structured())
      for (const Json& part : schema) collect(part, keys, words);
  }
};

const Vocabulary& vocabulary() {
  static const Vocabulary only;
  return only;
}

const std::string& any(const std::vector<std::string>& words, Generator& generator) {
  return words[below(words.size(), generator)];
}

void collect_places(const Json& value, const Json::json_pointer& at,
                    std::vector<Json::json_pointer>& places) {
  if (value.is_object())
    for (const auto& [key, child] : value.items()) {
      places.push_back(at / key);
      collect_places(child, at / key, places);
    }
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) {
      places.push_back(at / i);
      collect_places(value[i], at / i, places);
    }
}

std::string damaged(std::string text, Generator& generator) {
  constexpr std::string_view letters = "()[]{}*/+-^.,'<>=&|! 0123456789exqptR_";
  const std::size_t at = below(text.size() + 1, generator);
  const char letter = letters[below(letters.size(), generator)];
  switch (below(4, generator)) {
    case 0:
      return at < text.size() ? text.erase(at, 1) : text;
    case 1:
      return text.insert(at, 1, letter);
    case 2:
      if (at < text.size()) text[at] = letter;
      return text;
    default:
      return text + text.substr(at);
  }
}

// A formula of another one that is not differentiable, not finite or not real where that is 0 or less.
std::string at_its_edge(const std::string& formula, Generator& generator) {
  static const std::vector<std::string> edges = {
      "sqrt(#)",           "abs(#)",      "(#)^1.5",         "log(#)",
      "sign(#)",           "max(#, 0)",   "asin(#)",         "1/(#)",
      "(#)^(#)",           "acosh(#)",    "atan2(#, #)",     "(#)^0.5*(#)^0.5",
      "exp(800*(#))",      "1e308*(#)",   "1e-308*(#)",      "(#) - (#)",
      "(# + 1e17) - 1e17", "0*(#)",       "if(# > 0, #, 0)", "sum(i, 1, 3, #)",
      "floor(#)",          "(#)*sqrt(t)", "(#)*t^t",         "(#) + log(t)"};
  std::string text;
  for (const char letter : any(edges, generator))
    text += letter == '#' ? formula : std::string(1, letter);
  return text;
}

// A text that would be code in a program that repeats it as it is.
std::string with_code(std::string text, Generator& generator) {
  static const std::vector<std::string> ends = {
      "*/ ",       "\" ",     "' ",           "\n",  "\r",   "\\\n",        "?\?/\n",
      "*?\?/\n/ ", "*\\\n/ ", "\xe2\x80\xa8", "); ", "%s%n", "\n#define x "};
  const std::size_t at = below(text.size() + 1, generator);
  return text.insert(at, any(ends, generator) + std::string(planted_word) + "(); ");
}

// A number where arithmetic ends.
Json extreme(Generator& generator) {
  static const std::vector<Json> numbers = {0.0,
                                            -0.0,
                                            5e-324,
                                            2.2250738585072014e-308,
                                            -1e-300,
                                            1e-160,
                                            1e-17,
                                            1e-13,
                                            1e17,
                                            9007199254740993,
                                            1e160,
                                            1e300,
                                            1.7976931348623157e308,
                                            -1.7976931348623157e308,
                                            2147483647,
                                            2147483648,
                                            -2147483648,
                                            4294967296,
                                            9223372036854775807,
                                            -9223372036854775807,
                                            18446744073709551615U,
                                            1e19};
  return numbers[below(numbers.size(), generator)];
}

Json another_number(double number, Generator& generator) {
  if (below(2, generator) == 0) return extreme(generator);
  return std::array<Json, 6>{
      0, -number, 2 * number, 1e-9 * number, 1e9 * number, number + 1}[below(6, generator)];
}

Json changed(const Json& value, Generator& generator) {
  static const std::vector<Json> others = {nullptr,
                                           true,
                                           0,
                                           -1,
                                           1,
                                           2,
                                           3,
                                           1e-300,
                                           1e300,
                                           -7.5,
                                           1e5,
                                           "",
                                           "x",
                                           "q[0]",
                                           "0",
                                           "1/0",
                                           "t",
                                           "sqrt(-1)",
                                           "x'",
                                           "((",
                                           Json::array(),
                                           Json::object(),
                                           {0},
                                           {{1}},
                                           "euclidean",
                                           "sphere"};
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    switch (below(7, generator)) {
      case 0:
      case 1:
        return damaged(text, generator);
      case 5:
        return with_code(text, generator);
      case 2:
        return any(vocabulary().words, generator);
      case 3:
      case 4:
        return at_its_edge(text, generator);
      default:
        break;
    }
  }
  if (value.is_number() && below(3, generator) != 0)
    return another_number(value.get<double>(), generator);
  return others[below(others.size(), generator)];
}

// A number becomes another one, or what may be a formula is put into another one: the document keeps its
// form, so that more is done with it than to refuse it.
bool change_in_kind(Json& document, std::vector<Json::json_pointer> places, Generator& generator) {
  std::erase_if(places, [&](const Json::json_pointer& place) {
    const Json& value = document[place];
    const std::vector<std::string>& words = vocabulary().words;
    if (!value.is_string()) return !value.is_number();
    return std::find(words.begin(), words.end(), value.get<std::string>()) != words.end();
  });
  if (places.empty()) return false;
  Json& value = document[places[below(places.size(), generator)]];
  value = value.is_number() ? another_number(value.get<double>(), generator)
                            : Json(at_its_edge(value.get<std::string>(), generator));
  return true;
}

}  // namespace

void mutate_document(Json& document, Generator& generator) {
  std::vector<Json::json_pointer> places;
  collect_places(document, Json::json_pointer(), places);
  if (places.empty()) return;
  if (below(2, generator) == 0 && change_in_kind(document, places, generator)) return;
  const Json::json_pointer& place = places[below(places.size(), generator)];
  const Json value = document[place];
  Json& parent = document[place.parent_pointer()];
  switch (below(9, generator)) {
    case 0:
      if (parent.is_array())
        parent.erase(static_cast<std::size_t>(std::stoul(place.back())));
      else
        parent.erase(place.back());
      return;
    case 1:
      if (parent.is_array())
        parent.push_back(value);
      else
        parent[damaged(place.back(), generator)] = value;
      return;
    case 2: {
      const Json other = document[places[below(places.size(), generator)]];
      document[place] = other;
      return;
    }
    case 4:  // a key, of a parameter, an observable, …
      if (!parent.is_object()) break;
      parent.erase(place.back());
      parent[with_code(place.back(), generator)] = value;
      return;
    case 3:  // what stands under one key comes under another one
      if (!parent.is_object()) break;
      parent.erase(place.back());
      parent[any(vocabulary().keys, generator)] = value;
      return;
    default:
      break;
  }
  document[place] = changed(value, generator);
}

}  // namespace courant::fuzz
