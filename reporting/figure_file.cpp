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
#include "courant/reporting/figure_drawing.hpp"

extern char** environ;

namespace courant {

namespace {

constexpr const char* converter = "rsvg-convert";
constexpr std::array extensions = {".svg", ".pdf", ".png", ".pgf"};

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

}  // namespace

void write_figure(const Figure& figure, const std::filesystem::path& file, bool force) {
  const std::string extension = file.extension().string();
  if (std::ranges::find(extensions, extension) == extensions.end())
    throw std::invalid_argument(file.string() +
                                ": is no kind of picture; expected a name that ends in .svg, "
                                ".pdf, .png or .pgf");
  std::filesystem::path numbers = file;
  numbers.replace_extension(".csv");
  const OwnFiles files("plot", force);
  files.check(file);
  check_numbers(file, numbers);
  const std::string drawing = extension == ".pgf" ? figure_pgf(figure) : figure_svg(figure),
                    csv = figure_csv(figure);
  const bool is_text = extension == ".svg" || extension == ".pgf";
  files.write(file, is_text ? drawing : converted(drawing, file), csv);
  write_file(numbers, csv);
}

}  // namespace courant
