// A figure of runs, and what the figures of a report have in common.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "courant/plotting/figure.hpp"
#include "courant/running/run_files.hpp"

namespace courant {

// Panels that belong together, with one legend and one caption.
struct Figure {
  std::vector<plot::Panel> panels;
  std::vector<plot::LegendEntry> legend;
  std::string caption;
  std::string name = {};     // one word, by which it is asked for
  std::string heading = {};  // drawn above the panels of a file of its own
  double scale = 1;          // of such a file
  std::optional<bool> abreast =
      {};  // whether its panels stand so, two by two; by default narrow ones do
};

// How the runs are told apart: by their methods, or by their folders where methods repeat.
std::vector<std::string> run_labels(std::span<const Run> runs);

// A column of all runs that have it, over time; a run's curve has its colour.
std::vector<plot::Series> columns_over_time(std::span<const Run> runs, const std::string& column);

// The values of the first rows, or of all where there are fewer.
std::vector<double> first_rows(std::span<const double> values, std::size_t rows);

// What an axis says of a quantity: its label and its unit, as the first run that has it gives them.
std::string axis_label(std::span<const Run> runs, const std::string& quantity);

}  // namespace courant
