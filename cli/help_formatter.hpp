// HelpFormatter: folds the lines that `--help` prints.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace courant::cli {

// Prints help as CLI11 does, and folds lines that are longer than the given number of columns. The rest of a
// description goes below its beginning; the rest of any other line begins in column six. Lines are folded between
// words, or after the | in a list such as json|csv.
class HelpFormatter : public CLI::Formatter {
 public:
  static constexpr std::size_t kMostColumns = 100;
  explicit HelpFormatter(std::size_t columns = kMostColumns) : columns_(columns) {}
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;

 private:
  std::size_t columns_;
};

}  // namespace courant::cli
