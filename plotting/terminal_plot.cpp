#include "courant/plotting/terminal_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "courant/plotting/decimation.hpp"
#include "courant/plotting/digits.hpp"

namespace courant::plot {

namespace {

constexpr int label_margin = 8;  // columns left of the plotted area, for labels

char letter(std::size_t series) { return static_cast<char>('a' + series % 26); }

std::string spaces(int count) {
  return std::string(static_cast<std::size_t>(std::max(0, count)), ' ');
}

std::string repeated(std::string_view text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

std::string coloured(const std::string& text, std::size_t colour, const TerminalOptions& options) {
  static constexpr std::array<int, 7> codes = {32, 166, 36, 132, 178, 74, 245};
  if (!options.colour) return text;
  return "\x1b[38;5;" + std::to_string(codes[colour % codes.size()]) + "m" + text + "\x1b[0m";
}

std::string scientific(double value, const TerminalOptions& options) {
  if (options.unicode) return readable(value, 3);
  return digits(value, std::chars_format::general, 3);
}

// A rectangle of characters on which dots are set: 2 × 4 of them to a character in Braille, one in
// ASCII. The dot (0, 0) is at the top left.
class Canvas {
 public:
  Canvas(int columns, int rows, const TerminalOptions& options)
      : columns_(columns),
        rows_(rows),
        options_(options),
        cells_(static_cast<std::size_t>(columns * rows)) {}

  int dot_columns() const { return columns_ * (options_.unicode ? 2 : 1); }
  int dot_rows() const { return rows_ * (options_.unicode ? 4 : 1); }

  void dot(int x, int y, std::size_t series, std::size_t colour) {
    if (x < 0 || y < 0 || x >= dot_columns() || y >= dot_rows()) return;
    // Unicode numbers the dots of a Braille pattern down the left column, then the right; the
    // lowest two came later.
    static constexpr std::array<std::array<std::uint8_t, 2>, 4> bits = {
        {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
    Cell& cell = options_.unicode ? at(x / 2, y / 4) : at(x, y);
    if (options_.unicode) {
      cell.dots |= bits[static_cast<std::size_t>(y % 4)][static_cast<std::size_t>(x % 2)];
    } else {
      cell.letter = letter(series);
    }
    cell.colour = colour;
  }

  // The dots of a straight line.
  void line(Vertex from, Vertex to, std::size_t series, std::size_t colour) {
    const double length = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
    const int steps = static_cast<int>(std::clamp(std::ceil(length), 1.0, 1e4));
    for (int i = 0; i <= steps; ++i) {
      const double s = static_cast<double>(i) / steps;
      dot(static_cast<int>(std::lround(from.x + s * (to.x - from.x))),
          static_cast<int>(std::lround(from.y + s * (to.y - from.y))), series, colour);
    }
  }

  // The letter of a series in the character of a dot.
  void name(Vertex where, std::size_t series, std::size_t colour) {
    const int x = static_cast<int>(std::lround(where.x)),
              y = static_cast<int>(std::lround(where.y));
    if (x < 0 || y < 0 || x >= dot_columns() || y >= dot_rows()) return;
    Cell& cell = options_.unicode ? at(x / 2, y / 4) : at(x, y);
    cell.letter = letter(series);
    cell.colour = colour;
  }

  std::string row(int y) const {
    std::string text;
    for (int x = 0; x < columns_; ++x) {
      const Cell& cell = cells_[static_cast<std::size_t>(y * columns_ + x)];
      if (cell.letter != 0) {
        text += coloured(std::string(1, cell.letter), cell.colour, options_);
      } else if (cell.dots != 0) {
        text += coloured(braille(cell.dots), cell.colour, options_);
      } else {
        text += ' ';
      }
    }
    return text;
  }

 private:
  struct Cell {
    std::uint8_t dots = 0;
    char letter = 0;
    std::size_t colour = 0;
  };

  Cell& at(int x, int y) { return cells_[static_cast<std::size_t>(y * columns_ + x)]; }

  // U+2800 + dots in UTF-8.
  static std::string braille(std::uint8_t dots) {
    return {static_cast<char>(0xe2), static_cast<char>(0xa0 | (dots >> 6)),
            static_cast<char>(0x80 | (dots & 0x3f))};
  }

  int columns_, rows_;
  const TerminalOptions& options_;
  std::vector<Cell> cells_;
};

void check(const TerminalOptions& options) {
  if (options.width < 40 || options.height < 4) {
    throw std::invalid_argument("terminal plot: it has " + std::to_string(options.width) + " × " +
                                std::to_string(options.height) +
                                " characters, expected at least 40 × 4.");
  }
}

// Text right-aligned in the margin; `width` counts the characters that it shows.
std::string in_margin(const std::string& text, int width) {
  return spaces(label_margin - 1 - width) + text + " ";
}

int shown_width(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string horizontal_axis(Interval x, int columns, const TerminalOptions& options) {
  const std::string begin = scientific(x.lower, options), end = scientific(x.upper, options);
  return spaces(label_margin) + (options.unicode ? "└" : "+") +
         repeated(options.unicode ? "─" : "-", columns) + "\n" + spaces(label_margin + 1) + begin +
         spaces(columns - shown_width(begin) - shown_width(end)) + end + "\n";
}

std::string legend_line(const Series& series, std::size_t index, const std::string& note,
                        const TerminalOptions& options) {
  return spaces(label_margin + 1) +
         coloured(std::string(1, letter(index)) + "  " + series.label, series.colour, options) +
         (note.empty() ? "" : "   " + note) + "\n";
}

double greatest(std::span<const double> values) {
  double size = 0;
  for (const double value : values) {
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  }
  return size;
}

}  // namespace

std::string terminal_log_plot(std::string_view title, std::span<const Series> series,
                              const TerminalOptions& options) {
  check(options);
  Interval x, sizes;
  for (const Series& one : series) {
    x.include(one.x);
    if (const double size = greatest(one.y); size > 0) sizes.include(size);
  }
  if (x.empty()) x = {0, 1};
  if (sizes.empty()) sizes = {1e-16, 1e-16};
  const int lowest = static_cast<int>(std::floor(std::log10(sizes.lower))) - 1;
  const int highest = static_cast<int>(std::ceil(std::log10(sizes.upper) + 1e-9));

  const int names = static_cast<int>(std::min<std::size_t>(series.size(), 6)) + 1;
  const int columns = options.width - label_margin - 1 - names;
  Canvas canvas(columns, options.height, options);
  const double bottom = canvas.dot_rows() - 1.0, per_decade = bottom / (highest - lowest);
  const auto height = [&](double size) {
    return bottom - per_decade * (std::log10(size) - lowest);
  };
  const double per_x = x.length() > 0 ? (canvas.dot_columns() - 1.0) / x.length() : 0;

  std::vector<std::string> ends(static_cast<std::size_t>(options.height));
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Series& one = series[i];
    std::vector<double> column_sizes(static_cast<std::size_t>(canvas.dot_columns()), 0);
    for (std::size_t row = 0; row < one.x.size(); ++row) {
      if (!std::isfinite(one.x[row]) || !std::isfinite(one.y[row])) continue;
      double& size =
          column_sizes[static_cast<std::size_t>(std::lround((one.x[row] - x.lower) * per_x))];
      size = std::max(size, std::abs(one.y[row]));
    }
    std::optional<Vertex> last;
    for (std::size_t column = 0; column < column_sizes.size(); ++column) {
      if (column_sizes[column] == 0) continue;
      const Vertex here{static_cast<double>(column), height(column_sizes[column])};
      canvas.line(last.value_or(here), here, i, one.colour);
      last = here;
    }
    if (!last) continue;
    const int line = static_cast<int>(std::lround(last->y)) * options.height / canvas.dot_rows();
    ends[static_cast<std::size_t>(std::clamp(line, 0, options.height - 1))] +=
        coloured(std::string(1, letter(i)), one.colour, options);
  }

  std::vector<std::string> labels(static_cast<std::size_t>(options.height));
  const int stride =
      std::max(1, (highest - lowest + options.height / 2 - 1) / (options.height / 2));
  for (int power = highest; power >= lowest; power -= stride) {
    const int line = static_cast<int>(std::lround(height(std::pow(10, power)))) * options.height /
                     canvas.dot_rows();
    const std::string label = options.unicode ? power_of_ten(power) : "1e" + std::to_string(power);
    labels[static_cast<std::size_t>(std::clamp(line, 0, options.height - 1))] = label;
  }
  std::string text = spaces(label_margin) + std::string(title) + "\n";
  for (int line = 0; line < options.height; ++line) {
    const std::string& label = labels[static_cast<std::size_t>(line)];
    const std::string_view axis =
        options.unicode ? (label.empty() ? "│" : "┤") : (label.empty() ? "|" : "+");
    text += in_margin(label, shown_width(label)) + std::string(axis) + canvas.row(line) + " " +
            ends[static_cast<std::size_t>(line)] + "\n";
  }
  text += horizontal_axis(x, columns, options);
  for (std::size_t i = 0; i < series.size(); ++i) {
    text +=
        legend_line(series[i], i, "at most " + scientific(greatest(series[i].y), options), options);
  }
  return text;
}

std::string terminal_paths(std::string_view title, std::span<const Series> series,
                           const TerminalOptions& options) {
  check(options);
  Interval x, y;
  for (const Series& one : series) {
    x.include(one.x);
    y.include(one.y);
  }
  if (x.empty() || y.empty()) x = y = {0, 1};
  const LinearScale linear;
  x = linear.padded(x, 0.02);
  y = linear.padded(y, 0.02);

  // A character is twice as high as wide, so a dot of Braille is square and one of ASCII is not.
  const int columns = options.width - label_margin - 1;
  const double wanted = columns * y.length() / x.length() / 2;
  const int rows =
      static_cast<int>(std::clamp(std::ceil(wanted), 4.0, static_cast<double>(options.height)));
  Canvas canvas(columns, rows, options);
  const double dot_aspect = options.unicode ? 1 : 2;  // height over width
  const double unit =
      std::max(x.length() / (canvas.dot_columns() - 1),
               y.length() / (canvas.dot_rows() - 1) / dot_aspect);  // of x, in a dot's width
  const double middle_x = (canvas.dot_columns() - 1) / 2.0,
               middle_y = (canvas.dot_rows() - 1) / 2.0;
  const auto place = [&](double px, double py) -> Vertex {
    return {middle_x + (px - (x.lower + x.upper) / 2) / unit,
            middle_y - (py - (y.lower + y.upper) / 2) / unit / dot_aspect};
  };
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Series& one = series[i];
    for (const Stretch stretch : finite_stretches(one.x, one.y)) {
      for (std::size_t row = stretch.begin; row < stretch.end; ++row) {
        const std::size_t before = row > stretch.begin ? row - 1 : row;
        canvas.line(place(one.x[before], one.y[before]), place(one.x[row], one.y[row]), i,
                    one.colour);
      }
    }
  }
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::vector<Stretch> stretches = finite_stretches(series[i].x, series[i].y);
    if (stretches.empty()) continue;
    const std::size_t end = stretches.back().end - 1;
    canvas.name(place(series[i].x[end], series[i].y[end]), i, series[i].colour);
  }
  const double shown_x = unit * (canvas.dot_columns() - 1),
               shown_y = unit * dot_aspect * (canvas.dot_rows() - 1);
  const Interval across{(x.lower + x.upper - shown_x) / 2, (x.lower + x.upper + shown_x) / 2};
  const Interval up{(y.lower + y.upper - shown_y) / 2, (y.lower + y.upper + shown_y) / 2};
  std::string text = spaces(label_margin) + std::string(title) + "\n";
  for (int line = 0; line < rows; ++line) {
    const bool is_end = line == 0 || line == rows - 1;
    const std::string label = is_end ? scientific(line == 0 ? up.upper : up.lower, options) : "";
    const std::string_view axis = options.unicode ? (is_end ? "┤" : "│") : (is_end ? "+" : "|");
    text += in_margin(label, shown_width(label)) + std::string(axis) + canvas.row(line) + "\n";
  }
  text += horizontal_axis(across, columns, options);
  for (std::size_t i = 0; i < series.size(); ++i) text += legend_line(series[i], i, "", options);
  return text;
}

}  // namespace courant::plot
