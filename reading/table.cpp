#include "courant/reading/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include "courant/core/files/input_file.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/reading/mesh_file.hpp"

namespace courant {
namespace {

// More would make formulas that take longer than a step should.
constexpr std::size_t kMostRows = 20000;

std::optional<VectorXd> read_numbers(const std::optional<JsonReader>& key) {
  const auto elements = key ? key->elements() : std::nullopt;
  if (!elements) return std::nullopt;
  VectorXd numbers(std::ssize(*elements));
  bool right = true;
  for (Index i = 0; i < numbers.size(); ++i) {
    const auto number = (*elements)[static_cast<std::size_t>(i)].number();
    right = right && number.has_value();
    if (number) numbers[i] = *number;
  }
  return right ? std::optional(numbers) : std::nullopt;
}

std::optional<Table> read_table(const JsonReader& value) {
  ObjectReader object(value);
  if (!value.value().is_object()) return std::nullopt;
  if (value.value().contains("file")) {
    object.optional("file");
    object.optional("time");
    object.optional("column");
    object.optional("interpolation");
    value.problem("is in a file, which only the command reads; expected \"times\" and \"values\"");
    return std::nullopt;
  }
  const auto times_key = object.required("times"), values_key = object.required("values");
  const std::string word = object.word("interpolation", "linear", {"steps", "linear", "cubic"});
  const auto times = read_numbers(times_key), values = read_numbers(values_key);
  if (!times || !values) return std::nullopt;
  if (times->size() == 0 || times->size() != values->size()) {
    values_key->problem("has " + std::to_string(values->size()) + " numbers for " +
                        std::to_string(times->size()) + " times; expected as many, one at least");
    return std::nullopt;
  }
  if (static_cast<std::size_t>(times->size()) > kMostRows) {
    times_key->problem("has " + std::to_string(times->size()) + " numbers; expected at most " +
                       std::to_string(kMostRows));
    return std::nullopt;
  }
  for (Index i = 1; i < times->size(); ++i)
    if (!((*times)[i] > (*times)[i - 1])) {
      times_key->problem("has no greater number after that at " + std::to_string(i - 1) +
                         "; expected increasing times");
      return std::nullopt;
    }
  const Table table{*times, *values,
                    word == "steps"   ? Interpolation::steps
                    : word == "cubic" ? Interpolation::cubic
                                      : Interpolation::linear};
  try {
    table.at((*times)[0]);
  } catch (const std::invalid_argument&) {
    values_key->refused();
    return std::nullopt;
  }
  return table;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  for (const char c : line) {
    if (c == ',')
      result.emplace_back();
    else if (c != '\r')
      result.back() += c;
  }
  for (std::string& cell : result) {
    const std::size_t first = cell.find_first_not_of(" \t\"");
    const std::size_t last = cell.find_last_not_of(" \t\"");
    cell = first == std::string::npos ? "" : cell.substr(first, last - first + 1);
  }
  return result;
}

// One table that may be in a file.
class File {
 public:
  File(const std::string& pointer, TableFile file) : pointer_(pointer), file_(std::move(file)) {}

  Json load(const Json& table) {
    const std::vector<std::string> names = open();
    const std::size_t time = column(table, "time", names, 0);
    const std::size_t value = column(table, "column", names, 1);
    Json times = Json::array(), values = Json::array();
    for_each_row(names, kMostRows, [&](const std::vector<std::string>& row) {
      times.push_back(number(row[time]));
      values.push_back(number(row[value]));
    });
    Json result = {{"times", times}, {"values", values}};
    if (table.contains("interpolation")) result["interpolation"] = table["interpolation"];
    for (const auto& [key, entry] : table.items())
      if (key != "file" && key != "time" && key != "column" && key != "interpolation")
        result[key] = entry;  // is told of as unknown
    return result;
  }

  // All columns by their names, as lists of numbers.
  Json columns(std::size_t most) {
    const std::vector<std::string> names = open();
    std::vector<std::vector<double>> numbers(names.size());
    for_each_row(names, most, [&](const std::vector<std::string>& row) {
      for (std::size_t k = 0; k < row.size(); ++k) numbers[k].push_back(number(row[k]));
    });
    line_ = 0;
    if (numbers.front().empty())
      refuse("has no rows; expected one for each member under its names");
    Json result = Json::object();
    for (std::size_t k = 0; k < names.size(); ++k) {
      line_ = 1;
      if (names[k].empty()) refuse("has a column without a name");
      if (result.contains(names[k])) refuse("has two columns " + names[k]);
      result[names[k]] = std::move(numbers[k]);
    }
    return result;
  }

 private:
  // The names in the first line.
  std::vector<std::string> open() {
    if (!file_.bytes) refuse("cannot be read; expected a file of comma-separated values");
    std::string line;
    if (!std::getline(*file_.bytes, line)) refuse("is empty; expected names in its first line");
    return cells(line);
  }

  // The lines below that have something in them.
  template <class Action>
  void for_each_row(const std::vector<std::string>& names, std::size_t most, const Action& action) {
    std::size_t rows = 0;
    std::string line;
    for (line_ = 2; std::getline(*file_.bytes, line); ++line_) {
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      const std::vector<std::string> row = cells(line);
      if (row.size() != names.size())
        refuse("has " + std::to_string(row.size()) + " cells; expected " +
               std::to_string(names.size()));
      action(row);
      if (++rows > most) refuse("is more than row " + std::to_string(most) + "; expected fewer");
    }
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw ExperimentError(pointer_,
                          file_.name + (line_ > 0 ? ":" + std::to_string(line_) : "") + " " + what);
  }

  std::size_t column(const Json& table, const char* key, const std::vector<std::string>& names,
                     std::size_t otherwise) const {
    if (!table.contains(key)) {
      if (otherwise < names.size()) return otherwise;
      refuse("has one column; expected one of times and one of values");
    }
    const std::string name = table[key].is_string() ? table[key].get<std::string>() : "";
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) refuse("has no column \"" + name + "\"" + did_you_mean(name, names));
    return static_cast<std::size_t>(found - names.begin());
  }

  double number(const std::string& cell) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
      refuse("has \"" + cell + "\"; expected a number");
    return value;
  }

  std::string pointer_;
  TableFile file_;
  std::size_t line_ = 0;
};

}  // namespace

std::vector<std::pair<std::string, Table>> read_tables(const JsonReader& object) {
  std::vector<std::pair<std::string, Table>> tables;
  const auto entries = object.entries();
  if (!entries) return tables;
  for (const auto& [name, value] : *entries)
    if (auto table = read_table(value)) tables.emplace_back(name, std::move(*table));
  return tables;
}

namespace {

// Throws ExperimentError if the file may not be named.
void require_allowed(const std::string& pointer, const std::filesystem::path& file,
                     const std::filesystem::path& folder, TableFiles which) {
  if (which == TableFiles::anywhere) return;
  const auto refuse = [&](const char* expected) {
    throw ExperimentError(pointer, "is " + file.string() +
                                       ", and the experiment is not "
                                       "trusted; expected " +
                                       expected);
  };
  if (which == TableFiles::none) refuse("its numbers in the experiment");
  std::error_code error;
  const auto home = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error);
  const auto there = std::filesystem::weakly_canonical(folder / file, error);
  if (error ||
      std::mismatch(home.begin(), home.end(), there.begin(), there.end()).first != home.end())
    refuse("a file in the folder of the experiment");
}

TableFile opened(const std::filesystem::path& path) {
  auto stream = std::make_unique<std::ifstream>(input_file(path));
  if (!*stream) stream.reset();
  return {path.string(), std::move(stream)};
}

// The vertices, simplices and facets of {"mesh": "drum.msh"} come to stand in its place, beside what else is there.
void load_mesh(Json& complex, const std::string& pointer, const OpenTable& open) {
  if (!complex.is_object() || !complex.contains("mesh") || !complex["mesh"].is_string()) return;
  const std::string place = pointer + "/mesh";
  const TableFile file = open(place, complex["mesh"].get<std::string>());
  if (!file.bytes)
    throw ExperimentError(place, file.name + " cannot be read; expected a mesh of Gmsh");
  try {
    const Json parts = read_mesh(*file.bytes);
    for (const auto& [key, value] : parts.items())
      if (complex.contains(key))
        throw ExperimentError(pointer + "/" + key, "is in " + file.name + " too; expected it once");
    complex.erase("mesh");
    complex.update(parts);
  } catch (const MeshError& error) {
    throw ExperimentError(place, file.name +
                                     (error.line() > 0 ? ":" + std::to_string(error.line()) : "") +
                                     " " + error.what());
  }
}

// In a system, and in those that it is made of.
void load_tables_of(Json& system, const std::string& pointer, const OpenTable& open) {
  if (!system.is_object()) return;
  if (system.contains("tables") && system["tables"].is_object())
    for (auto& [name, table] : system["tables"].items())
      if (table.is_object() && table.contains("file") && table["file"].is_string()) {
        const std::string place = pointer + "/tables/" + name;
        table = File(place, open(place + "/file", table["file"].get<std::string>())).load(table);
      }
  if (system.contains("complex")) load_mesh(system["complex"], pointer + "/complex", open);
  if (system.contains("systems") && system["systems"].is_object())
    for (auto& [name, part] : system["systems"].items())
      load_tables_of(part, pointer + "/systems/" + name, open);
}

// The columns of {"table": "starts.csv"} come to stand in its place as lists under "values", before what is there.
void load_ensemble(Json& ensemble, const OpenTable& open) {
  constexpr std::size_t most = 10'000'000;  // members, as Ensemble::kMostMembers
  const std::string place = "/ensemble/table";
  if (!ensemble.is_object() || !ensemble.contains("table") || !ensemble["table"].is_string())
    return;
  const std::string file = ensemble["table"].get<std::string>();
  Json columns = File(place, open(place, file)).columns(most);
  Json values = ensemble.value("values", Json::object());
  if (values.is_object())
    for (const auto& [name, value] : values.items()) {
      if (columns.contains(name))
        throw ExperimentError("/ensemble/values/" + pointer_token(name),
                              "is a column of " + file + " too; expected it once");
      columns[name] = value;
    }
  ensemble.erase("table");
  ensemble["values"] = std::move(columns);
}

}  // namespace

void load_tables(Json& document, const OpenTable& open) {
  if (!document.is_object()) return;
  if (document.contains("system")) load_tables_of(document["system"], "/system", open);
  if (document.contains("ensemble")) load_ensemble(document["ensemble"], open);
}

void load_tables(Json& document, const std::filesystem::path& folder, TableFiles which) {
  load_tables(document, [&](const std::string& pointer, const std::string& file) {
    require_allowed(pointer, file, folder, which);
    return opened(folder / file);
  });
}

}  // namespace courant
