// Registry: the kinds that the `type` of a JSON object chooses from.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "courant/reading/json_reader.hpp"

namespace courant {

// The kinds of one noun ("manifold", "method"), each with its declaration and the function that
// reads its keys and makes the object. Where an object has no other keys, its type alone is short
// for it: "midpoint" for
//
//   {"type": "midpoint"}
template <class Product, class... Arguments>
class Registry {
 public:
  using Read = std::function<std::optional<Product>(ObjectReader&, const Arguments&...)>;
  struct Kind {
    KindDescription description;
    Read read;
  };

  explicit Registry(std::vector<Kind> kinds) : kinds_(std::move(kinds)) {}

  // One more kind, from now on as good as those that were always there: before the first
  // experiment is read, and from one thread. Throws std::invalid_argument if the type is taken.
  void add(Kind kind) {
    for (const Kind& known : kinds_)
      if (known.description.type == kind.description.type)
        throw std::invalid_argument("Registry::add: there is a kind \"" + kind.description.type +
                                    "\" already; expected another type.");
    kinds_.push_back(std::move(kind));
  }

  // The value of a key that may be missing, or its declared default, or `otherwise`.
  std::optional<Product> read_key(ObjectReader& object, const std::string& key,
                                  const Arguments&... arguments) const {
    return read(object, key, object.declared_default(key), arguments...);
  }
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
      return made(*kind, JsonReader(object, value.pointer(), value.findings()), arguments...);
    }
    if (!value.value().is_object()) {
      value.expected("an object");
      return std::nullopt;
    }
    const auto type = value.value().find("type");
    const std::string pointer = value.pointer() + "/type";
    if (type == value.value().end()) {
      value.findings().problem(pointer, "is missing");
      return std::nullopt;
    }
    const Kind* kind = find(JsonReader(*type, pointer, value.findings()));
    return kind ? made(*kind, value, arguments...) : std::nullopt;
  }

  std::vector<KindDescription> descriptions() const {
    std::vector<KindDescription> list;
    for (const Kind& kind : kinds_) list.push_back(kind.description);
    return list;
  }

 private:
  static std::optional<Product> made(const Kind& kind, const JsonReader& object,
                                     const Arguments&... arguments) {
    ObjectReader reader(object, kind.description);
    try {
      auto product = kind.read(reader, arguments...);
      if (product) reader.require_all_read();
      return product;
    } catch (const std::exception&) {
      object.refused();
      return std::nullopt;
    }
  }

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
