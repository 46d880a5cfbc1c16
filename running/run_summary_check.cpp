#include "courant/running/run_summary_check.hpp"

#include <functional>
#include <string_view>
#include <vector>

namespace courant {

namespace {

using Json = nlohmann::ordered_json;

// A kind of value: a defect with its pointer, or nothing.
using Kind = std::function<std::optional<std::string>(const Json&, const std::string& pointer)>;

struct Field {
  std::string_view name;
  Kind kind;
  bool required = false;
};

Kind satisfying(bool (*holds)(const Json&), std::string_view expected) {
  return [=](const Json& value, const std::string& pointer) -> std::optional<std::string> {
    if (holds(value)) return std::nullopt;
    return (pointer.empty() ? "" : pointer + ": ") + "is " + value.type_name() + ", expected " +
           std::string(expected) + ".";
  };
}

const Kind number =
    satisfying([](const Json& v) { return v.is_number() || v.is_null(); }, "a number");
const Kind text = satisfying([](const Json& v) { return v.is_string(); }, "a string");
const Kind truth = satisfying([](const Json& v) { return v.is_boolean(); }, "true or false");
const Kind object = satisfying([](const Json& v) { return v.is_object(); }, "an object");
const Kind array = satisfying([](const Json& v) { return v.is_array(); }, "an array");
const Kind plain = satisfying([](const Json& v) { return !v.is_object(); },
                              "a number, a string, a truth value or an array");

Kind record(const std::vector<Field>& fields) {
  return [=](const Json& value, const std::string& pointer) -> std::optional<std::string> {
    if (auto defect = object(value, pointer)) return defect;
    for (const Field& field : fields) {
      const std::string at = pointer + "/" + std::string(field.name);
      const auto found = value.find(field.name);
      if (found == value.end()) {
        if (field.required) return at + ": is missing.";
      } else if (auto defect = field.kind(*found, at)) {
        return defect;
      }
    }
    return std::nullopt;
  };
}

Kind dictionary_of(const Kind& kind) {
  return [=](const Json& value, const std::string& pointer) -> std::optional<std::string> {
    if (auto defect = object(value, pointer)) return defect;
    for (const auto& [key, entry] : value.items()) {
      if (auto defect = kind(entry, pointer + "/" + key)) return defect;
    }
    return std::nullopt;
  };
}

Kind array_of(const Kind& kind) {
  return [=](const Json& value, const std::string& pointer) -> std::optional<std::string> {
    if (auto defect = array(value, pointer)) return defect;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (auto defect = kind(value[i], pointer + "/" + std::to_string(i))) return defect;
    }
    return std::nullopt;
  };
}

Kind summary_kind() {
  const Kind level = record({{"k", number, true},
                             {"dim_S", number},
                             {"dim_M", number},
                             {"fibre", number},
                             {"gap", number},
                             {"residual", number}});
  const Kind ladder = record({{"verdict", text, true},
                              {"index", number},
                              {"gauge_dimension", number},
                              {"degrees_of_freedom", number},
                              {"degrees_of_freedom_up_to_gauge", number},
                              {"classes", record({{"primary", number, true},
                                                  {"secondary", number, true},
                                                  {"first_class", number},
                                                  {"second_class", number},
                                                  {"primary_first_class", number},
                                                  {"ambiguous", truth, true}})},
                              {"levels", array_of(level), true},
                              {"moved", number}});
  const Kind observable = record({{"initial", number},
                                  {"final", number},
                                  {"min", number},
                                  {"max", number},
                                  {"max_drift", number}});
  const Kind expectation = record(
      {{"description", text, true}, {"passed", truth, true}, {"value", plain}, {"bound", plain}});
  const Kind solver = record({{"iterations_per_step", number},
                              {"factorizations_per_step", number},
                              {"failures", number},
                              {"second_attempts", number},
                              {"confirmations", number}});
  return record(
      {{"id", text},
       {"status", text, true},
       {"message", text},
       {"warnings", array_of(text)},
       {"title", text},
       {"system", text, true},
       {"method", text, true},
       {"steps", number, true},
       {"time", record({{"start", number}, {"end", number}, {"step", number}})},
       {"final", dictionary_of(number)},
       {"observables", dictionary_of(observable)},
       {"symmetries", dictionary_of(record({{"conserved", truth, true}, {"remark", text}}))},
       {"constraints", record({{"max_violation", number}})},
       {"power_balance", record({{"supplied", dictionary_of(number)},
                                 {"dissipated", dictionary_of(number)},
                                 {"stored", number},
                                 {"max_balance", number},
                                 {"max_imbalance", number}})},
       {"ladder", ladder},
       {"expectations", array_of(expectation)},
       {"solver", solver},
       {"backend", text},
       {"wall_seconds", number},
       {"steps_per_second", number}});
}

}  // namespace

std::optional<std::string> summary_defect(const Json& summary) {
  return summary_kind()(summary, "");
}

}  // namespace courant
