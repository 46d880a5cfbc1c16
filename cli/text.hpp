// Numbers and tables for a terminal.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "courant/cli/command.hpp"
#include "courant/reading/findings.hpp"
#include "courant/running/ladder_report.hpp"

namespace courant::cli {

// A number to a few significant digits, "1.596e-04"; "–" for a JSON null.
std::string shown(double value, int digits = 6);
std::string shown(const Json& value, int digits = 6);
// "–" for a number that is not known, and a dimension that there is not.
std::string shown_if_known(double value, int digits = 6);
std::string shown_if_known(std::optional<Index> value);

// The name of a file, as printable.
std::string shown_name(const std::filesystem::path& file);

// `text` on console.out in lines of at most console.columns characters, each after `indent`. A text that is
// indented itself, a formula, goes on four columns further in.
void print_wrapped(const Console& console, const std::string& text, const std::string& indent);

// Rows of cells; the first column is left-aligned, the others right-aligned, two spaces apart.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  // Control characters in it are shown as \u001b.
  void add(std::vector<std::string> row);
  bool empty() const { return rows_.size() == 1; }
  // What does not fit into `columns` goes on below, in the first column.
  void print(std::ostream& out, const std::string& indent = "  ",
             std::size_t columns = std::string::npos) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

// "(16, 8) ⊇ (8, 8)": (dim S, dim M) of each level but those that only confirm; ∅ where one is
// empty.
std::string ladder_line(const LadderReport& ladder);

}  // namespace courant::cli
