#include "courant/cli/experiment_file.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <optional>
#include <system_error>

#include "courant/core/message.hpp"
#include "courant/running/output_file.hpp"

namespace courant::cli {
namespace {

std::optional<std::string> read_text(const Console& console, const std::string& file) {
  if (file == "-") return std::string(std::istreambuf_iterator<char>(console.in), {});
  std::ifstream stream(file, std::ios::binary);
  const int error = errno;
  if (stream && !std::filesystem::is_directory(file))
    return std::string(std::istreambuf_iterator<char>(stream), {});
  print_error(console, file + ": cannot be read: " +
                           (stream ? "is a folder" : std::generic_category().message(error)));
  return std::nullopt;
}

void report_problems(const Console& console, const std::string& file,
                     const ExperimentError& error) {
  for (const Problem& problem : error.problems())
    print_error(console,
                file + ": " + problem.where + (problem.where.empty() ? "" : ": ") + problem.what);
}

}  // namespace

int with_experiment(const Console& console, const std::string& file,
                    const std::function<int(const Experiment&)>& action) {
  const auto text = read_text(console, file);
  if (!text) return wrong;
  try {
    return action(read_experiment(*text));
  } catch (const ExperimentError& error) {
    report_problems(console, file, error);
    return wrong;
  } catch (const OutputError&) {
    throw;  // says which file
  } catch (const std::bad_alloc&) {
    print_error(console, file + ": takes more memory than there is");
  } catch (const std::exception& error) {
    print_error(console, file + ": " + without_place(error.what()));
  }
  return failed;
}

}  // namespace courant::cli
