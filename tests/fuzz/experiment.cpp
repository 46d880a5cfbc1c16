// Experiments: whole commands with any text as an experiment.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "answer.hpp"
#include "long_number.hpp"

namespace courant::fuzz {

namespace {

using Json = nlohmann::ordered_json;
using Generator = std::mt19937;

std::size_t below(std::size_t bound, Generator& generator) {
  return std::uniform_int_distribution<std::size_t>(0, bound - 1)(generator);
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
  if (value.is_string() && below(3, generator) != 0) return damaged(value, generator);
  if (value.is_number() && below(3, generator) != 0) {
    const double number = value.get<double>();
    return std::array<Json, 6>{
        0, -number, 2 * number, 1e-9 * number, 1e9 * number, number + 1}[below(6, generator)];
  }
  return others[below(others.size(), generator)];
}

// Systems of thousands of repeated elements take minutes with the sanitizers, and find nothing that a few
// do not.
bool repeats_often(const std::string& text) {
  if (text.find("\"repeat\"") == std::string::npos) return false;
  std::size_t digits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_digit = text[i] >= '0' && text[i] <= '9';
    if (text[i] == 'e' && digits > 0) return true;
    digits = is_digit ? digits + 1 : 0;
    if (digits > 2) return true;
  }
  return false;
}

// Half a million terms take some 20 s with the sanitizers before the command looks at its alarm.
bool has_long_sum(const std::string& text) {
  return text.find("sum(") != std::string::npos && has_long_number(text);
}

// One value of the document is changed, left out, doubled, renamed, or replaced by another one.
void mutate_document(Json& document, Generator& generator) {
  std::vector<Json::json_pointer> places;
  collect_places(document, Json::json_pointer(), places);
  if (places.empty()) return;
  const Json::json_pointer& place = places[below(places.size(), generator)];
  const Json value = document[place];
  Json& parent = document[place.parent_pointer()];
  switch (below(6, generator)) {
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
    default:
      document[place] = changed(value, generator);
  }
}

}  // namespace

}  // namespace courant::fuzz

// Half of the executions change the document rather than its letters, so that they come farther.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  using courant::fuzz::Json;
  courant::fuzz::Generator generator(seed);
  Json document = Json::parse(data, data + size, nullptr, false);
  if (document.is_discarded() || courant::fuzz::below(4, generator) == 0)
    return LLVMFuzzerMutate(data, size, most);
  for (std::size_t count = 1 + courant::fuzz::below(3, generator); count > 0; --count)
    courant::fuzz::mutate_document(document, generator);
  const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string folder = courant::fuzz::empty_folder();
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (courant::fuzz::repeats_often(text) || courant::fuzz::has_long_sum(text)) return 0;
  // Which command it is depends on the text, so that a text that fails fails again.
  const std::vector<std::vector<std::string>> commands = {
      {"run", "-", "--quiet", "--force", "--backend", "interpreter", "-o", folder + "/run"},
      {"run", "-", "--quiet", "--force", "--backend", "interpreter", "-o", folder + "/run"},
      {"constraints", "-"},
      {"export", "-", "--language", "c", "-o", folder + "/program.c"},
      {"check", "-", "--brief"}};
  // Laws of a large system take seconds with the sanitizers, and nothing stops them.
  constexpr std::size_t longest_checked = 1000;
  const std::size_t kinds = commands.size() - (size > longest_checked ? 1 : 0);
  courant::fuzz::require_answer(commands[std::hash<std::string>()(text) % kinds], text);
  return 0;
}
