#include <algorithm>
#include <cctype>
#include <pugixml.hpp>
#include <set>

#include "courant/core/words/message.hpp"
#include "courant/extensions/importing/line_problems.hpp"
#include "courant/extensions/robots/xml.hpp"

namespace courant::robots {
namespace {

constexpr int kDeepest = 1000;
constexpr std::size_t kMostElements = 1'000'000;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view space = " \t\r\n";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

// Where lines begin, by which an offset has a line.
class LineNumbers {
 public:
  explicit LineNumbers(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') ends_.push_back(i);
  }
  int of(std::ptrdiff_t offset) const {
    const auto end = std::lower_bound(
        ends_.begin(), ends_.end(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return static_cast<int>(end - ends_.begin()) + 1;
  }

 private:
  std::vector<std::size_t> ends_;
};

class Conversion {
 public:
  explicit Conversion(std::string_view text) : lines_(text) {}

  Element element(const pugi::xml_node& node, int depth) {
    Element result;
    result.name = node.name();
    result.line = lines_.of(node.offset_debug());
    if (depth > kDeepest)
      result.fail("is nested deeper than " + std::to_string(kDeepest) + " elements");
    if (++count_ > kMostElements)
      result.fail("has more than " + std::to_string(kMostElements) + " elements before it");
    std::set<std::string_view> names;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      if (!names.insert(attribute.name()).second)
        result.fail("has the attribute " + in_quotes(attribute.name()) + " twice");
      result.attributes.emplace_back(attribute.name(), attribute.value());
    }
    result.text = trimmed(node.text().get());
    for (const pugi::xml_node& child : node.children())
      if (child.type() == pugi::node_element) result.children.push_back(element(child, depth + 1));
    return result;
  }

 private:
  LineNumbers lines_;
  std::size_t count_ = 0;
};

}  // namespace

Element parse_xml(std::string_view text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed)
    throw LineError{LineNumbers(text).of(parsed.offset),
                    std::string("is no well-formed XML: ") +
                        static_cast<char>(std::tolower(parsed.description()[0])) +
                        (parsed.description() + 1)};
  const pugi::xml_node root = document.document_element();
  if (!root) throw LineError{1, "has no element; expected XML with a root element"};
  for (pugi::xml_node other = root.next_sibling(); other; other = other.next_sibling())
    if (other.type() == pugi::node_element)
      throw LineError{LineNumbers(text).of(other.offset_debug()),
                      "is a second root element; expected one"};
  return Conversion(text).element(root, 1);
}

}  // namespace courant::robots
