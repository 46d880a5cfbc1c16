// Figures for a terminal, made of characters.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "courant/plotting/panel.hpp"

namespace courant::plot {

// How large a plot in a terminal is, and which characters it is made of.
struct TerminalOptions {
  int width = 80;       // characters in a line, at least 40
  int height = 14;      // lines of the plotted area; the most there may be of them for paths
  bool unicode = true;  // Braille patterns, eight dots to a character; otherwise ASCII, one letter
  bool colour = false;  // ANSI colours, close to those of the figures
};

// |y| over x on a logarithmic axis: in each column of dots the greatest of the values that fall
// into it. Each series has a letter, at the right end of its curve and in the legend, there with
// its greatest |y|. The axis begins a decade below the smallest of these; zeros and what is
// below are not drawn. Throws std::invalid_argument when the width is below 40 or the height
// below 4.
std::string terminal_log_plot(std::string_view title, std::span<const Series> series,
                              const TerminalOptions& options = {});

// Paths in the plane, with as many dots to a unit of y as to one of x; each series has a letter at
// its end. Throws as terminal_log_plot.
std::string terminal_paths(std::string_view title, std::span<const Series> series,
                           const TerminalOptions& options = {});

}  // namespace courant::plot
