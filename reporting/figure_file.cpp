#include "courant/reporting/figure_file.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "courant/plotting/sheet.hpp"
#include "courant/running/comma_separated.hpp"
#include "courant/running/output_file.hpp"

extern char** environ;

namespace courant {

namespace {

constexpr const char* converter = "rsvg-convert";

// Runs rsvg-convert, no shell between, to write a picture of the kind of `file`. Throws OutputError with the name of
// this one.
void convert(const std::filesystem::path& svg, const std::filesystem::path& file,
             const std::filesystem::path& picture) {
  const std::string format = file.extension().string().substr(1);
  std::vector<std::string> words = {converter, "--format", format, "--output", picture.string()};
  if (format == "png") words.insert(words.end(), {"--zoom", "3.125"});  // 300 dpi / 96
  words.push_back(svg.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, converter, &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error == ENOENT)
    throw OutputError(file.string() +
                      ": needs the program rsvg-convert (Debian package librsvg2-bin), which is "
                      "not there; expected it, or a name that ends in .svg");
  if (error != 0)
    throw OutputError(file.string() + ": rsvg-convert cannot be started: " +
                      std::generic_category().message(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw OutputError(file.string() + ": rsvg-convert failed");
}

// The picture by rsvg-convert, written whole. Throws OutputError with the name of the file.
void write_converted(const std::string& drawing, const std::filesystem::path& file) {
  std::filesystem::path svg = file, picture = file;
  svg += ".svg.new";
  picture += ".picture.new";
  write_file(svg, drawing, file);
  std::error_code ignored;
  std::filesystem::remove(picture, ignored);
  const auto remove_both = [&] {
    for (const auto& part : {svg, picture}) std::filesystem::remove(part, ignored);
  };
  try {
    convert(svg, file, picture);
    std::ifstream converted(picture, std::ios::binary);
    const std::string content(std::istreambuf_iterator<char>(converted), {});
    write_file(file, content);
  } catch (const OutputError&) {
    remove_both();
    throw;
  }
  remove_both();
}

struct Column {
  std::string name;
  const std::vector<double>* values;
};

std::vector<Column> columns(const Figure& figure) {
  std::vector<Column> found;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const plot::Panel& panel = figure.panels[i];
    const std::string of_panel =
        figure.panels.size() == 1
            ? ""
            : (panel.heading.empty() ? std::to_string(i + 1) : panel.heading) + ": ";
    const std::vector<double>* x = nullptr;
    for (const plot::Series& one : panel.series) {
      const std::string of_curve =
          panel.series.size() == 1 || one.label.empty() ? "" : one.label + ": ";
      if (x == nullptr || *x != one.x) {
        const bool is_shared = std::ranges::all_of(
            panel.series, [&](const plot::Series& other) { return other.x == one.x; });
        found.push_back({of_panel + (is_shared ? "" : of_curve) + panel.x.label, &one.x});
      }
      found.push_back({of_panel + of_curve + panel.y.label, &one.y});
      if (panel.space) found.push_back({of_panel + of_curve + panel.space->z_label, &one.z});
      x = &one.x;
    }
  }
  return found;
}

}  // namespace

std::string figure_svg(const Figure& figure) {
  const std::string title = figure.panels.empty() ? "" : figure.panels.front().title;
  return plot::draw(plot::Sheet{title, figure.caption, figure.legend, figure.panels}).str() + "\n";
}

std::string figure_csv(const Figure& figure) {
  const std::vector<Column> all = columns(figure);
  std::string csv;
  std::size_t rows = 0;
  for (const Column& column : all) {
    csv += (csv.empty() ? "" : ",") + csv_cell(column.name);
    rows = std::max(rows, column.values->size());
  }
  csv += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i > 0) csv += ',';
      if (row < all[i].values->size()) csv += csv_cell((*all[i].values)[row]);
    }
    csv += '\n';
  }
  return csv;
}

void write_figure(const Figure& figure, const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".svg" && extension != ".pdf" && extension != ".png")
    throw std::invalid_argument(file.string() +
                                ": is no kind of picture; expected a name that ends in .svg, .pdf "
                                "or .png");
  if (extension == ".svg")
    write_file(file, figure_svg(figure));
  else
    write_converted(figure_svg(figure), file);
  std::filesystem::path numbers = file;
  write_file(numbers.replace_extension(".csv"), figure_csv(figure));
}

}  // namespace courant
