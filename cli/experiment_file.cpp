#include "courant/cli/experiment_file.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <istream>
#include <new>
#include <optional>
#include <system_error>

#include "courant/cli/waiting.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/core/words/message.hpp"
#include "courant/extensions/robots/import_robot.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/reading/setting.hpp"
#include "courant/reading/unused_parameters.hpp"

namespace courant::cli {
namespace {

constexpr std::size_t kLargest = std::size_t{16} << 20;  // bytes; a device may have no end

std::optional<std::string> read_text(const Console& console, const std::string& file,
                                     const std::string& expected, std::istream& stream) {
  std::string text;
  std::array<char, 1 << 16> part;
  while (text.size() <= kLargest && stream) {
    stream.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() <= kLargest) return text;
  print_error(console, file + ": is larger than 16 MB; expected " + expected);
  return std::nullopt;
}

// A netlist by the end of its name, or a robot.
bool is_to_be_imported(const std::string& file, const std::string& text) {
  std::string suffix = std::filesystem::path(file).extension().string();
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::array netlists = {".cir", ".ckt", ".net", ".sp", ".spi", ".spice"};
  return std::ranges::find(netlists, suffix) != netlists.end() || is_robot_file(file, text);
}

void report_problems(const Console& console, const std::string& file,
                     const ExperimentError& error) {
  for (const Problem& problem : error.problems())
    print_error(console, file + ": " + problem.line());
}

}  // namespace

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--set", settings,
                  "change a value of the experiment, as in --set /time/step=0.1; may be repeated")
      ->type_name("/POINTER=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::optional<std::string> read_input(const Console& console, const std::string& file,
                                      const std::string& expected) {
  if (file == "-") return read_text(console, file, expected, console.in);
  std::ifstream stream(file, std::ios::binary);
  const int error = errno;
  if (stream && !std::filesystem::is_directory(file))
    return read_text(console, file, expected, stream);
  print_error(console, file + ": cannot be read: " +
                           (stream ? "is a folder" : std::generic_category().message(error)));
  return std::nullopt;
}

int reporting_errors(const Console& console, const std::string& file,
                     const std::function<int()>& action) {
  try {
    return action();
  } catch (const ExperimentError& error) {
    report_problems(console, file, error);
    return wrong;
  } catch (const OutputError&) {
    throw;  // says which file
  } catch (const std::bad_alloc&) {
    print_error(console, file + ": takes more memory than there is");
  } catch (const std::exception& error) {
    print_error(console, file + ": " + without_place(error.what()));
    if (console.stop && *console.stop) return interrupted;  // it gave up what it was asked to
  }
  return failed;
}

int with_document(const Console& console, const std::string& file,
                  const std::function<int(const Json&)>& action,
                  const std::vector<std::string>& settings, TableFiles tables) {
  // One of a stranger is a file: a pipe might never end, nor ever begin.
  if (std::error_code error; tables == TableFiles::beside && file != "-" &&
                             std::filesystem::exists(file, error) &&
                             !std::filesystem::is_regular_file(file, error)) {
    print_error(console, file + ": cannot be read: is no file");
    return wrong;
  }
  const auto text = read_input(console, file, "an experiment");
  if (!text) return wrong;
  if (is_to_be_imported(file, *text) && !Json::accept(*text)) {
    print_error(console,
                file + ": is a netlist or a robot; expected an experiment, which `courant import " +
                    file + " -o FILE.json` makes of it");
    return wrong;
  }
  return reporting_errors(console, file, [&] {
    Json document = parse_json(*text);
    std::vector<Setting> changes;
    for (const std::string& text : settings) {
      changes.push_back(read_setting(text));
      apply_setting(changes.back(), document);
    }
    require_used(document, changes);
    load_tables(document, std::filesystem::path(file == "-" ? "" : file).parent_path(),
                file == "-" && tables == TableFiles::beside ? TableFiles::none : tables);
    return action(document);
  });
}

int with_experiment(const Console& console, const std::string& file,
                    const std::function<int(const Experiment&)>& action,
                    const std::vector<std::string>& settings, TableFiles tables) {
  return with_document(
      console, file,
      [&](const Json& document) {
        std::optional<Waiting> waiting(std::in_place, console, "reading the experiment");
        const Experiment experiment = read_experiment_document(document);
        waiting.reset();
        for (const auto& [where, what] : experiment.remarks)
          print_error(console, file + ": " + where + ": warning: " + what);
        return action(experiment);
      },
      settings, tables);
}

}  // namespace courant::cli
