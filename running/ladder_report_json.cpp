#include <initializer_list>
#include <stdexcept>
#include <string>

#include "courant/reading/json_document.hpp"
#include "courant/running/ladder_report.hpp"

namespace courant {
namespace {

template <class Value>
Json written(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

template <class Value>
Json written(const std::vector<std::pair<std::string, Value>>& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) append_member(json, name, value);
  return json;
}

Json written(const LadderReport::Origin& origin) {
  Json json = Json::array();
  for (const LadderReport::Term& term : origin)
    json.push_back({{"equation", term.equation},
                    {"derivative", term.derivative},
                    {"coefficient", term.coefficient}});
  return json;
}

template <class Entry>
Json written(const std::vector<Entry>& entries) requires requires(Entry entry) {
  written(entry);
}
{
  Json json = Json::array();
  for (const Entry& entry : entries) json.push_back(written(entry));
  return json;
}

void write_classes(Json& json, const LadderReport::Classes& classes) {
  json["degrees_of_freedom_up_to_gauge"] = classes.degrees_of_freedom_up_to_gauge;
  json["classes"] = {{"primary", classes.primary}, {"secondary", classes.secondary}};
  if (const auto& brackets = classes.brackets) {
    json["classes"]["first_class"] = brackets->first_class;
    json["classes"]["second_class"] = brackets->second_class;
    json["classes"]["primary_first_class"] = brackets->primary_first_class;
  }
  json["classes"]["ambiguous"] = classes.is_ambiguous;
}

void write_elimination(Json& json, const LadderReport::Elimination& found) {
  json["formulas"] = Json::array();
  for (const auto& [level, formula, is_singular] : found.formulas) {
    json["formulas"].push_back({{"level", level}, {"formula", formula}});
    if (is_singular) json["formulas"].back()["singular"] = true;
  }
  json["steps"] = Json::array();
  for (const ConstraintFormulas::Step& step : found.steps)
    json["steps"].push_back({{"level", step.level},
                             {"kind", to_string(step.kind)},
                             {"constraint", step.constraint},
                             {"derivative", step.derivative},
                             {"result", step.result}});
  json["velocities"] = Json::object();
  for (const auto& [name, level, formula, on_M_f] : found.velocities) {
    json["velocities"][name] = {{"level", level}, {"formula", formula}};
    if (!on_M_f.empty()) json["velocities"][name]["on_M_f"] = on_M_f;
  }
}

void write_end(Json& json, const LadderReport::End& end) {
  json["unknowns"] = Json::object();
  for (const LadderReport::Unknown& unknown : end.unknowns) {
    json["unknowns"][unknown.name] = {{"value", unknown.value},
                                      {"determined", unknown.is_determined}};
    if (unknown.formula) json["unknowns"][unknown.name]["formula"] = *unknown.formula;
  }
  json["gauge_directions"] = written(end.gauge_directions);
  json["determined_velocities"] = end.determined_velocities;
  json["differentiations"] = written(end.differentiations);
  json["redundant"] = written(end.redundant);
  if (end.redundant_joints.empty()) return;
  json["dependences"] = std::move(json["redundant"]);
  json["redundant"] = Json::array();
  for (const auto& [joint, conditions, of] : end.redundant_joints)
    json["redundant"].push_back({{"joint", joint}, {"conditions", conditions}, {"of", of}});
}

// The values of keys that may be missing.
const Json& part(const Json& object, const char* key) {
  static const Json nothing = Json::object();
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}
double number_at(const Json& object, const char* key) {
  const Json& value = part(object, key);
  return value.is_number() ? value.get<double>() : LadderReport::kUnknown;
}
std::optional<Index> whole(const Json& object, const char* key) {
  const Json& value = part(object, key);
  return value.is_number() ? std::optional(value.get<Index>()) : std::nullopt;
}

// The value of an enumeration that has this word.
template <class Value>
Value value_of(const std::string& word, const char* key, std::initializer_list<Value> values) {
  std::string expected;
  for (const Value value : values) {
    if (word == to_string(value)) return value;
    expected += (expected.empty() ? "" : ", ") + to_string(value);
  }
  throw std::invalid_argument(std::string("/") + key + ": is \"" + word + "\", expected one of " +
                              expected + ".");
}

LadderReport::Values read_values(const Json& json) {
  LadderReport::Values values;
  for (const auto& [name, value] : json.items())
    values.emplace_back(name, value.is_number() ? value.get<double>() : LadderReport::kUnknown);
  return values;
}

LadderReport::Origin read_origin(const Json& json) {
  LadderReport::Origin origin;
  for (const Json& term : json)
    origin.push_back({.equation = term.value("equation", ""),
                      .derivative = whole(term, "derivative").value_or(0),
                      .coefficient = number_at(term, "coefficient")});
  return origin;
}

LadderReport::Classes read_classes(const Json& ladder) {
  const Json& json = ladder.at("classes");
  LadderReport::Classes classes{.primary = whole(json, "primary").value_or(0),
                                .secondary = whole(json, "secondary").value_or(0),
                                .is_ambiguous = json.value("ambiguous", false),
                                .degrees_of_freedom_up_to_gauge =
                                    whole(ladder, "degrees_of_freedom_up_to_gauge").value_or(0)};
  if (json.contains("first_class"))
    classes.brackets = {.first_class = whole(json, "first_class").value_or(0),
                        .second_class = whole(json, "second_class").value_or(0),
                        .primary_first_class = whole(json, "primary_first_class").value_or(0)};
  return classes;
}

LadderReport::Elimination read_elimination(const Json& json) {
  using Kind = ConstraintFormulas::Step::Kind;
  LadderReport::Elimination found;
  for (const Json& entry : part(json, "formulas"))
    found.formulas.push_back({whole(entry, "level").value_or(0), entry.value("formula", ""),
                              entry.value("singular", false)});
  for (const Json& entry : part(json, "steps"))
    found.steps.push_back(
        {.level = whole(entry, "level").value_or(0),
         .kind = value_of(entry.value("kind", ""), "steps/kind",
                          {Kind::constraint, Kind::condition, Kind::kept, Kind::contradiction}),
         .constraint = entry.value("constraint", ""),
         .derivative = entry.value("derivative", ""),
         .result = entry.value("result", "")});
  for (const auto& [name, entry] : part(json, "velocities").items())
    found.velocities.push_back({name, whole(entry, "level").value_or(0), entry.value("formula", ""),
                                entry.value("on_M_f", "")});
  return found;
}

LadderReport::End read_end(const Json& json) {
  LadderReport::End end;
  for (const auto& [name, entry] : part(json, "unknowns").items()) {
    end.unknowns.push_back({.name = name,
                            .value = number_at(entry, "value"),
                            .is_determined = entry.value("determined", false)});
    if (entry.contains("formula")) end.unknowns.back().formula = entry.value("formula", "");
  }
  for (const Json& entry : part(json, "gauge_directions"))
    end.gauge_directions.push_back(read_values(entry));
  for (const Json& entry : part(json, "determined_velocities"))
    end.determined_velocities.push_back(entry.get<std::string>());
  for (const auto& [name, entry] : part(json, "differentiations").items())
    end.differentiations.emplace_back(name, entry.get<Index>());
  const bool of_joints = json.contains("dependences");
  for (const Json& entry : part(json, of_joints ? "dependences" : "redundant"))
    end.redundant.push_back(read_origin(entry));
  if (of_joints)
    for (const Json& entry : part(json, "redundant"))
      end.redundant_joints.push_back({.joint = entry.at("joint").get<std::string>(),
                                      .conditions = entry.at("conditions").get<Index>(),
                                      .of = entry.at("of").get<Index>()});
  return end;
}

}  // namespace

Json to_json(const LadderReport& ladder) {
  Json json{{"verdict", to_string(ladder.verdict)},
            {"index", written(ladder.index)},
            {"gauge_dimension", ladder.gauge_dimension},
            {"degrees_of_freedom", written(ladder.degrees_of_freedom)},
            {"dimension", written(ladder.dimension)},
            {"levels", Json::array()},
            {"consistent_point", written(ladder.consistent_point)},
            {"moved", ladder.moved},
            {"moves", Json::array()},
            {"ambiguous", ladder.is_ambiguous},
            {"doubts", Json::array()},
            {"reason", ladder.reason}};
  for (const NamedEquation& term : ladder.contradiction)
    json["contradiction"].push_back({{"equation", term.name}, {"derivative", term.derivative}});
  for (const Doubt& doubt : ladder.doubts)
    json["doubts"].push_back({{"kind", to_string(doubt.kind)}, {"text", doubt.text}});
  if (ladder.proof)
    json["proof"] = {{"proved", ladder.proof->is_whole()},   {"point", ladder.proof->has_point},
                     {"radius", ladder.proof->radius},       {"not_zero", ladder.proof->not_zero},
                     {"zero_by_digits", ladder.proof->zero}, {"missing", ladder.proof->missing}};
  for (const LadderReport::Level& level : ladder.levels)
    json["levels"].push_back({{"k", level.k},
                              {"dim_S", written(level.dim_S)},
                              {"dim_M", written(level.dim_M)},
                              {"fibre", written(level.fibre)},
                              {"gap", level.gap},
                              {"smallest_counted", level.smallest_counted},
                              {"largest_neglected", level.largest_neglected},
                              {"residual", level.residual}});
  for (const Movement& move : ladder.moves)
    json["moves"].push_back({{"name", move.name}, {"from", move.from}, {"to", move.to}});
  if (ladder.is_impulse) json["impulse"] = true;
  for (const Movement& choice : ladder.choices)
    json["choices"].push_back(
        {{"name", choice.name}, {"value", choice.from}, {"other", choice.to}});
  if (ladder.family)
    json["family"] = {{"multipliers", ladder.family->multipliers},
                      {"rank", ladder.family->rank},
                      {"morse", ladder.family->is_morse()}};
  if (ladder.classes) write_classes(json, *ladder.classes);
  if (ladder.constraints) {
    json["constraints"] = Json::array();
    for (const LadderReport::Constraint& constraint : *ladder.constraints)
      json["constraints"].push_back({{"level", constraint.level},
                                     {"gradient", written(constraint.gradient)},
                                     {"from", written(constraint.from)}});
  }
  if (ladder.elimination) write_elimination(json, *ladder.elimination);
  if (ladder.end) write_end(json, *ladder.end);
  return json;
}

LadderReport read_ladder_report(const Json& json) {
  LadderReport ladder{.verdict = value_of(json.value("verdict", ""), "verdict",
                                          {Verdict::regular, Verdict::gauge, Verdict::inconsistent,
                                           Verdict::rank_change, Verdict::not_reached}),
                      .index = whole(json, "index"),
                      .gauge_dimension = whole(json, "gauge_dimension").value_or(0),
                      .degrees_of_freedom = whole(json, "degrees_of_freedom"),
                      .dimension = whole(json, "dimension"),
                      .consistent_point = read_values(part(json, "consistent_point")),
                      .moved = number_at(json, "moved"),
                      .is_ambiguous = json.value("ambiguous", false),
                      .reason = json.value("reason", "")};
  for (const Json& term : part(json, "contradiction"))
    ladder.contradiction.push_back(
        {term.value("equation", ""), whole(term, "derivative").value_or(0)});
  for (const Json& level : part(json, "levels"))
    ladder.levels.push_back({.k = whole(level, "k").value_or(0),
                             .dim_S = whole(level, "dim_S"),
                             .dim_M = whole(level, "dim_M"),
                             .fibre = whole(level, "fibre"),
                             .gap = number_at(level, "gap"),
                             .smallest_counted = number_at(level, "smallest_counted"),
                             .largest_neglected = number_at(level, "largest_neglected"),
                             .residual = number_at(level, "residual")});
  for (const Json& move : part(json, "moves"))
    ladder.moves.push_back({.name = move.value("name", ""),
                            .from = number_at(move, "from"),
                            .to = number_at(move, "to")});
  if (const Json& proof = part(json, "proof"); !proof.empty())
    ladder.proof = LadderProof{.has_point = proof.value("point", false),
                               .radius = number_at(proof, "radius"),
                               .not_zero = whole(proof, "not_zero").value_or(0),
                               .zero = whole(proof, "zero_by_digits").value_or(0),
                               .missing = proof.value("missing", "")};
  ladder.is_impulse = json.value("impulse", false);
  for (const Json& choice : part(json, "choices"))
    ladder.choices.push_back({.name = choice.value("name", ""),
                              .from = number_at(choice, "value"),
                              .to = number_at(choice, "other")});
  for (const Json& doubt : part(json, "doubts"))
    ladder.doubts.emplace_back(doubt_kind(doubt.value("kind", "neighbours")),
                               doubt.value("text", ""));
  if (const Json& family = part(json, "family"); !family.empty())
    ladder.family = {.multipliers = whole(family, "multipliers").value_or(0),
                     .rank = whole(family, "rank").value_or(0)};
  if (json.contains("classes")) ladder.classes = read_classes(json);
  if (json.contains("constraints")) {
    ladder.constraints.emplace();
    for (const Json& entry : json.at("constraints"))
      ladder.constraints->push_back({.level = whole(entry, "level").value_or(0),
                                     .gradient = read_values(part(entry, "gradient")),
                                     .from = read_origin(part(entry, "from"))});
  }
  if (json.contains("formulas")) ladder.elimination = read_elimination(json);
  if (json.contains("unknowns")) ladder.end = read_end(json);
  return ladder;
}

}  // namespace courant
