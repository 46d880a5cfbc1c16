#include "courant/reading/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/core/words/text_layout.hpp"

namespace courant {
namespace {

constexpr std::size_t kLongestShown = 40;

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return value.empty() ? "an empty array" : "an array";
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= kLongestShown ? text : beginning(text, kLongestShown) + "…";
}

std::string alternatives(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i)
    list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + in_quotes(words[i]);
  return list;
}

}  // namespace

std::string pointer_token(std::string_view key) {
  std::string token;
  for (const char c : key) {
    if (c == '~')
      token += "~0";
    else if (c == '/')
      token += "~1";
    else
      token += c;
  }
  return token;
}

void JsonReader::expected(const std::string& expected) const {
  problem("is " + shown(*value_) + "; expected " + expected);
}

void JsonReader::refused() const {
  try {
    throw;
  } catch (const ExperimentError& error) {
    for (const Problem& found : error.problems()) findings_->problem(found.where, found.what);
  } catch (const std::invalid_argument& error) {
    problem(without_place(error.what()));
  } catch (const std::domain_error& error) {
    problem(without_place(error.what()));
  } catch (const std::runtime_error& error) {
    problem(without_place(error.what()));
  }
}

std::optional<double> JsonReader::number() const {
  if (value_->is_number()) return value_->get<double>();
  expected("a number");
  return std::nullopt;
}

std::optional<double> JsonReader::positive_number() const {
  if (value_->is_number() && value_->get<double>() > 0.0) return value_->get<double>();
  expected("a number greater than 0");
  return std::nullopt;
}

std::optional<Index> JsonReader::integer(Index least) const {
  // 2⁵³, as 1e6 is as good as 1000000, or what an Index holds: 32 bits in a browser.
  constexpr double greatest =
      std::min(9007199254740992.0, static_cast<double>(std::numeric_limits<Index>::max()));
  const double number = value_->is_number() ? value_->get<double>() : 0.5;
  const bool is_integer = number == std::floor(number);
  if (is_integer && number >= static_cast<double>(least) && std::abs(number) <= greatest)
    return static_cast<Index>(number);
  if (is_integer && number > greatest)
    expected("an integer, at most " + std::to_string(static_cast<Index>(greatest)));
  else
    expected("an integer, at least " + std::to_string(least));
  return std::nullopt;
}

std::optional<std::string> JsonReader::text() const {
  if (value_->is_string()) return value_->get<std::string>();
  expected("a string");
  return std::nullopt;
}

std::optional<std::vector<JsonReader>> JsonReader::elements() const {
  if (!value_->is_array()) {
    expected("an array");
    return std::nullopt;
  }
  std::vector<JsonReader> elements;
  for (std::size_t i = 0; i < value_->size(); ++i)
    elements.emplace_back((*value_)[i], pointer_ + "/" + std::to_string(i), *findings_);
  return elements;
}

std::optional<std::vector<std::pair<std::string, JsonReader>>> JsonReader::entries() const {
  if (!value_->is_object()) {
    expected("an object");
    return std::nullopt;
  }
  std::vector<std::pair<std::string, JsonReader>> entries;
  for (const auto& [key, value] : value_->items())
    entries.emplace_back(key, JsonReader(value, pointer_ + "/" + pointer_token(key), *findings_));
  return entries;
}

std::optional<std::string> JsonReader::word(const std::vector<std::string>& words) const {
  if (value_->is_string()) {
    const auto& word = value_->get_ref<const std::string&>();
    if (std::find(words.begin(), words.end(), word) != words.end()) return word;
    if (const std::string meant = did_you_mean(word, words); !meant.empty()) {
      problem("unknown " + in_quotes(word) + meant);
      return std::nullopt;
    }
  }
  expected(alternatives(words));
  return std::nullopt;
}

ObjectReader::ObjectReader(const JsonReader& object) : object_(object) {
  if (!object_.value().is_object()) object_.expected("an object");
}

ObjectReader::ObjectReader(const JsonReader& object, const KindDescription& kind)
    : ObjectReader(object) {
  kind_ = &kind;
  if (!kind.type.empty()) known_ = {"type"};
  for (const Key& key : kind.keys) known_.push_back(key.name);
}

const Key* ObjectReader::declared(const std::string& key) const {
  if (!kind_ || (key == "type" && !kind_->type.empty())) return nullptr;
  if (const Key* found = kind_->find(key)) return found;
  throw std::logic_error("the kind " + in_quotes(kind_->type) + " reads the key " + in_quotes(key) +
                         ", which it does not declare");
}

void ObjectReader::require_all_read() const {
  if (!kind_ || !object_.value().is_object()) return;
  for (const Key& key : kind_->keys)
    if (object_.value().contains(key.name) &&
        std::find(asked_.begin(), asked_.end(), key.name) == asked_.end())
      throw std::logic_error("the kind " + in_quotes(kind_->type) + " declares the key " +
                             in_quotes(key.name) + " and does not read it");
}

const Json& ObjectReader::declared_default(const std::string& key) const {
  const Key* known = declared(key);
  if (!known || known->otherwise.is_null())
    throw std::logic_error("the key " + in_quotes(key) + " is declared without a default");
  return known->otherwise;
}

bool ObjectReader::is_required(const std::string& key) const {
  const Key* known = declared(key);
  return known && known->required;
}

ObjectReader::~ObjectReader() {
  if (!object_.value().is_object()) return;
  constexpr int most = 20;
  int unknown = 0;
  for (const auto& [key, value] : object_.value().items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    if (++unknown > most) continue;
    const std::string meant = did_you_mean(key, known_);
    object_.findings().problem(
        object_.pointer() + "/" + pointer_token(key),
        "unknown key" + (meant.empty() ? "; expected " + alternatives(known_) : meant));
  }
  if (unknown > most)
    object_.problem("has " + std::to_string(unknown - most) + " more unknown keys");
}

std::optional<JsonReader> ObjectReader::optional(const std::string& key) {
  const Key* known = declared(key);
  const bool again = std::find(asked_.begin(), asked_.end(), key) != asked_.end();
  asked_.push_back(key);
  if (!kind_) known_.push_back(key);
  if (!object_.value().is_object()) return std::nullopt;
  const std::string pointer = object_.pointer() + "/" + pointer_token(key);
  const auto found = object_.value().find(key);
  if (found != object_.value().end()) return JsonReader(*found, pointer, object_.findings());
  if (known && known->required && !again) object_.findings().problem(pointer, "is missing");
  return std::nullopt;
}

std::optional<JsonReader> ObjectReader::required(const std::string& key) {
  const Key* known = declared(key);
  auto value = optional(key);
  if (!value && object_.value().is_object() && !(known && known->required))
    object_.findings().problem(object_.pointer() + "/" + pointer_token(key), "is missing");
  return value;
}

void ObjectReader::default_value(const std::string& key, Json value) {
  object_.findings().default_value(object_.pointer() + "/" + pointer_token(key), std::move(value));
}

double ObjectReader::number(const std::string& key, double value) {
  if (const auto given = optional(key)) return given->number().value_or(value);
  default_value(key, value);
  return value;
}

Index ObjectReader::integer(const std::string& key, Index value, Index least) {
  if (const auto given = optional(key)) return given->integer(least).value_or(value);
  default_value(key, value);
  return value;
}

std::string ObjectReader::text(const std::string& key, const std::string& value) {
  if (const auto given = optional(key)) return given->text().value_or(value);
  default_value(key, value);
  return value;
}

std::string ObjectReader::word(const std::string& key, const std::string& value,
                               const std::vector<std::string>& words) {
  if (const auto given = optional(key)) return given->word(words).value_or(value);
  default_value(key, value);
  return value;
}

double ObjectReader::number(const std::string& key) {
  const double otherwise = declared_default(key).get<double>();
  const auto given = optional(key);
  if (!given) {
    default_value(key, otherwise);
    return otherwise;
  }
  const auto value = given->number();
  if (!value) return otherwise;
  const Takes& takes = declared(key)->takes;
  if (*value >= takes.schema.value("minimum", -INFINITY) &&
      *value <= takes.schema.value("maximum", INFINITY))
    return *value;
  given->expected(takes.text);
  return otherwise;
}

Index ObjectReader::integer(const std::string& key) {
  const auto otherwise = declared_default(key).get<Index>();
  return integer(key, otherwise, declared(key)->takes.schema.at("minimum").get<Index>());
}

std::string ObjectReader::word(const std::string& key) {
  return word(key, declared_default(key).get<std::string>(), declared(key)->takes.words);
}

std::string ObjectReader::text(const std::string& key) {
  return text(key, declared_default(key).get<std::string>());
}

}  // namespace courant
