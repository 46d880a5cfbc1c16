#include "courant/reading/unused_parameters.hpp"

#include <cctype>
#include <map>
#include <set>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/reading/json_reader.hpp"

namespace courant {
namespace {

struct NamedParameter {
  std::string name, pointer;
  std::string place() const { return pointer.substr(0, pointer.rfind('/')); }
};

// What an experiment says, as words, and the parameters that it has.
class Words {
 public:
  explicit Words(const Json& document) {
    if (!document.is_object()) return;
    for (const auto& [key, value] : document.items())
      if (key != "title" && key != "description" && !is_comment(key))
        read(value, "/" + pointer_token(key));
    for (const NamedParameter& parameter : parameters_)
      if (words_.contains(parameter.name)) used_[parameter.place()].push_back(parameter.name);
  }

  std::vector<NamedParameter> unused() const {
    std::vector<NamedParameter> result;
    for (const NamedParameter& parameter : parameters_)
      if (!words_.contains(parameter.name)) result.push_back(parameter);
    return result;
  }
  // The other parameters of the same object that are used.
  std::vector<std::string> others(const NamedParameter& than) const {
    const auto found = used_.find(than.place());
    return found == used_.end() ? std::vector<std::string>() : found->second;
  }

 private:
  static bool is_comment(const std::string& key) { return key.starts_with("//"); }

  void read(const Json& value, const std::string& pointer) {
    if (value.is_string()) return take(value.get_ref<const std::string&>());
    if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i)
        read(value[i], pointer + "/" + std::to_string(i));
      return;
    }
    if (!value.is_object()) return;
    for (const auto& [key, entry] : value.items()) {
      if (is_comment(key)) continue;
      const std::string place = pointer + "/" + pointer_token(key);
      if (key == "parameters" && entry.is_object() && pointer.starts_with("/system")) {
        for (const auto& [name, formula] : entry.items()) {
          if (is_comment(name)) continue;
          parameters_.push_back({name, place + "/" + pointer_token(name)});
          read(formula, place);
        }
        continue;
      }
      take(key);
      read(entry, place);
    }
  }

  void take(const std::string& text) {
    const auto is_letter = [](char c) {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    const auto is_word = [&](char c) {
      return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
    };
    for (std::size_t i = 0; i < text.size();) {
      std::size_t end = i;
      while (end < text.size() && is_word(text[end])) ++end;
      if (end > i) words_.insert(text.substr(i, end - i));
      i = end + 1;
    }
  }

  std::set<std::string, std::less<>> words_;
  std::vector<NamedParameter> parameters_;
  std::map<std::string, std::vector<std::string>> used_;  // by the place of their object
};

std::string sentence(const NamedParameter& parameter, const Words& words) {
  return "nothing uses the parameter " + in_quotes(parameter.name) +
         did_you_mean(parameter.name, words.others(parameter));
}

}  // namespace

std::vector<Problem> unused_parameters(const Json& document) {
  const Words words(document);
  std::vector<Problem> problems;
  for (const NamedParameter& parameter : words.unused())
    problems.push_back({parameter.pointer, sentence(parameter, words)});
  return problems;
}

void require_used(const Json& document, std::span<const Setting> settings,
                  const std::string& option) {
  const Words words(document);
  for (const NamedParameter& parameter : words.unused())
    for (const Setting& setting : settings)
      if (setting.pointer == parameter.pointer ||
          setting.pointer.starts_with(parameter.pointer + "/"))
        throw ExperimentError(option + " " + setting.pointer,
                              sentence(parameter, words) + "; expected one that something uses");
}

}  // namespace courant
