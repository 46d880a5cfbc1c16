#include "courant/cli/experiment_file.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <ostream>
#include <system_error>

namespace courant::cli {
namespace {

std::optional<std::string> read_text(const Console& console, const std::string& file) {
  if (file == "-") return std::string(std::istreambuf_iterator<char>(console.in), {});
  std::ifstream stream(file, std::ios::binary);
  const int error = errno;
  if (stream && !std::filesystem::is_directory(file))
    return std::string(std::istreambuf_iterator<char>(stream), {});
  console.err << "courant: " << file << ": cannot be read: "
              << (stream ? "is a folder" : std::generic_category().message(error)) << '\n';
  return std::nullopt;
}

void report_problems(const Console& console, const std::string& file,
                     const ExperimentError& error) {
  for (const Problem& problem : error.problems())
    console.err << "courant: " << file << ": " << problem.where
                << (problem.where.empty() ? "" : ": ") << problem.what << '\n';
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
  }
}

}  // namespace courant::cli
