// Typed reading of a JSON document: every problem is collected, with its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/reading/findings.hpp"
#include "courant/reading/kind.hpp"

namespace courant {

// A key as a part of a JSON pointer: ~ and / are written ~0 and ~1.
std::string pointer_token(std::string_view key);

// A value in a document, with its JSON pointer. What is not as it should be becomes a problem of
// the findings, and the reading functions then return nothing. Cheap to copy; the document and the
// findings must outlive it.
class JsonReader {
 public:
  JsonReader(const Json& value, std::string pointer, Findings& findings)
      : value_(&value), pointer_(std::move(pointer)), findings_(&findings) {}

  const Json& value() const { return *value_; }
  const std::string& pointer() const { return pointer_; }
  Findings& findings() const { return *findings_; }

  // Adds the problem `what` at the pointer of this value. It is a sentence without its subject: "is negative".
  void problem(std::string what) const { findings_->problem(pointer_, std::move(what)); }
  // The problem `is <the value>; expected <expected>`.
  void expected(const std::string& expected) const;
  // In a catch clause: what was refused by a function that knows nothing of documents becomes a
  // problem here. Rethrows what is a fault of the program.
  void refused() const;

  // The value as what is asked for; a problem, and nothing, if it is something else: a number, one above 0, a
  // whole one of at least `least`, a text, the elements of an array.
  std::optional<double> number() const;
  std::optional<double> positive_number() const;
  std::optional<Index> integer(Index least) const;
  std::optional<std::string> text() const;
  std::optional<std::vector<JsonReader>> elements() const;
  // The entries of an object whose keys are free, in order.
  std::optional<std::vector<std::pair<std::string, JsonReader>>> entries() const;
  // A text that is one of a few words.
  std::optional<std::string> word(const std::vector<std::string>& words) const;

 private:
  const Json* value_;
  std::string pointer_;
  Findings* findings_;
};

// An object with known keys: those of a declaration or, where there is none, those that are asked
// for. When it goes out of scope, every other key is a problem, with the known key that may have
// been meant.
class ObjectReader {
 public:
  // A problem, and no keys, if the value is not an object.
  explicit ObjectReader(const JsonReader& object);
  // Of a kind, which must outlive the reader. Asking for a key that it does not declare is a
  // std::logic_error.
  ObjectReader(const JsonReader& object, const KindDescription& kind);
  ~ObjectReader();
  ObjectReader(const ObjectReader&) = delete;
  ObjectReader& operator=(const ObjectReader&) = delete;

  const JsonReader& place() const { return object_; }

  // Nothing if the key is missing. That is a problem for `required`, and for a key that the kind
  // declares as required.
  std::optional<JsonReader> optional(const std::string& key);
  std::optional<JsonReader> required(const std::string& key);

  // The key is missing and stands for `value`, which the findings keep.
  void default_value(const std::string& key, Json value);

  // The value of a key that may be missing, or `value` as above.
  double number(const std::string& key, double value);
  Index integer(const std::string& key, Index value, Index least);
  std::string text(const std::string& key, const std::string& value);
  std::string word(const std::string& key, const std::string& value,
                   const std::vector<std::string>& words);

  // The value of a key of a kind that declares it with a default, and a number with the least and
  // the greatest it may be, an integer with the least, a word with what else it may be, a text. The default
  // too if the value is not that, which is a problem.
  double number(const std::string& key);
  Index integer(const std::string& key);
  std::string word(const std::string& key);
  std::string text(const std::string& key);
  const Json& declared_default(const std::string& key) const;
  bool is_required(const std::string& key) const;  // by the kind

  // Throws std::logic_error if the object has a key that the kind declares and that nobody asked
  // for.
  void require_all_read() const;

 private:
  const Key* declared(const std::string& key) const;

  JsonReader object_;
  const KindDescription* kind_ = nullptr;
  std::vector<std::string> known_;
  std::vector<std::string> asked_;
};

}  // namespace courant
