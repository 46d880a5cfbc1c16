#include "courant/running/run_files.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "courant/core/files/input_file.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/reading/output.hpp"
#include "courant/running/locked_folder.hpp"

namespace courant {

namespace {

using Json = nlohmann::ordered_json;

// One line, whatever stands in the file or its name.
[[noreturn]] void refuse(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; },
      '?');
  throw RunFileError(message);
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  refuse(file.string() + ": " + what);
}

[[noreturn]] void fail(const std::filesystem::path& file, std::size_t line,
                       const std::string& what) {
  refuse(file.string() + ":" + std::to_string(line) + ": " + what);
}

std::ifstream open(const std::filesystem::path& file) {
  std::ifstream stream = input_file(file);
  if (!stream) fail(file, "cannot be read.");
  return stream;
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream = open(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    fields.emplace_back(line.substr(begin, comma - begin));
    if (comma == std::string_view::npos) return fields;
    begin = comma + 1;
  }
}

// A piece of a file as it may stand in a message: not all of a long one.
std::string excerpt(std::string_view text) {
  return '"' + std::string(text.substr(0, 40)) + (text.size() > 40 ? "…" : "") + '"';
}

// Appends the numbers of a line to the columns; what is wrong with it otherwise.
std::optional<std::string> append_row(std::string_view line,
                                      std::vector<std::vector<double>>& columns) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t field = 0; field < columns.size(); ++field) {
    double value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || (stop != end && *stop != ',')) {
      const std::string_view rest(at, static_cast<std::size_t>(end - at));
      return "field " + std::to_string(field + 1) + " is " +
             excerpt(rest.substr(0, rest.find(','))) + ", expected a number.";
    }
    const bool last = field + 1 == columns.size();
    if (last != (stop == end)) {
      const auto fields = std::count(line.begin(), line.end(), ',') + 1;
      return "the row has " + std::to_string(fields) + (fields == 1 ? " field" : " fields") +
             ", expected " + std::to_string(columns.size()) + " as in the header.";
    }
    columns[field].push_back(value);
    at = last ? stop : stop + 1;
  }
  return std::nullopt;
}

// The value of a key in the header of an .npy file, up to the next of `stops`.
std::string_view npy_entry(std::string_view header, std::string_view key, std::string_view stops) {
  const std::size_t found = header.find(key);
  if (found == std::string_view::npos) return {};
  std::size_t begin = header.find(':', found);
  if (begin == std::string_view::npos) return {};
  begin = header.find_first_not_of(' ', begin + 1);
  if (begin == std::string_view::npos) return {};
  return header.substr(begin, header.find_first_of(stops, begin) - begin);
}

}  // namespace

TrajectoryTable::TrajectoryTable(std::vector<std::string> names,
                                 std::vector<std::vector<double>> columns)
    : names_(std::move(names)), columns_(std::move(columns)) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("TrajectoryTable: " + what);
  };
  if (names_.empty() || names_.front() != "t") {
    reject("the first column is " + (names_.empty() ? "missing" : excerpt(names_.front())) +
           ", expected t.");
  }
  if (columns_.size() != names_.size()) {
    reject("there are " + std::to_string(columns_.size()) + " columns, expected " +
           std::to_string(names_.size()) + " as there are names.");
  }
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!places_.try_emplace(names_[i], i).second)
      reject("two columns have the name " + excerpt(names_[i]) + ".");
    if (columns_[i].size() != rows()) {
      reject("column " + excerpt(names_[i]) + " has " + std::to_string(columns_[i].size()) +
             " rows, expected " + std::to_string(rows()) + ".");
    }
  }
}

bool TrajectoryTable::contains(std::string_view name) const { return places_.contains(name); }

std::span<const double> TrajectoryTable::column(std::string_view name) const {
  const auto found = places_.find(name);
  if (found == places_.end()) {
    throw std::invalid_argument("TrajectoryTable::column: there is no column " + excerpt(name) +
                                ".");
  }
  return columns_[found->second];
}

std::vector<std::string> Run::constraints() const {
  std::vector<std::string> found;
  for (const std::string& name : trajectory.names()) {
    if (name.starts_with("constraint[")) found.push_back(name);
  }
  return found;
}

std::vector<std::string> Run::observables() const {
  std::vector<std::string> found;
  for (const std::string& name : trajectory.names()) {
    if (name == "H" || summary.observable(name)) found.push_back(name);
  }
  return found;
}

std::vector<std::string> Run::coordinates() const {
  const std::vector<std::string> measured = observables();
  std::vector<std::string> found;
  for (const std::string& name : trajectory.names()) {
    const bool other = name == "t" || name.starts_with("constraint[") ||
                       std::find(measured.begin(), measured.end(), name) != measured.end();
    if (!other) found.push_back(name);
  }
  return found;
}

std::string Run::axis_label(const std::string& quantity) const {
  const auto text = [&](const char* key) {
    std::map<std::string, std::string, std::less<>> entries;
    const Json output = experiment.is_object() ? experiment.value("output", Json()) : Json();
    const Json list = output.is_object() ? output.value(key, Json()) : Json();
    if (list.is_object())
      for (const auto& [name, entry] : list.items())
        if (entry.is_string()) entries[name] = entry.get<std::string>();
    const std::string* found = entry_of(entries, quantity);
    return found ? *found : std::string();
  };
  const std::string label = text("labels"), unit = text("units");
  return (label.empty() ? quantity : label) + (unit.empty() ? "" : " [" + unit + "]");
}

namespace {

// The id of a run in its summary and experiment, and its last state in summary and trajectory.
void check_one_run(const Run& run, const std::filesystem::path& experiment,
                   const std::filesystem::path& trajectory) {
  if (run.summary.id.empty() || !run.experiment.is_object()) return;
  if (run.experiment.value("$run", Json()) != run.summary.id)
    fail(experiment, "is of another run than summary.json.");
  if (run.summary.status != RunStatus::completed || run.trajectory.rows() == 0) return;
  for (const auto& [name, value] : run.summary.final)
    if (!std::isnan(value) && run.trajectory.contains(name) &&
        run.trajectory.column(name).back() != value)
      fail(trajectory, "is of another run than summary.json: " + name + " ends elsewhere.");
}

// How many steps led to the last row, of a run that had no time to count them; 0 where steps are not of the time of rows.
long steps_of_rows(const Run& run) {
  const auto& time = run.summary.time;
  const Json* const asked = run.experiment.contains("time") ? &run.experiment.at("time") : nullptr;
  const bool is_transformed = asked && asked->is_object() && asked->contains("transformation");
  if (!time || !(time->step > 0.0) || is_transformed || run.trajectory.rows() == 0) return 0;
  return std::lround((run.trajectory.column("t").back() - time->start) / time->step);
}

}  // namespace

std::vector<std::filesystem::path> run_folders_in(const std::filesystem::path& directory) {
  const std::filesystem::path table = directory / "sweep.json";
  std::error_code error;
  if (!std::filesystem::is_regular_file(table, error)) return {directory};
  std::vector<std::filesystem::path> folders;
  try {
    const nlohmann::ordered_json sweep = read_json(table);
    for (const auto& row : sweep.at("runs")) {
      const std::filesystem::path folder = row.at("folder").get<std::string>();
      if (!folder.empty() && !folder.has_parent_path() && folder != "..")
        if (std::filesystem::exists(directory / folder / "summary.json", error))
          folders.push_back(directory / folder);
    }
  } catch (const nlohmann::ordered_json::exception&) {
    throw RunFileError(table.string() + ": its table is not one of a sweep.");
  }
  if (folders.empty()) throw RunFileError(directory.string() + ": there is no run in this sweep.");
  return folders;
}

bool is_ensemble_folder(const std::filesystem::path& directory) {
  return file_exists(directory / "ensemble.npy");
}

Run read_run(const std::filesystem::path& directory) {
  std::error_code unreadable;
  if (!std::filesystem::is_directory(directory, unreadable))
    fail(directory, "is not a folder; expected that of a run.");
  const auto csv = directory / "trajectory.csv", npy = directory / "trajectory.npy";
  const auto summary = directory / "summary.json", experiment = directory / "experiment.json";
  if (is_ensemble_folder(directory))
    fail(directory,
         "has an ensemble of many runs; expected the folder of one, or `courant plot DIR --figure "
         "ensemble` for how its members are spread.");
  if (!file_exists(csv) && !file_exists(npy))
    fail(directory, "has no trajectory.csv or trajectory.npy.");
  RunSummary told = read_summary(summary);
  const bool ended = told.status != RunStatus::running;
  if (!ended)
    told.message = LockedFolder::is_in_use(directory) ? "The run has not ended yet."
                                                      : "The run did not end: it was killed.";
  const auto trajectory = [&] {
    if (file_exists(csv)) return read_trajectory_csv(csv, !ended);
    const auto names = directory / "columns.json";
    const Json columns = read_json(names);
    const bool strings =
        columns.is_array() &&
        std::all_of(columns.begin(), columns.end(), [](const Json& c) { return c.is_string(); });
    if (!strings) fail(names, "is not an array of names.");
    return read_trajectory_npy(npy, columns.get<std::vector<std::string>>(), !ended);
  };
  // A name even for "." and "runs/a/".
  const auto whole = std::filesystem::absolute(directory).lexically_normal();
  const auto name = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
  Run run{.name = name.string(),
          .trajectory = trajectory(),
          .summary = std::move(told),
          .experiment = read_json(experiment)};
  if (!ended) run.summary.steps = steps_of_rows(run);
  if (const auto events = directory / "events.csv"; file_exists(events))
    run.events = read_events_csv(events, !ended);
  check_one_run(run, experiment, file_exists(csv) ? csv : npy);
  return run;
}

TrajectoryTable read_trajectory_csv(const std::filesystem::path& file, bool torn) {
  std::ifstream stream = open(file);
  std::string line;
  if (!std::getline(stream, line) || stream.eof())
    fail(file, 1, "the header is missing or cut off.");
  std::vector<std::string> names = split(line);
  std::ranges::transform(names, names.begin(), without_unit);
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t number = 2; std::getline(stream, line); ++number) {
    if (stream.eof() && torn) break;
    if (stream.eof()) fail(file, number, "the row has no line end: the file is cut off.");
    if (const auto defect = append_row(line, columns)) fail(file, number, *defect);
  }
  try {
    return {std::move(names), std::move(columns)};
  } catch (const std::invalid_argument& error) {
    fail(file, 1, error.what());
  }
}

std::map<std::string, TrajectoryTable> read_events_csv(const std::filesystem::path& file,
                                                       bool torn) {
  std::ifstream stream = open(file);
  std::string line;
  if (!std::getline(stream, line) || stream.eof())
    fail(file, 1, "the header is missing or cut off.");
  std::vector<std::string> names = split(line);
  if (names.front() != "event")
    fail(file, 1, "the first column is " + excerpt(names.front()) + ", expected event.");
  names.erase(names.begin());
  std::ranges::transform(names, names.begin(), without_unit);
  std::map<std::string, std::vector<std::vector<double>>> columns;
  for (std::size_t number = 2; std::getline(stream, line); ++number) {
    if (stream.eof() && torn) break;
    if (stream.eof()) fail(file, number, "the row has no line end: the file is cut off.");
    const std::size_t comma = std::min(line.find(','), line.size());
    auto& of_event = columns[line.substr(0, comma)];
    of_event.resize(names.size());
    const std::string_view numbers =
        std::string_view(line).substr(std::min(comma + 1, line.size()));
    if (const auto defect = append_row(numbers, of_event)) fail(file, number, *defect);
  }
  std::map<std::string, TrajectoryTable> events;
  for (auto& [event, values] : columns) {
    try {
      events.emplace(event, TrajectoryTable(names, std::move(values)));
    } catch (const std::invalid_argument& error) {
      fail(file, 1, error.what());
    }
  }
  return events;
}

TrajectoryTable read_trajectory_npy(const std::filesystem::path& file,
                                    std::vector<std::string> names, bool torn) {
  static_assert(std::endian::native == std::endian::little);
  const std::string bytes = read_text(file);
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<std::uint8_t>(bytes[i]));
  };
  if (!bytes.starts_with("\x93NUMPY") || bytes.size() < 12) fail(file, "is not an .npy file.");
  const bool first_version = byte(6) == 1;
  const std::size_t start = first_version ? 10 : 12;
  const std::size_t size =
      byte(8) + (byte(9) << 8) + (first_version ? 0 : (byte(10) << 16) + (byte(11) << 24));
  if (bytes.size() < start + size) fail(file, "the header is cut off.");

  const std::string_view header = std::string_view(bytes).substr(start, size);
  const std::string_view type = npy_entry(header, "'descr'", ",}");
  if (type != "'<f8'")
    fail(file, "the numbers are " + excerpt(type) + ", expected '<f8', float64.");
  const bool by_column = npy_entry(header, "'fortran_order'", ",}") == "True";
  const std::string_view shape = npy_entry(header, "'shape'", ")");
  std::size_t rows = 0, width = 0;
  const char* const end = shape.data() + shape.size();
  const auto first =
      std::from_chars(shape.data() + std::min<std::size_t>(1, shape.size()), end, rows);
  const char* const second =
      std::find_if(first.ptr, end, [](char c) { return c >= '0' && c <= '9'; });
  if (first.ec != std::errc{} || std::from_chars(second, end, width).ec != std::errc{}) {
    fail(file, "the shape is " + excerpt(shape) + ", expected (rows, columns).");
  }
  if (width != names.size()) {
    fail(file, "has " + std::to_string(width) + " columns, expected " +
                   std::to_string(names.size()) + " as in columns.json.");
  }
  const std::size_t expected = rows * width * sizeof(double), found = bytes.size() - start - size;
  if (torn ? found < expected : found != expected) {
    fail(file, "has " + std::to_string(found) + " bytes of numbers, expected " +
                   std::to_string(expected) + " for its shape.");
  }
  std::vector<std::vector<double>> columns(width, std::vector<double>(rows));
  const char* at = bytes.data() + start + size;
  const auto take = [&](double& value) {
    std::memcpy(&value, at, sizeof(double));
    at += sizeof(double);
  };
  if (by_column) {
    for (auto& column : columns) std::for_each(column.begin(), column.end(), take);
  } else {
    for (std::size_t row = 0; row < rows; ++row) {
      for (auto& column : columns) take(column[row]);
    }
  }
  std::ranges::transform(names, names.begin(), without_unit);
  try {
    return {std::move(names), std::move(columns)};
  } catch (const std::invalid_argument& error) {
    fail(file, error.what());
  }
}

Json read_json(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  try {
    return parse_written_json(text);
  } catch (const std::invalid_argument& error) {
    fail(file, error.what());
  } catch (const Json::parse_error& error) {
    // byte counts from 1, and is one past the end when the file ends too early.
    const auto before = static_cast<std::ptrdiff_t>(std::min(error.byte, text.size() + 1)) - 1;
    const auto lines =
        std::count(text.begin(), text.begin() + std::max<std::ptrdiff_t>(before, 0), '\n');
    const std::string_view what = error.what();
    const std::size_t reason = what.find("syntax error");
    fail(file, static_cast<std::size_t>(lines) + 1,
         "is not JSON: " +
             std::string(reason == std::string_view::npos ? what : what.substr(reason)) + ".");
  }
}

RunSummary read_summary(const std::filesystem::path& file) {
  const Json json = read_json(file);
  try {
    return read_run_summary(json);
  } catch (const std::invalid_argument& error) {
    fail(file, error.what());
  }
}

}  // namespace courant
