#include "courant/extensions/importing/different_names.hpp"

#include <cctype>

namespace courant {

std::string identifier(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_last = i + 1 == text.size() && i > 0;
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      result += c;
    else if (is_last && (c == '+' || c == '-'))
      result += c == '+' ? "_plus" : "_minus";
    else
      result += '_';
  }
  return result;
}

const std::string& DifferentNames::of(const std::string& written) {
  const auto [known, is_new] = names_.try_emplace(written);
  if (!is_new) return known->second;
  const std::string name = identifier(written);
  std::string different = name;
  for (int i = 2; different != written && taken_.contains(different); ++i)
    different = name + "_" + std::to_string(i);
  taken_.insert(different);
  return known->second = different;
}

}  // namespace courant
