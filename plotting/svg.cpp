#include "courant/plotting/svg.hpp"

#include <cmath>
#include <stdexcept>

#include "courant/plotting/digits.hpp"

namespace courant::plot {

std::string escape(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    // U+0080 … U+009F, which are controls as well, are C2 80 … C2 9F.
    if (c == '\xc2' && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0) {
      escaped += "\uFFFD";
      ++i;
      continue;
    }
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default: {
        const bool forbidden =
            (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n') || c == 0x7f;
        if (forbidden) {
          escaped += "\uFFFD";
        } else {
          escaped += c;
        }
      }
    }
  }
  return escaped;
}

Markup& Markup::operator+=(const Markup& more) {
  markup_ += more.markup_;
  return *this;
}

Attribute::Attribute(std::string_view name_, double value_)
    : name(name_), value(coordinate(value_)) {}

// The one place where tags are made.
class Element {
 public:
  static Markup make(std::string_view tag, Attributes attributes, const Markup* content) {
    Markup made;
    std::string& out = made.markup_;
    out.append("<").append(tag);
    for (const Attribute& attribute : attributes) {
      out.append(" ")
          .append(attribute.name)
          .append("=\"")
          .append(escape(attribute.value))
          .append("\"");
    }
    if (content == nullptr) {
      out.append("/>");
    } else {
      out.append(">").append(content->markup_).append("</").append(tag).append(">");
    }
    return made;
  }

  static Markup make_style(std::string_view css) {
    Markup made;
    made.markup_.append("<style>").append(css).append("</style>");
    return made;
  }

  // The comments hide the brackets, which XML needs, from HTML.
  static Markup make_script(std::string_view javascript) {
    Markup made;
    made.markup_.append("<script>//<![CDATA[\n").append(javascript).append("//]]></script>");
    return made;
  }
};

Markup element(std::string_view tag, Attributes attributes, const Markup& content) {
  return Element::make(tag, attributes, &content);
}

Markup element(std::string_view tag, Attributes attributes) {
  return Element::make(tag, attributes, nullptr);
}

Markup style_sheet(std::string_view css) {
  if (css.find_first_of("<&") != std::string_view::npos) {
    throw std::invalid_argument("style_sheet: css has a < or an &, expected neither.");
  }
  return Element::make_style(css);
}

Markup script(std::string_view javascript) {
  for (const std::string_view end : {"</", "]]>"}) {
    if (javascript.find(end) == std::string_view::npos) continue;
    throw std::invalid_argument("script: javascript has a " + std::string(end) +
                                ", expected none.");
  }
  return Element::make_script(javascript);
}

Markup svg(double width, double height, std::string_view title, std::string_view description,
           const Markup& content, double scale) {
  const std::string view = "0 0 " + coordinate(width) + " " + coordinate(height);
  return element("svg",
                 {{"xmlns", "http://www.w3.org/2000/svg"},
                  {"viewBox", view},
                  {"width", scale * width},
                  {"height", scale * height},
                  {"overflow", "visible"},
                  {"role", "img"},
                  {"aria-label", title}},
                 element("title", {}, title) + element("desc", {}, description) + content);
}

std::string coordinate(double value, int decimals) {
  if (!std::isfinite(value)) return "0";
  std::string text = digits(value, std::chars_format::fixed, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

void PathData::add(char command, double x, double y) {
  std::string vertex = coordinate(x, 1) + " " + coordinate(y, 1);
  if (command == 'L' && vertex == last_) return;
  data_ += command;
  data_ += vertex;
  last_ = std::move(vertex);
}

}  // namespace courant::plot
