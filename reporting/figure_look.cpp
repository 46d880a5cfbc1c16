#include "courant/reporting/figure_look.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr double kPixelsOfCentimetre = 96 / 2.54;
constexpr double kDrawnPoints = 9;   // letters of 12 pixels
constexpr double kMargins = 20;      // of a sheet, both
constexpr double kGap = 14;          // between panels abreast
constexpr double kLeastPanel = 180;  // pixels, below which axes have no room

void check(const char* name, double value, double least, double most, const char* unit) {
  if (!(value >= least && value <= most))
    throw std::invalid_argument(std::string("with_look: the ") + name + " is " +
                                number_text(value) + " " + unit + "; expected " +
                                number_text(least) + " to " + number_text(most) + ".");
}

void check(const char* name, const std::optional<plot::Interval>& limits) {
  if (limits && !(limits->lower < limits->upper && std::isfinite(limits->length())))
    throw std::invalid_argument(std::string("with_look: the limits of ") + name + " are " +
                                number_text(limits->lower) + " and " + number_text(limits->upper) +
                                "; expected the lower one first.");
}

}  // namespace

Figure with_look(Figure figure, const FigureLook& look) {
  if (look.font_size) check("font size", *look.font_size, 4, 40, "points");
  if (look.width) check("width", *look.width, 3, 100, "cm");
  check("x", look.x);
  check("y", look.y);
  figure.heading = look.title;
  if (look.font_size) figure.scale = *look.font_size / kDrawnPoints;
  double widest = 0;
  for (const plot::Panel& panel : figure.panels) widest = std::max(widest, panel.width);
  if (look.width) {
    constexpr double narrow = 400;  // see plot::Sheet
    const bool abreast = figure.panels.size() > 1 && widest < narrow;
    const double room = *look.width * kPixelsOfCentimetre / figure.scale - kMargins;
    const double width = abreast ? (room - kGap) / 2 : room;
    if (width < kLeastPanel)
      throw std::invalid_argument("with_look: a width of " + number_text(*look.width) +
                                  " cm has no room for letters of " +
                                  number_text(look.font_size.value_or(kDrawnPoints)) +
                                  " points; expected more, or smaller letters.");
    figure.abreast = abreast;
    for (plot::Panel& panel : figure.panels) {
      panel.height *= width / panel.width;
      panel.width = width;
    }
  }
  for (plot::Panel& panel : figure.panels) {
    if (look.x) panel.x.interval = *look.x, panel.x.is_window = true;
    if (look.y) panel.y.interval = *look.y, panel.y.is_window = true;
  }
  return figure;
}

}  // namespace courant
