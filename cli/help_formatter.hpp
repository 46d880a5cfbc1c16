// What `--help` prints, in lines of at most 100 columns, or those of a narrower terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace courant::cli {

// The formatter of CLI11, whose long lines go on below: descriptions where descriptions begin, any other
// line six columns in. Lines end between words, or behind the | of a list of words.
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
