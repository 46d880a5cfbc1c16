#include "courant/reporting/typesetting.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace courant {

namespace {

using plot::element;
using plot::Markup;

constexpr std::size_t deepest = 16;  // no manifold is deeper; a file of a run may be

// "Name(argument, …)" at the beginning of a text.
struct Call {
  std::string_view name;
  std::vector<std::string_view> arguments;
  std::size_t size;
};

// Whether it begins with one of α to ω.
bool is_greek(std::string_view text) {
  return text.size() > 1 &&
         ((text[0] == '\xCE' && text[1] >= '\xB1') || (text[0] == '\xCF' && text[1] <= '\x89'));
}

std::size_t word_size(std::string_view text) {
  std::size_t size = 0;
  while (size < text.size() && std::isalnum(static_cast<unsigned char>(text[size])) != 0) ++size;
  return size;
}

std::optional<Call> call_at(std::string_view text) {
  const std::size_t name = word_size(text);
  if (name == 0 || name == text.size() || text[name] != '(') return std::nullopt;
  Call call{text.substr(0, name), {}, 0};
  std::size_t begin = name + 1;
  for (std::size_t depth = 1, at = begin; at < text.size(); ++at) {
    if (text[at] == '(' && ++depth > deepest) return std::nullopt;
    if (text[at] == ')') --depth;
    const bool ends = depth == 0;
    if (!ends && !(depth == 1 && text.substr(at).starts_with(", "))) continue;
    call.arguments.push_back(text.substr(begin, at - begin));
    begin = at + 2;
    if (!ends) continue;
    call.size = at + 1;
    return call;
  }
  return std::nullopt;
}

Markup power(const Markup& base, std::string_view exponent) {
  return exponent == "1" ? base : base + element("sup", {}, exponent);
}

std::optional<Markup> manifold(const Call& call) {
  const Markup T = element("i", {}, "T");
  const auto fibres = [&](const Markup& bundle) {
    const bool simple = !call.arguments[0].starts_with("Product(");
    const Markup base = typeset_manifolds(call.arguments[0]);
    return bundle + (simple ? base : Markup("(") + base + ")");
  };
  const std::string_view first = call.arguments[0];
  if (call.name == "CotangentBundle") return fibres(T + "*");
  if (call.name == "TangentBundle") return fibres(T);
  if (call.name == "Euclidean") return power("ℝ", first);
  if (call.name == "Sphere") return element("i", {}, "S") + element("sup", {}, first);
  if (call.name == "Torus") return element("i", {}, "T") + element("sup", {}, first);
  if (call.name == "Hyperbolic") return element("i", {}, "H") + element("sup", {}, first);
  if (call.name == "SpecialOrthogonal3") return Markup("SO(3)");
  if (call.name == "SpecialEuclidean3") return Markup("SE(3)");
  if (call.name == "SpecialOrthogonal") return Markup("SO(") + first + ")";
  if (call.name != "Product") return std::nullopt;
  Markup factors;
  for (const std::string_view argument : call.arguments)
    factors += (factors.str().empty() ? Markup() : Markup(" × ")) + typeset_manifolds(argument);
  return factors;
}

}  // namespace

std::size_t character_size(std::string_view text) {
  std::size_t size = std::min<std::size_t>(1, text.size());
  while (size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80) ++size;
  return size;
}

Markup typeset(std::string_view text) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  Markup markup;
  while (!text.empty()) {
    std::size_t size = 1;
    if (letter(text[0])) {
      while (size < text.size() && letter(text[size])) ++size;
      const std::string_view word = text.substr(0, size);
      const bool symbol = (size == 1 && word != "a") || word == "TM";
      markup += symbol ? element("i", {}, word) : Markup(word);
    } else if (text[0] == '_') {
      const bool braced = text.starts_with("_{") && text.find('}') != std::string_view::npos;
      size = braced ? text.find('}') + 1 : 1 + character_size(text.substr(1));
      markup +=
          element("sub", {}, typeset(braced ? text.substr(2, size - 3) : text.substr(1, size - 1)));
    } else if (is_greek(text)) {
      // Fonts for words need not have these letters, those for formulas do.
      size = 2;
      markup += element("math", {}, element("mi", {}, text.substr(0, size)));
    } else {
      while (size < text.size() && text[size] != '_' && !letter(text[size]) &&
             !is_greek(text.substr(size)))
        ++size;
      markup += text.substr(0, size);
    }
    text.remove_prefix(size);
  }
  return markup;
}

Markup typeset_manifolds(std::string_view text) {
  Markup markup;
  while (!text.empty()) {
    if (const auto call = call_at(text)) {
      if (const auto set = manifold(*call)) {
        markup += *set;
        text.remove_prefix(call->size);
        continue;
      }
    }
    const std::size_t size = std::max<std::size_t>(1, word_size(text));
    markup += text.substr(0, size);
    text.remove_prefix(size);
  }
  return markup;
}

std::string manifolds_in_unicode(std::string_view text) {
  static constexpr std::string_view above[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const std::string markup = typeset_manifolds(text).str();
  std::string result;
  bool raised = false;
  for (std::string_view rest = markup; !rest.empty();) {
    static constexpr std::pair<std::string_view, std::string_view> entities[] = {
        {"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}};
    if (rest[0] == '<') {
      raised = rest.starts_with("<sup>");
      rest.remove_prefix(rest.find('>') + 1);
      continue;
    }
    const auto* entity =
        std::ranges::find_if(entities, [&](const auto& e) { return rest.starts_with(e.first); });
    if (entity != std::end(entities)) {
      result += entity->second;
      rest.remove_prefix(entity->first.size());
      continue;
    }
    if (raised && std::isdigit(static_cast<unsigned char>(rest[0])) != 0)
      result += above[static_cast<std::size_t>(rest[0] - '0')];
    else
      result += rest[0];
    rest.remove_prefix(1);
  }
  return result;
}

std::string unbroken(std::string_view text) {
  std::string result(text);
  for (const auto& [broken, whole] :
       {std::pair(" × 10", "\u00a0×\u00a010"), std::pair(" ± ", "\u00a0±\u00a0")})
    for (std::size_t at = 0; (at = result.find(broken, at)) != std::string::npos;)
      result.replace(at, std::string_view(broken).size(), whole);
  return result;
}

}  // namespace courant
