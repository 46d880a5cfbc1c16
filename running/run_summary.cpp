#include "courant/running/run_summary.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "courant/reading/json_document.hpp"
#include "courant/running/run_summary_check.hpp"

namespace courant {
namespace {

constexpr std::array kStatuses = {RunStatus::running, RunStatus::completed, RunStatus::failed,
                                  RunStatus::interrupted, RunStatus::not_finite};

RunStatus read_status(const std::string& word) {
  for (const RunStatus status : kStatuses)
    if (word == to_string(status)) return status;
  throw std::invalid_argument("/status: is \"" + word +
                              "\", expected running, completed, failed, interrupted or "
                              "not-finite.");
}

// The values of keys that may be missing.
double number(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : RunSummary::kUnknown;
}
std::optional<long> count(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<long>();
}
std::string text_at(const Json& object, const char* key) { return object.value(key, ""); }
const Json& part(const Json& object, const char* key, const Json& otherwise) {
  const auto found = object.find(key);
  return found == object.end() ? otherwise : *found;
}

using Named = std::vector<std::pair<std::string, double>>;

Json named(const Named& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) append_member(json, name, value);
  return json;
}
Named read_named(const Json& json) {
  Named values;
  for (const auto& [name, value] : json.items()) values.emplace_back(name, number(json, name));
  return values;
}

LadderReport read_ladder(const Json& json) {
  try {
    return read_ladder_report(json);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("/ladder" + std::string(error.what()));
  } catch (const Json::exception&) {
    throw std::invalid_argument("/ladder: is none that a run writes.");
  }
}

}  // namespace

const char* to_string(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::completed:
      return "completed";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::not_finite:
      return "not-finite";
  }
  return "";
}

const QuantityRecord* RunSummary::observable(std::string_view name) const& {
  for (const auto& [known, record] : observables)
    if (known == name) return &record;
  return nullptr;
}

Json to_json(const RunSummary& summary) {
  Json json{{"id", summary.id},
            {"status", to_string(summary.status)},
            {"message", summary.message},
            {"warnings", summary.warnings},
            {"title", summary.title},
            {"system", summary.system},
            {"method", summary.method},
            {"metric", summary.metric},
            {"steps", summary.steps},
            {"time", Json::object()},
            {"final", Json::object()},
            {"observables", Json::object()},
            {"constraints", Json::object()}};
  if (summary.ladder) json["ladder"] = to_json(*summary.ladder);
  if (!summary.boundary.is_null()) json["boundary"] = summary.boundary;
  if (!summary.sensitivities.is_null()) json["sensitivities"] = summary.sensitivities;
  json["expectations"] = Json::array();
  if (const auto& time = summary.time)
    json["time"] = {{"start", time->start}, {"end", time->end}, {"step", time->step}};
  if (!summary.stopped_by.empty()) json["stopped_by"] = summary.stopped_by;
  for (const auto& [name, value] : summary.final) append_member(json["final"], name, value);
  for (const auto& [name, record] : summary.observables)
    json["observables"][name] = {
        {"initial", record.initial}, {"final", record.final},         {"min", record.min},
        {"max", record.max},         {"max_drift", record.max_drift}, {"slope", record.slope}};
  if (summary.max_violation) json["constraints"]["max_violation"] = *summary.max_violation;
  if (const auto& balance = summary.power_balance)
    json["power_balance"] = {{"supplied", named(balance->supplied)},
                             {"dissipated", named(balance->dissipated)},
                             {"stored", balance->stored},
                             {"max_balance", balance->max_balance},
                             {"max_imbalance", balance->max_imbalance},
                             {"max_stage_imbalance", balance->max_stage_imbalance}};
  for (const auto& [name, symmetry] : summary.symmetries)
    json["symmetries"][name] = {{"conserved", symmetry.is_conserved}, {"remark", symmetry.remark}};
  for (const auto& [name, event] : summary.events) {
    const bool has_occurred = event.count > 0;
    const auto when = [&](double t) { return has_occurred ? Json(t) : Json(); };
    json["events"][name] = {
        {"count", event.count}, {"first", when(event.first)}, {"last", when(event.last)}};
  }
  for (const ExpectationResult& result : summary.expectations)
    json["expectations"].push_back({{"description", result.description},
                                    {"passed", result.passed},
                                    {"value", result.value},
                                    {"bound", result.bound}});
  const RunSummary::Solver& solver = summary.solver;
  json["solver"] = {{"iterations_per_step", solver.iterations_per_step},
                    {"factorizations_per_step", solver.factorizations_per_step},
                    {"failures", solver.failures.value_or(0)},
                    {"second_attempts", solver.second_attempts.value_or(0)},
                    {"confirmations", solver.confirmations.value_or(0)},
                    {"divisions", solver.divisions.value_or(0)}};
  json["backend"] = summary.backend;
  if (const auto& engine = summary.engine)
    json["engine"] = {{"name", engine->name}, {"ranks", engine->ranks}};
  json["wall_seconds"] = summary.wall_seconds;
  json["cpu_seconds"] = summary.cpu_seconds;
  json["steps_per_second"] = summary.steps_per_second;
  return json;
}

RunSummary read_run_summary(const Json& json) {
  if (const auto defect = summary_defect(json)) throw std::invalid_argument(*defect);
  const Json nothing = Json::object();
  RunSummary summary{.id = text_at(json, "id"),
                     .status = read_status(text_at(json, "status")),
                     .message = text_at(json, "message"),
                     .title = text_at(json, "title"),
                     .system = text_at(json, "system"),
                     .method = text_at(json, "method"),
                     .metric = text_at(json, "metric"),
                     .steps = count(json, "steps").value_or(0),
                     .backend = text_at(json, "backend"),
                     .wall_seconds = number(json, "wall_seconds"),
                     .cpu_seconds = number(json, "cpu_seconds"),
                     .steps_per_second = number(json, "steps_per_second")};
  if (json.contains("engine"))
    summary.engine = {.name = text_at(json.at("engine"), "name"),
                      .ranks = count(json.at("engine"), "ranks").value_or(1)};
  if (json.contains("ladder")) summary.ladder = read_ladder(json.at("ladder"));
  summary.boundary = part(json, "boundary", Json());
  summary.sensitivities = part(json, "sensitivities", Json());
  for (const Json& warning : part(json, "warnings", nothing)) summary.warnings.push_back(warning);
  summary.stopped_by = text_at(json, "stopped_by");
  if (const Json& time = part(json, "time", nothing); !time.empty())
    summary.time = {number(time, "start"), number(time, "end"), number(time, "step")};
  for (const auto& [name, value] : part(json, "final", nothing).items())
    summary.final.emplace_back(name, number(json.at("final"), name));
  for (const auto& [name, record] : part(json, "observables", nothing).items())
    summary.observables.emplace_back(name, QuantityRecord{.initial = number(record, "initial"),
                                                          .final = number(record, "final"),
                                                          .min = number(record, "min"),
                                                          .max = number(record, "max"),
                                                          .max_drift = number(record, "max_drift"),
                                                          .slope = number(record, "slope")});
  for (const auto& [name, symmetry] : part(json, "symmetries", nothing).items())
    summary.symmetries.emplace_back(
        name, RunSummary::Symmetry{.is_conserved = symmetry.at("conserved").get<bool>(),
                                   .remark = text_at(symmetry, "remark")});
  for (const auto& [name, event] : part(json, "events", nothing).items())
    summary.events.emplace_back(name, RunSummary::Event{.count = count(event, "count").value_or(0),
                                                        .first = number(event, "first"),
                                                        .last = number(event, "last")});
  if (const Json& constraints = part(json, "constraints", nothing); !constraints.empty())
    summary.max_violation = number(constraints, "max_violation");
  if (json.contains("power_balance")) {
    const Json& balance = json.at("power_balance");
    summary.power_balance = {.supplied = read_named(part(balance, "supplied", nothing)),
                             .dissipated = read_named(part(balance, "dissipated", nothing)),
                             .stored = number(balance, "stored"),
                             .max_balance = number(balance, "max_balance"),
                             .max_imbalance = number(balance, "max_imbalance"),
                             .max_stage_imbalance = number(balance, "max_stage_imbalance")};
  }
  for (const Json& expectation : part(json, "expectations", nothing))
    summary.expectations.push_back({.pointer = {},
                                    .description = text_at(expectation, "description"),
                                    .passed = expectation.at("passed").get<bool>(),
                                    .value = part(expectation, "value", Json()),
                                    .bound = part(expectation, "bound", Json()),
                                    .finding = {}});
  const Json& solver = part(json, "solver", nothing);
  summary.solver = {.iterations_per_step = number(solver, "iterations_per_step"),
                    .factorizations_per_step = number(solver, "factorizations_per_step"),
                    .failures = count(solver, "failures"),
                    .second_attempts = count(solver, "second_attempts"),
                    .confirmations = count(solver, "confirmations"),
                    .divisions = count(solver, "divisions")};
  return summary;
}

}  // namespace courant
