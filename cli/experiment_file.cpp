#include "courant/cli/experiment_file.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <istream>
#include <new>
#include <optional>
#include <system_error>

#include "courant/core/message.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/running/output_file.hpp"

namespace courant::cli {
namespace {

constexpr std::size_t kLargest = std::size_t{16} << 20;  // bytes; a device may have no end

std::optional<std::string> read_text(const Console& console, const std::string& file,
                                     std::istream& stream) {
  std::string text(kLargest + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() <= kLargest) return text;
  print_error(console, file + ": is larger than 16 MB; expected an experiment");
  return std::nullopt;
}

std::optional<std::string> read_text(const Console& console, const std::string& file) {
  if (file == "-") return read_text(console, file, console.in);
  std::ifstream stream(file, std::ios::binary);
  const int error = errno;
  if (stream && !std::filesystem::is_directory(file)) return read_text(console, file, stream);
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

// Changes the value that a setting points to.
void apply(const std::string& setting, Json& document) {
  const std::size_t equals = setting.find('=');
  const std::string pointer = setting.substr(0, equals);
  const auto refuse = [&](const std::string& what) {
    throw ExperimentError("--set " + pointer, what);
  };
  if (equals == std::string::npos || pointer.empty() || pointer[0] != '/')
    refuse("is not a change; expected /json/pointer=VALUE, such as /time/step=0.1");
  const std::string text = setting.substr(equals + 1);
  Json value = Json::parse(text, nullptr, false);
  if (value.is_discarded()) value = text;
  try {
    const Json::json_pointer place(pointer);
    const Json::json_pointer above = place.parent_pointer();
    Json* const parent = document.contains(above) ? &document.at(above) : nullptr;
    if (parent && (parent->is_object() || (parent->is_array() && document.contains(place))))
      document[place] = std::move(value);
    else
      refuse("there is no such place in the experiment; expected one, or a new key of an object");
  } catch (const Json::exception&) {
    refuse("is not a JSON pointer; expected one such as /time/step");
  }
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

int with_experiment(const Console& console, const std::string& file,
                    const std::function<int(const Experiment&)>& action,
                    const std::vector<std::string>& settings) {
  const auto text = read_text(console, file);
  if (!text) return wrong;
  try {
    Json document = parse_json(*text);
    for (const std::string& setting : settings) apply(setting, document);
    return action(read_experiment_document(document));
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
