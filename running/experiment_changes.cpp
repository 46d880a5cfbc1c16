#include "courant/running/experiment_changes.hpp"

#include <algorithm>
#include <string>

#include "courant/core/words/text_layout.hpp"
#include "courant/reading/json_reader.hpp"

namespace courant {
namespace {

std::string in_short(const Json& value) {
  constexpr std::size_t most = 40;
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= most ? text : beginning(text, most) + "…";
}

bool is_free(const std::string& pointer) { return pointer == "/time/end" || pointer == "/$run"; }

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> found;
  for (const auto& [key, value] : object.items()) found.push_back(key);
  return found;
}

void compare(const Json& begun, const Json& now, const std::string& pointer,
             std::vector<Problem>& changes);

void compare_objects(const Json& begun, const Json& now, const std::string& pointer,
                     std::vector<Problem>& changes) {
  const std::size_t before = changes.size();
  const auto place = [&](const std::string& key) { return pointer + '/' + pointer_token(key); };
  for (const auto& [key, value] : now.items()) {
    if (is_free(place(key))) continue;
    if (begun.contains(key))
      compare(begun.at(key), value, place(key), changes);
    else
      changes.push_back({place(key), "is " + in_short(value) + "; the run was begun without it"});
  }
  for (const auto& [key, value] : begun.items())
    if (!is_free(place(key)) && !now.contains(key))
      changes.push_back({place(key), "is missing; the run was begun with " + in_short(value)});
  if (!pointer.empty() && changes.size() == before && keys(begun) != keys(now))
    changes.push_back({pointer, "has its keys in another order than the run was begun with"});
}

void compare(const Json& begun, const Json& now, const std::string& pointer,
             std::vector<Problem>& changes) {
  if (begun.is_object() && now.is_object()) {
    compare_objects(begun, now, pointer, changes);
  } else if (begun.is_array() && now.is_array() && begun.size() == now.size()) {
    for (std::size_t i = 0; i < now.size(); ++i)
      compare(begun[i], now[i], pointer + '/' + std::to_string(i), changes);
  } else if (begun != now) {
    changes.push_back(
        {pointer, "is " + in_short(now) + "; the run was begun with " + in_short(begun)});
  }
}

}  // namespace

std::vector<Problem> experiment_changes(const Json& begun, const Json& now) {
  std::vector<Problem> changes;
  compare(begun, now, "", changes);
  return changes;
}

}  // namespace courant
