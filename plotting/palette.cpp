#include "courant/plotting/palette.hpp"

#include <array>

namespace courant::plot {

namespace {

constexpr std::array<PaletteColour, 7> colours = {{{"#0072b2", "#4aa5e0"},
                                                   {"#d55e00", "#f27b3d"},
                                                   {"#009e73", "#2fc39a"},
                                                   {"#b3578a", "#df97bd"},
                                                   {"#c98a00", "#e9ab22"},
                                                   {"#3b9bd1", "#8fd0f7"},
                                                   {"#444444", "#d0cdc6"}}};

}  // namespace

std::span<const PaletteColour> palette() { return colours; }

}  // namespace courant::plot
