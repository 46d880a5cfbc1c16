#include "courant/reporting/figure_file.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "courant/core/files/content_hash.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/files/work_folder.hpp"
#include "courant/plotting/sheet.hpp"
#include "courant/running/comma_separated.hpp"

extern char** environ;

namespace courant {

namespace {

constexpr const char* converter = "rsvg-convert";
constexpr std::array extensions = {".svg", ".pdf", ".png"};

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

// The picture that rsvg-convert makes. Throws OutputError with the name of the file.
std::string converted(const std::string& drawing, const std::filesystem::path& file) {
  const WorkFolder work;
  const std::filesystem::path svg = work.path() / "drawing.svg", picture = work.path() / "picture";
  write_file(svg, drawing);
  convert(svg, file, picture);
  return content_of(picture);
}

// Throws RefusedOutput if there are other numbers than those of a picture of this name that is ours.
void check_numbers(const std::filesystem::path& picture, const std::filesystem::path& numbers) {
  std::error_code error;
  if (!std::filesystem::exists(numbers, error)) return;
  const std::string there = content_hash(content_of(numbers));
  for (const char* extension : extensions) {
    std::filesystem::path of = picture;
    const auto mark = mark_of(of.replace_extension(extension));
    if (mark && mark->beside == there) return;
  }
  throw RefusedOutput(numbers.string() +
                      ": the numbers of the figure would go there, and it is not as courant wrote "
                      "it; expected another name (-o)");
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

void write_figure(const Figure& figure, const std::filesystem::path& file, bool force) {
  const std::string extension = file.extension().string();
  if (std::ranges::find(extensions, extension) == extensions.end())
    throw std::invalid_argument(file.string() +
                                ": is no kind of picture; expected a name that ends in .svg, .pdf "
                                "or .png");
  std::filesystem::path numbers = file;
  numbers.replace_extension(".csv");
  const OwnFiles files("plot", force);
  files.check(file);
  check_numbers(file, numbers);
  const std::string drawing = figure_svg(figure), csv = figure_csv(figure);
  files.write(file, extension == ".svg" ? drawing : converted(drawing, file), csv);
  write_file(numbers, csv);
}

}  // namespace courant
