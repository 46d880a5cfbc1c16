#include "courant/running/ensemble_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <utility>

#include "courant/core/files/content_hash.hpp"
#include "courant/core/files/input_file.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/words/message.hpp"
#include "courant/running/npy_header.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

std::string_view bytes_of(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

// A line of members.jsonl; `hash` is that of the numbers of the member.
std::string line_of(const EnsembleMember& member, const std::string& hash) {
  Json expectations = Json::array();
  for (const ExpectationResult& one : member.expectations)
    expectations.push_back(
        {one.pointer, one.description, one.passed, one.value, one.bound, one.finding});
  const Json line{{"member", member.number},
                  {"status", to_string(member.status)},
                  {"message", member.message},
                  {"warning", member.warning},
                  {"steps", member.steps},
                  {"max_drift", member.max_drift},
                  {"max_violation", member.max_violation},
                  {"ladder", member.ladder},
                  {"rows", member.rows.size()},
                  {"hash", hash},
                  {"expectations", expectations}};
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

double number_at(const Json& line, const char* key) {
  return line.at(key).is_number() ? line.at(key).get<double>() : EnsembleMember::kUnknown;
}

// The member of such a line, without its rows. Throws Json::exception.
EnsembleMember member_of(const Json& line) {
  EnsembleMember member{.number = line.at("member").get<Index>(),
                        .message = line.at("message").get<std::string>(),
                        .warning = line.at("warning").get<std::string>(),
                        .steps = line.at("steps").get<long>(),
                        .max_drift = number_at(line, "max_drift"),
                        .max_violation = number_at(line, "max_violation"),
                        .ladder = line.at("ladder").get<std::string>()};
  const std::string status = line.at("status").get<std::string>();
  for (const RunStatus one : {RunStatus::completed, RunStatus::failed, RunStatus::not_finite})
    if (status == to_string(one)) member.status = one;
  for (const Json& one : line.at("expectations"))
    member.expectations.push_back({.pointer = one.at(0).get<std::string>(),
                                   .description = one.at(1).get<std::string>(),
                                   .passed = one.at(2).get<bool>(),
                                   .value = one.at(3),
                                   .bound = one.at(4),
                                   .finding = one.at(5).get<std::string>()});
  return member;
}

}  // namespace

EnsembleFolder::EnsembleFolder(fs::path path, ExistingRun existing)
    : path_(std::move(path)), existing_(existing) {}

void EnsembleFolder::check(const Experiment& experiment) {
  RunFolder::check(path_, existing_, experiment);
}

std::string EnsembleFolder::header() const {
  return npy_header({static_cast<std::size_t>(count_), static_cast<std::size_t>(opening_.rows),
                     opening_.columns.size()});
}

void EnsembleFolder::begin(const Experiment& experiment, const EnsembleOpening& opening,
                           const std::function<void(const EnsembleMember&)>& recall) {
  opening_ = opening;
  folder_.emplace(path_, existing_, experiment);
  if (existing_ == ExistingRun::resume && file_exists(file("members.jsonl")))
    return recall_members(recall);
  write_file(file("columns.json"), Json(opening_.columns).dump() + "\n");
  numbers_.emplace(file("ensemble.npy"), header());
  members_.emplace(file("members.jsonl"));
  if (opening_.event_columns.empty()) return;
  events_.emplace(file("events.csv"));
  std::string head = "member,event";
  for (const std::string& column : opening_.event_columns) head += "," + column;
  events_->append(head + "\n");
  events_->flush();
}

// Members that have a whole line in members.jsonl, and the numbers that it was written for.
void EnsembleFolder::recall_members(const std::function<void(const EnsembleMember&)>& recall) {
  const auto size = static_cast<std::size_t>(opening_.numbers_of_member());
  const fs::path numbers = file("ensemble.npy"), lines = file("members.jsonl");
  for (const fs::path& one : {numbers, lines})
    if (!file_exists(one) || fs::is_symlink(one))
      refuse_folder(one, "is not there; expected the file that the ensemble wrote");
  std::ifstream members = input_file(lines), values = input_file(numbers);
  std::string head(kNpyHeader, '\0');
  values.read(head.data(), static_cast<std::streamsize>(head.size()));
  const std::string shape = ", " + std::to_string(opening_.rows) + ", " +
                            std::to_string(opening_.columns.size()) + "), }";
  if (head.find(shape) == std::string::npos)
    refuse_folder(numbers, "has not " + std::to_string(opening_.rows) + " rows × " +
                               std::to_string(opening_.columns.size()) +
                               " columns for each member; expected the experiment as it was, or "
                               "--force to begin anew");
  HashedBytes known_lines, known_numbers;
  std::vector<double> block(size);
  for (std::string line; count_ < opening_.members && std::getline(members, line);) {
    if (members.eof()) break;  // cut off before its end
    const auto refuse = [&](const fs::path& where) {
      refuse_folder(where, "member " + std::to_string(count_) +
                               " is not as it was written; expected it whole, or --force to begin "
                               "anew");
    };
    const Json json = Json::parse(line, nullptr, false);
    EnsembleMember member;
    std::size_t rows = 0;
    std::string hash;
    try {
      member = member_of(json);
      rows = json.at("rows").get<std::size_t>();
      hash = json.at("hash").get<std::string>();
    } catch (const Json::exception&) {
      refuse(lines);
    }
    if (member.number != count_ || rows > size) refuse(lines);
    values.read(reinterpret_cast<char*>(block.data()),
                static_cast<std::streamsize>(size * sizeof(double)));
    if (!values || content_hash(bytes_of(block)) != hash) refuse(numbers);
    member.rows.assign(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(rows));
    known_numbers.append(bytes_of(block));
    known_lines.append(line + "\n");
    ++count_;
    recall(member);
  }
  std::optional<HashedBytes> known_events;
  if (!opening_.event_columns.empty()) {
    known_events.emplace();
    std::ifstream events = input_file(file("events.csv"));
    bool is_head = true;
    for (std::string line; std::getline(events, line) && !events.eof(); is_head = false) {
      if (!is_head && std::strtoll(line.c_str(), nullptr, 10) >= count_) break;
      known_events->append(line + "\n");
    }
  }
  numbers_.emplace(numbers, header(), known_numbers.record());
  members_.emplace(lines, "", known_lines.record());
  if (known_events) events_.emplace(file("events.csv"), "", known_events->record());
  flush();
}

void EnsembleFolder::append(const EnsembleMember& member) {
  std::vector<double> block = member.rows;
  block.resize(static_cast<std::size_t>(opening_.numbers_of_member()), EnsembleMember::kUnknown);
  if (events_)
    for (const auto& [name, values] : member.events) {
      std::string line = std::to_string(member.number) + "," + name;
      for (const double value : values) line += "," + exact_text(value);
      events_->append(line + "\n");
    }
  numbers_->append(bytes_of(block));
  ++count_;
  members_->append(line_of(member, content_hash(bytes_of(block))));
  constexpr auto often = std::chrono::milliseconds(250);
  if (numbers_->is_full() || members_->is_full() ||
      std::chrono::steady_clock::now() - flushed_ > often)
    flush();
}

// A member counts once its line is there, which is written last.
void EnsembleFolder::flush() {
  if (events_) events_->flush();
  numbers_->flush();
  numbers_->replace_head(header());
  members_->flush();
  flushed_ = std::chrono::steady_clock::now();
}

void EnsembleFolder::tell(const Json& summary, const std::string& statistics) {
  flush();
  if (!statistics.empty()) write_file(file("statistics.csv"), statistics);
  folder_->write_summary(summary);
}

EnsembleTables read_ensemble_tables(const fs::path& folder) {
  return {read_json(folder / "summary.json"), read_trajectory_csv(folder / "statistics.csv")};
}

}  // namespace courant
