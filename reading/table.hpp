// Tables of numbers that become words of formulas: functions of time.
#pragma once

#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "courant/core/expressions/interpolation.hpp"
#include "courant/reading/json_reader.hpp"

namespace courant {

// {"times": [0, 1, 3], "values": [2, 5, 4], "interpolation": "linear"}
struct Table {
  VectorXd times, values;
  Interpolation interpolation = Interpolation::linear;

  Expr at(const Expr& t) const { return interpolated(times, values, interpolation, t); }
};

// The tables of an object by name; a problem for each that is wrong, which is left out.
std::vector<std::pair<std::string, Table>> read_tables(const JsonReader& object);

// A file that an experiment names: what messages call it, and its bytes; null where it cannot be read.
struct TableFile {
  std::string name;
  std::unique_ptr<std::istream> bytes;
};
// Opens the file that stands at `pointer` of an experiment. Throws ExperimentError where it may not be named.
using OpenTable = std::function<TableFile(const std::string& pointer, const std::string& file)>;

// Puts times and values in the place of {"file": "wind.csv", "time": "t", "column": "speed"} in the
// tables of an experiment's system, and of those that it is made of. Files are comma-separated, with
// names in the first line, and the default columns are the first two. In the same way the columns of the file
// {"table": "starts.csv"} of an ensemble come to stand under its "values", and what is in the mesh {"mesh": "drum.msh"}
// of a system's complex in its place. Throws ExperimentError with the
// place in the experiment, the file and the line.
void load_tables(Json& document, const OpenTable& open);

// Looks for them in `folder`.
enum class TableFiles {
  anywhere,
  beside,  // in `folder`, whatever links lead to
  none,
};
void load_tables(Json& document, const std::filesystem::path& folder,
                 TableFiles which = TableFiles::anywhere);

}  // namespace courant
