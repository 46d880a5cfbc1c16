// Registry: the kinds that the `type` of a JSON object chooses from.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/reading/json_reader.hpp"

namespace courant {

// What a catalogue says of a kind.
struct KindDescription {
  std::string type;
  std::string summary;  // one line
};

// The kinds of one noun ("manifold", "method"), each with the function that reads its other keys
// and makes the object. Where an object has no other keys, its type alone is short for it:
// "midpoint" for
// {"type": "midpoint"}.
template <class Product, class... Arguments>
class Registry {
 public:
  using Read = std::function<std::optional<Product>(ObjectReader&, const Arguments&...)>;
  struct Kind {
    KindDescription description;
    Read read;
  };

  explicit Registry(std::vector<Kind> kinds) : kinds_(std::move(kinds)) {}

  // The value of a key that may be missing, or `otherwise`.
  std::optional<Product> read(ObjectReader& object, const std::string& key, const Json& otherwise,
                              const Arguments&... arguments) const {
    if (const auto given = object.optional(key)) return read(*given, arguments...);
    object.default_value(key, otherwise);
    const std::string pointer = object.place().pointer() + "/" + key;
    return read(JsonReader(otherwise, pointer, object.place().findings()), arguments...);
  }

  // Nothing, and a problem in the findings, if the value does not describe one.
  std::optional<Product> read(const JsonReader& value, const Arguments&... arguments) const {
    if (value.value().is_string()) {
      const Json object{{"type", value.value()}};
      value.findings().default_value(value.pointer(), object);
      const Kind* kind = find(value);
      if (!kind) return std::nullopt;
      ObjectReader reader(JsonReader(object, value.pointer(), value.findings()), {"type"});
      return kind->read(reader, arguments...);
    }
    ObjectReader reader(value);
    const auto type = reader.required("type");
    const Kind* kind = type ? find(*type) : nullptr;
    if (!kind) {
      if (value.value().is_object())  // what else may be there is not known
        for (const auto& [key, entry] : value.value().items()) reader.optional(key);
      return std::nullopt;
    }
    return kind->read(reader, arguments...);
  }

  std::vector<KindDescription> descriptions() const {
    std::vector<KindDescription> list;
    for (const Kind& kind : kinds_) list.push_back(kind.description);
    return list;
  }

 private:
  const Kind* find(const JsonReader& type) const {
    std::vector<std::string> types;
    for (const Kind& kind : kinds_) types.push_back(kind.description.type);
    const auto word = type.word(types);
    if (!word) return nullptr;
    for (const Kind& kind : kinds_)
      if (kind.description.type == *word) return &kind;
    return nullptr;
  }

  std::vector<Kind> kinds_;
};

}  // namespace courant
