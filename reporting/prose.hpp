// Prose: a sentence with formulas in it.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace courant {

// What a terminal prints as it stands, and a page sets as mathematics where a part is a formula or an equation
// in the language of experiments. A text converts to it.
class Prose {
 public:
  struct Part {
    std::string text;
    bool is_formula = false;
  };

  Prose() = default;
  Prose(const char* text) : Prose(std::string(text)) {}  // NOLINT(google-explicit-constructor)
  Prose(std::string text)
      : parts_{{std::move(text), false}} {}  // NOLINT(google-explicit-constructor)
  static Prose formula(std::string text) {
    Prose result;
    result.parts_.push_back({std::move(text), true});
    return result;
  }

  const std::vector<Part>& parts() const { return parts_; }
  // As plain text.
  std::string str() const {
    std::string all;
    for (const Part& part : parts_) all += part.text;
    return all;
  }

  Prose& operator+=(const Prose& more) {
    parts_.insert(parts_.end(), more.parts_.begin(), more.parts_.end());
    return *this;
  }
  friend Prose operator+(Prose first, const Prose& second) { return std::move(first += second); }

 private:
  std::vector<Part> parts_;
};

}  // namespace courant
