// The colours of curves.
#pragma once

#include <span>
#include <string_view>

namespace courant::plot {

// Okabe and Ito's colours, told apart by who does not see red or green; on paper, then on a dark
// screen.
struct PaletteColour {
  std::string_view light, dark;
};
std::span<const PaletteColour> palette();

}  // namespace courant::plot
