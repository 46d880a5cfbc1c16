// A small writer of SVG and HTML. What comes as text is escaped, by type: a file's name or a
// message can never become markup.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace courant::plot {

// Text made safe for XML, HTML and attribute values: & < > " ' become entities, and the control
// characters that XML 1.0 forbids become U+FFFD.
std::string escape(std::string_view text);

// A finished, well-formed piece of markup. Only `element` makes tags; a string that is converted or
// added is text, and is escaped.
class Markup {
 public:
  Markup() = default;
  Markup(const std::string& text) : markup_(escape(text)) {}
  Markup(std::string_view text) : markup_(escape(text)) {}
  Markup(const char* text) : markup_(escape(text)) {}

  Markup& operator+=(const Markup& more);
  friend Markup operator+(Markup first, const Markup& second) { return std::move(first += second); }

  const std::string& str() const { return markup_; }

 private:
  friend class Element;
  std::string markup_;
};

// name="value"; numbers are written with at most two decimals, a hundredth of a pixel.
struct Attribute {
  Attribute(std::string_view name_, std::string_view value_) : name(name_), value(value_) {}
  Attribute(std::string_view name_, double value_);
  std::string_view name;
  std::string value;
};
using Attributes = std::initializer_list<Attribute>;

// <tag name="value" …>content</tag>. Tag and attribute names are the program's own.
Markup element(std::string_view tag, Attributes attributes, const Markup& content);
// An element without content: <tag name="value" …/>.
Markup element(std::string_view tag, Attributes attributes);

// The program's own style sheet, as it is. Throws std::invalid_argument when it has a < or an &,
// with which it could be more than that.
Markup style_sheet(std::string_view css);

// The program's own script, as it is. Throws std::invalid_argument when it has a </ or a ]]>, with
// which it would end early.
Markup script(std::string_view javascript);

// An <svg> whose user unit is `scale` pixels, with a <title> and a <desc> for who cannot see it.
Markup svg(double width, double height, std::string_view title, std::string_view description,
           const Markup& content, double scale = 1);

// A number for a coordinate: fixed, at most `decimals` of them, no trailing zeros, "0" never "-0".
std::string coordinate(double value, int decimals = 2);

// The d attribute of a <path>, to a tenth of a pixel; a vertex that rounds to the one before it is
// left out.
class PathData {
 public:
  void move_to(double x, double y) { add('M', x, y); }
  void line_to(double x, double y) { add('L', x, y); }
  void close() { data_ += 'Z'; }

  bool empty() const { return data_.empty(); }
  const std::string& str() const { return data_; }

 private:
  void add(char command, double x, double y);
  std::string data_;
  std::string last_;
};

}  // namespace courant::plot
