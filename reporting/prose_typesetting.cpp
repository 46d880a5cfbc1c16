#include "courant/reporting/prose_typesetting.hpp"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "courant/reporting/formula_typesetting.hpp"
#include "courant/reporting/typesetting.hpp"

namespace courant {

using plot::element;
using plot::Markup;

Prose marked_prose(std::string_view text) {
  Prose prose;
  for (bool is_formula = false;; is_formula = !is_formula) {
    const std::size_t end = std::min(text.find('$'), text.size());
    const std::string part(text.substr(0, end));
    if (!part.empty()) prose += is_formula ? Prose::formula(part) : Prose(part);
    if (end == text.size()) return prose;
    text.remove_prefix(end + 1);
  }
}

Markup typeset_prose(const Prose& prose) {
  Markup all;
  for (const Prose::Part& part : prose.parts())
    all += part.is_formula ? math(part.text) : typeset(part.text);
  return all;
}

Markup displayed_prose(const Prose& prose) {
  Markup all;
  for (const Prose::Part& part : prose.parts())
    all += part.is_formula ? displayed_math(part.text) : typeset(part.text);
  return element("div", {{"class", "displayed"}}, all);
}

std::string latex_sentence(std::string_view text) {
  static const std::vector<std::pair<std::string_view, std::string_view>> characters = {
      {"₀", "\\ensuremath{_0}"},
      {"₁", "\\ensuremath{_1}"},
      {"₂", "\\ensuremath{_2}"},
      {"₃", "\\ensuremath{_3}"},
      {"₄", "\\ensuremath{_4}"},
      {"₅", "\\ensuremath{_5}"},
      {"₆", "\\ensuremath{_6}"},
      {"₇", "\\ensuremath{_7}"},
      {"₈", "\\ensuremath{_8}"},
      {"₉", "\\ensuremath{_9}"},
      {"⊇", "\\ensuremath{\\supseteq}"},
      {"⊂", "\\ensuremath{\\subset}"},
      {"∩", "\\ensuremath{\\cap}"},
      {"∈", "\\ensuremath{\\in}"},
      {"→", "\\ensuremath{\\to}"},
      {"∅", "\\ensuremath{\\emptyset}"},
      {"∂", "\\ensuremath{\\partial}"},
      {"𝓛", "\\ensuremath{\\mathcal L}"},
      {"λ", "\\ensuremath{\\lambda}"},
      {"φ", "\\ensuremath{\\phi}"},
      {"ω", "\\ensuremath{\\omega}"},
      {"τ", "\\ensuremath{\\tau}"},
      {"ε", "\\ensuremath{\\varepsilon}"},
      {"δ", "\\ensuremath{\\delta}"},
      {"Λ", "\\ensuremath{\\Lambda}"},
      {"ℝ", "\\ensuremath{\\mathbb R}"},
      {"×", "\\ensuremath{\\times}"},
      {"±", "\\ensuremath{\\pm}"},
      {"·", "\\ensuremath{\\cdot}"},
      {"√", "\\ensuremath{\\surd}"},
      {"≥", "\\ensuremath{\\ge}"},
      {"≤", "\\ensuremath{\\le}"},
      {"⁻", "\\ensuremath{^{-}}"},
      {"°", "\\ensuremath{^\\circ}"},
      {"¹", "\\ensuremath{^1}"},
      {"⁴", "\\ensuremath{^4}"},
      {"⁵", "\\ensuremath{^5}"},
      {"⁶", "\\ensuremath{^6}"},
      {"⁷", "\\ensuremath{^7}"},
      {"⁸", "\\ensuremath{^8}"},
      {"⁹", "\\ensuremath{^9}"},
      {"⁰", "\\ensuremath{^0}"},
      {"²", "\\ensuremath{^2}"},
      {"³", "\\ensuremath{^3}"},
      {"…", "\\dots{}"},
      {"–", "--"},
      {"—", "---"},
      {"\u00a0", "~"}};
  std::string result;
  while (!text.empty()) {
    const auto found =
        std::ranges::find_if(characters, [&](const auto& c) { return text.starts_with(c.first); });
    if (found != characters.end()) {
      result += found->second;
      text.remove_prefix(found->first.size());
      continue;
    }
    // M_f, S_{k+1}.
    if (text[0] == '_' && text.size() > 1 && !result.empty()) {
      const std::size_t close = text.find('}');
      const bool braced = text[1] == '{' && close != std::string_view::npos;
      const std::size_t size = character_size(text.substr(1));
      const std::string_view below = braced ? text.substr(2, close - 2) : text.substr(1, size);
      result += "\\ensuremath{_{" + latex_sentence(below) + "}}";
      text.remove_prefix(braced ? close + 1 : 1 + size);
      continue;
    }
    // The sets S_k and M_k.
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    if ((text[0] == 'M' || text[0] == 'S') && (text.size() == 1 || !is_letter(text[1])) &&
        (result.empty() || !is_letter(result.back()))) {
      result += "\\ensuremath{" + std::string(text.substr(0, 1)) + "}";
      text.remove_prefix(1);
      continue;
    }
    // A letter that is not known here stays, for a LaTeX that reads UTF-8.
    const std::size_t size = character_size(text);
    result += latex_text(text.substr(0, size));
    text.remove_prefix(size);
  }
  return result;
}

std::string latex_prose(const Prose& prose) {
  std::string all;
  for (const Prose::Part& part : prose.parts())
    all += part.is_formula ? "$" + latex_math(part.text) + "$" : latex_sentence(part.text);
  return all;
}

std::string markdown_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("\\`*_{}[]<>#|$").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string markdown_prose(const Prose& prose) {
  std::string all;
  for (const Prose::Part& part : prose.parts())
    all += part.is_formula ? "$" + latex_math(part.text) + "$" : markdown_text(part.text);
  return all;
}

}  // namespace courant
