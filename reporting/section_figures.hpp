// Poincaré sections as pictures.
#pragma once

#include <optional>
#include <span>

#include "courant/reporting/run_figure.hpp"

namespace courant {

// The points where events occurred, a panel for each event that did so ten times or more in one of the
// runs: in the plane of a coordinate and its momentum, or of two coordinates, that differ there by more than
// a thousandth of what they do along the way; the first of these. Of each run the first 4000. Nothing where no event has such a
// plane. Its name is section.
std::optional<Figure> section_figure(std::span<const Run> runs);

}  // namespace courant
