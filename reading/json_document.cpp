#include "courant/reading/json_document.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "courant/core/words/text_layout.hpp"
#include "courant/reading/json_reader.hpp"

namespace courant {
namespace {

constexpr std::size_t kDeepest = 100;  // beyond this nothing that means an experiment is nested

// "line 3, column 7" of the byte `position`, counted from 0.
std::string place(std::string_view text, std::size_t position) {
  const std::string_view before = text.substr(0, std::min(position, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string_view last_line = before.substr(before.rfind('\n') + 1);
  const std::size_t column = text_width(last_line) + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

// The reason in the words of the JSON library, without its prefix `[json.exception…] parse error at
// line 1, column 2: syntax error while parsing value - `.
std::string reason(std::string_view what, bool at_end) {
  if (at_end) return "the text ends too soon: it is not complete JSON";
  for (const std::string_view prefix_ends : {"] ", " - "})
    if (const std::size_t end = what.find(prefix_ends); end != std::string_view::npos)
      what.remove_prefix(end + prefix_ends.size());
  return "is not JSON: " + std::string(what);
}

// Builds the document and refuses keys that repeat, which the library would pass over.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  // What is no JSON: told among the problems, or thrown as the JSON library has it.
  enum class Errors { told, thrown };
  Builder(std::string_view text, Errors errors) : text_(text), errors_(errors) {}

  Json document;
  std::vector<Problem> problems;

  bool null() override { return leaf(nullptr); }
  bool boolean(bool value) override { return leaf(value); }
  bool number_integer(number_integer_t value) override { return leaf(value); }
  bool number_unsigned(number_unsigned_t value) override { return leaf(value); }
  bool number_float(number_float_t value, const string_t&) override { return leaf(value); }
  bool string(string_t& value) override { return leaf(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // not in a text
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    if (errors_ == Errors::told && !level.keys.insert(name).second)
      problems.push_back({level.pointer + "/" + pointer_token(name), "is there twice"});
    key_ = std::move(name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    if (errors_ == Errors::thrown)
      if (const auto* malformed = dynamic_cast<const nlohmann::detail::parse_error*>(&error))
        throw *malformed;
    // The position counts from 1 and is that of the last byte read, one past the end if there was
    // none.
    const std::size_t byte = position == 0 ? 0 : position - 1;
    problems.push_back({place(text_, byte), reason(error.what(), position > text_.size())});
    return false;
  }

 private:
  // An object or an array that is not complete. (Kept outside its parent until it is, because the
  // entries of an ordered object move when others are added.)
  struct Level {
    Json value;
    std::string pointer;
    std::string key;                            // in its parent
    std::unordered_set<std::string> keys = {};  // the object itself searches in order
  };

  bool leaf(Json value) {
    attach(std::move(value), key_);
    return true;
  }
  bool open(Json value) {
    if (levels_.size() == kDeepest) {
      problems.push_back({levels_.back().pointer,
                          "is nested deeper than " + std::to_string(kDeepest) + " levels"});
      return false;
    }
    std::string pointer;
    if (!levels_.empty()) {
      const Level& parent = levels_.back();
      const bool in_array = parent.value.is_array();
      pointer = parent.pointer + "/" +
                (in_array ? std::to_string(parent.value.size()) : pointer_token(key_));
    }
    levels_.push_back({std::move(value), std::move(pointer), std::move(key_)});
    return true;
  }
  bool close() {
    Level level = std::move(levels_.back());
    levels_.pop_back();
    attach(std::move(level.value), level.key);
    return true;
  }
  void attach(Json value, const std::string& key) {
    if (levels_.empty())
      document = std::move(value);
    else if (Json& parent = levels_.back().value; parent.is_array())
      parent.push_back(std::move(value));
    else
      append_member(parent, key, std::move(value));
  }

  std::string_view text_;
  Errors errors_;
  std::vector<Level> levels_;
  std::string key_;
};

}  // namespace

Json parse_json(std::string_view text) {
  Builder builder(text, Builder::Errors::told);
  Json::sax_parse(text, &builder);
  if (!builder.problems.empty()) throw ExperimentError(std::move(builder.problems));
  return std::move(builder.document);
}

Json parse_written_json(std::string_view text) {
  Builder builder(text, Builder::Errors::thrown);
  Json::sax_parse(text, &builder);
  if (!builder.problems.empty()) {
    const Problem& problem = builder.problems.front();
    throw std::invalid_argument(problem.where + " " + problem.what + ".");
  }
  return std::move(builder.document);
}

void append_member(Json& object, std::string name, Json value) {
  auto& members = object.get_ref<Json::object_t&>();
  static_cast<Json::object_t::Container&>(members).emplace_back(std::move(name), std::move(value));
}

}  // namespace courant
