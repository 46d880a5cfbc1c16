#include "courant/running/checkpoint.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <map>
#include <type_traits>

#include "courant/core/files/output_file.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/version.hpp"
#include "courant/running/run_files.hpp"

namespace courant {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no word for numbers that are not finite.
Json written(double value) { return std::isfinite(value) ? Json(value) : Json(exact_text(value)); }

Json written(const VectorXd& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(written(value));
  return json;
}

Json written(const MatrixXd& rows) {
  Json json = Json::array();
  for (Index i = 0; i < rows.rows(); ++i) json.push_back(written(VectorXd(rows.row(i))));
  return json;
}

void read(const Json& json, double& value) {
  if (json.is_number()) {
    value = json.get<double>();
    return;
  }
  const auto word = json.get<std::string>();
  const double infinity = std::numeric_limits<double>::infinity();
  if (word == "inf" || word == "-inf")
    value = word == "inf" ? infinity : -infinity;
  else if (word == "nan" || word == "-nan")
    value = std::copysign(std::numeric_limits<double>::quiet_NaN(), word == "nan" ? 1.0 : -1.0);
  else
    throw RunFileError(word + " is no number");
}

void read(const Json& json, VectorXd& values) {
  values.resize(static_cast<Index>(json.size()));
  Index i = 0;
  for (const Json& entry : json) read(entry, values[i++]);
}

void read(const Json& json, MatrixXd& rows) {
  VectorXd row;
  for (Index i = 0; i < static_cast<Index>(json.size()); ++i) {
    read(json[static_cast<std::size_t>(i)], row);
    if (i == 0) rows.resize(static_cast<Index>(json.size()), row.size());
    if (row.size() != rows.cols()) throw RunFileError("a matrix has rows of different lengths");
    rows.row(i) = row;
  }
}

using NamedNumbers = std::map<std::string, double, std::less<>>;

// Objects, the keys as text.
Json written(const std::map<long, NamedNumbers>& rows) {
  Json json = Json::object();
  for (const auto& [number, row] : rows)
    for (const auto& [name, value] : row) json[std::to_string(number)][name] = written(value);
  return json;
}

void read(const Json& json, std::map<long, NamedNumbers>& rows) {
  for (const auto& [number, row] : json.items())
    for (const auto& [name, value] : row.items()) read(value, rows[std::stol(number)][name]);
}

Json written(const std::map<std::string, EventRecord>& records);
void read(const Json& json, std::map<std::string, EventRecord>& records);

void read(const Json& json, std::uintmax_t& value) { value = json.get<std::uintmax_t>(); }
void read(const Json& json, HashedBytes::Record& record) {
  read(json.at("size"), record.size);
  read(json.at("part"), record.part);
  record.hashes = json.at("hashes").get<std::vector<std::uintmax_t>>();
}
Json written(const HashedBytes::Record& record) {
  return {{"size", record.size}, {"part", record.part}, {"hashes", record.hashes}};
}
void read(const Json& json, std::set<long>& numbers) { numbers = json.get<std::set<long>>(); }
Json written(const std::set<long>& numbers) { return numbers; }
void read(const Json& json, bool& value) { value = json.get<bool>(); }
void read(const Json& json, long& value) { value = json.get<long>(); }
void read(const Json& json, std::string& value) { value = json.get<std::string>(); }

Json written(bool value) { return value; }
Json written(long value) { return value; }
Json written(const std::string& value) { return value; }

template <class T, class Record>
concept Is = std::same_as<std::remove_const_t<T>, Record>;

// The members of each record under their names; `visit` is given one after the other.
void each_member(Is<State> auto& state, const auto& visit) {
  visit("t", state.t);
  visit("x", state.x);
  visit("v", state.v);
  visit("z", state.z);
  visit("carried", state.carried);
}

void each_member(Is<Motion> auto& motion, const auto& visit) {
  visit("is_predictable", motion.is_predictable);
  visit("displacements", motion.displacements);
}

void each_member(Is<SolverStatistics> auto& solver, const auto& visit) {
  visit("steps", solver.steps);
  visit("iterations", solver.iterations);
  visit("factorizations", solver.factorizations);
  visit("failures", solver.failures);
  visit("second_attempts", solver.second_attempts);
  visit("confirmations", solver.confirmations);
  visit("divisions", solver.divisions);
}

void each_member(Is<QuantityStatistics::Memory> auto& statistics, const auto& visit) {
  visit("count", statistics.count);
  visit("initial", statistics.initial);
  visit("final", statistics.final);
  visit("min", statistics.min);
  visit("max", statistics.max);
  visit("mean_t", statistics.mean_t);
  visit("variation", statistics.variation);
  visit("mean", statistics.mean);
  visit("covariation", statistics.covariation);
}

void each_member(Is<NotFinite> auto& found, const auto& visit) {
  visit("t", found.t);
  visit("value", found.value);
  visit("column", found.column);
}

void each_member(Is<EnergyWatch::Memory> auto& energy_watch, const auto& visit) {
  visit("initial", energy_watch.initial);
  visit("largest", energy_watch.largest);
  visit("looked_at", energy_watch.looked_at);
  visit("found_at", energy_watch.found_at);
  visit("finding", energy_watch.finding);
}

void each_member(Is<LadderWatch::Memory> auto& ladder_watch, const auto& visit) {
  visit("largest", ladder_watch.largest);
  visit("last", ladder_watch.last);
  visit("before_last", ladder_watch.before_last);
  visit("last_time", ladder_watch.last_time);
}

void each_member(Is<EventRecord> auto& event, const auto& visit) {
  visit("count", event.count);
  visit("first", event.first);
  visit("last", event.last);
  visit("occurrences", event.occurrences);
}

void each_member(Is<EventWatch::Memory> auto& event_watch, const auto& visit) {
  visit("values", event_watch.values);
  visit("records", event_watch.records);
  visit("behind", event_watch.behind);
  visit("file", event_watch.file);
}

void each_member(Is<TangentMap::Memory> auto& tangent_map, const auto& visit) {
  visit("first", tangent_map.first);
  visit("present", tangent_map.present);
  visit("images", tangent_map.images);
}

void each_member(Is<RunSensitivities::Memory> auto& sensitivities, const auto& visit) {
  visit("images", sensitivities.images);
  visit("growth", sensitivities.growth);
  visit("time", sensitivities.time);
  visit("values", sensitivities.values);
}

void each_member(Is<PowerAccount::Memory> auto& power_account, const auto& visit) {
  visit("first", power_account.first);
  visit("last", power_account.last);
  visit("balance", power_account.balance);
  visit("greatest", power_account.greatest);
  visit("size", power_account.size);
  visit("stage_greatest", power_account.stage_greatest);
  visit("moved", power_account.moved);
  visit("supplied", power_account.supplied);
  visit("dissipated", power_account.dissipated);
}

template <class Record>
Json record(const Record& value) {
  Json json = Json::object();
  each_member(value, [&](const char* name, const auto& member) { json[name] = written(member); });
  return json;
}

template <class Record>
void read_record(const Json& json, Record& value) {
  each_member(value, [&](const char* name, auto& member) { read(json.at(name), member); });
}

Json written(const std::map<std::string, EventRecord>& records) {
  Json json = Json::object();
  for (const auto& [name, event] : records) json[name] = record(event);
  return json;
}

void read(const Json& json, std::map<std::string, EventRecord>& records) {
  for (const auto& [name, event] : json.items()) read_record(event, records[name]);
}

template <class Record>
Json record(const std::optional<Record>& value) {
  return value ? record(*value) : Json();
}

template <class Record>
void read_record(const Json& json, std::optional<Record>& value) {
  if (json.is_null()) return;
  value = Record();
  read_record(json, *value);
}

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Of all that stands before the entry "hash".
std::string hash_of(Json json) {
  json.erase("hash");
  return content_hash(dumped(json));
}

Checkpoint from_json(const Json& json) {
  if (const auto version = json.at("courant").get<std::string>(); version != COURANT_VERSION_STRING)
    throw RunFileError("version " + version + " of courant wrote it, this is " +
                       COURANT_VERSION_STRING + ", which may make other bits");
  if (json.at("hash") != hash_of(json))
    throw RunFileError("is not as it was written; expected it whole, or --force to begin anew");
  Checkpoint checkpoint;
  read(json.at("run"), checkpoint.run);
  read(json.at("k"), checkpoint.k);
  read_record(json.at("state"), checkpoint.state);
  read_record(json.at("motion"), checkpoint.motion);
  read(json.at("trajectory"), checkpoint.trajectory);
  read(json.at("wall_seconds"), checkpoint.wall_seconds);
  read(json.at("cpu_seconds"), checkpoint.cpu_seconds);
  read_record(json.at("solver"), checkpoint.solver);
  read_record(json.at("statistics"), checkpoint.statistics);
  for (const Json& entry : json.at("rows_at_times")) {
    double time = 0.0;
    read(entry.at("t"), time);
    read(entry.at("row"), checkpoint.rows_at_times[time]);
  }
  read_record(json.at("not_finite"), checkpoint.not_finite);
  read_record(json.at("energy_watch"), checkpoint.energy_watch);
  read_record(json.at("ladder_watch"), checkpoint.ladder_watch);
  read_record(json.at("event_watch"), checkpoint.event_watch);
  read_record(json.at("power_account"), checkpoint.observed.power_account);
  read_record(json.at("tangent_map"), checkpoint.observed.tangent_map);
  read_record(json.at("sensitivities"), checkpoint.observed.sensitivities);
  return checkpoint;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  Json json{{"courant", COURANT_VERSION_STRING},
            {"run", checkpoint.run},
            {"k", checkpoint.k},
            {"state", record(checkpoint.state)},
            {"motion", record(checkpoint.motion)},
            {"trajectory", written(checkpoint.trajectory)},
            {"wall_seconds", checkpoint.wall_seconds},
            {"cpu_seconds", checkpoint.cpu_seconds},
            {"solver", record(checkpoint.solver)},
            {"statistics", record(checkpoint.statistics)},
            {"rows_at_times", Json::array()},
            {"not_finite", record(checkpoint.not_finite)},
            {"energy_watch", record(checkpoint.energy_watch)},
            {"ladder_watch", record(checkpoint.ladder_watch)},
            {"event_watch", record(checkpoint.event_watch)},
            {"power_account", record(checkpoint.observed.power_account)},
            {"tangent_map", record(checkpoint.observed.tangent_map)},
            {"sensitivities", record(checkpoint.observed.sensitivities)}};
  for (const auto& [time, row] : checkpoint.rows_at_times)
    json["rows_at_times"].push_back({{"t", written(time)}, {"row", written(row)}});
  json["hash"] = hash_of(json);
  write_file(file, dumped(json) + "\n");
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  const Json json = read_json(file);
  try {
    return from_json(json);
  } catch (const Json::exception& error) {
    const std::string what = error.what();  // "[json.exception.out_of_range.403] key …"
    throw RunFileError(file.string() + ": is not a checkpoint: " + what.substr(what.find(']') + 2));
  } catch (const RunFileError& error) {
    throw RunFileError(file.string() + ": " + error.what() + ".");
  }
}

}  // namespace courant
