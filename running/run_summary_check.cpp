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

const Kind a_number =
    satisfying([](const Json& v) { return v.is_number() || v.is_null(); }, "a number");
const Kind a_text = satisfying([](const Json& v) { return v.is_string(); }, "a string");
const Kind a_truth = satisfying([](const Json& v) { return v.is_boolean(); }, "true or false");
const Kind an_object = satisfying([](const Json& v) { return v.is_object(); }, "an object");
const Kind an_array = satisfying([](const Json& v) { return v.is_array(); }, "an array");
const Kind plain = satisfying([](const Json& v) { return !v.is_object(); },
                              "a number, a string, a truth value or an array");

Kind an_object_of(const std::vector<Field>& fields) {
  return [=](const Json& value, const std::string& pointer) -> std::optional<std::string> {
    if (auto defect = an_object(value, pointer)) return defect;
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
    if (auto defect = an_object(value, pointer)) return defect;
    for (const auto& [key, entry] : value.items()) {
      if (auto defect = kind(entry, pointer + "/" + key)) return defect;
    }
    return std::nullopt;
  };
}

Kind array_of(const Kind& kind) {
  return [=](const Json& value, const std::string& pointer) -> std::optional<std::string> {
    if (auto defect = an_array(value, pointer)) return defect;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (auto defect = kind(value[i], pointer + "/" + std::to_string(i))) return defect;
    }
    return std::nullopt;
  };
}

Kind summary_kind() {
  const Kind level = an_object_of({{"k", a_number, true},
                                   {"dim_S", a_number},
                                   {"dim_M", a_number},
                                   {"fibre", a_number},
                                   {"gap", a_number},
                                   {"residual", a_number}});
  const Kind ladder = an_object_of({{"verdict", a_text, true},
                                    {"index", a_number},
                                    {"gauge_dimension", a_number},
                                    {"degrees_of_freedom", a_number},
                                    {"degrees_of_freedom_up_to_gauge", a_number},
                                    {"classes", an_object_of({{"primary", a_number, true},
                                                              {"secondary", a_number, true},
                                                              {"first_class", a_number},
                                                              {"second_class", a_number},
                                                              {"primary_first_class", a_number},
                                                              {"ambiguous", a_truth, true}})},
                                    {"levels", array_of(level), true},
                                    {"moved", a_number}});
  const Kind observable = an_object_of({{"initial", a_number},
                                        {"final", a_number},
                                        {"min", a_number},
                                        {"max", a_number},
                                        {"max_drift", a_number}});
  const Kind expectation = an_object_of({{"description", a_text, true},
                                         {"passed", a_truth, true},
                                         {"value", plain},
                                         {"bound", plain}});
  const Kind solver = an_object_of({{"iterations_per_step", a_number},
                                    {"factorizations_per_step", a_number},
                                    {"failures", a_number},
                                    {"second_attempts", a_number},
                                    {"confirmations", a_number},
                                    {"divisions", a_number}});
  return an_object_of(
      {{"id", a_text},
       {"status", a_text, true},
       {"message", a_text},
       {"warnings", array_of(a_text)},
       {"title", a_text},
       {"system", a_text, true},
       {"method", a_text, true},
       {"metric", a_text},
       {"steps", a_number, true},
       {"time", an_object_of({{"start", a_number}, {"end", a_number}, {"step", a_number}})},
       {"final", dictionary_of(a_number)},
       {"observables", dictionary_of(observable)},
       {"symmetries",
        dictionary_of(an_object_of({{"conserved", a_truth, true}, {"remark", a_text}}))},
       {"constraints", an_object_of({{"max_violation", a_number}})},
       {"power_balance", an_object_of({{"supplied", dictionary_of(a_number)},
                                       {"dissipated", dictionary_of(a_number)},
                                       {"stored", a_number},
                                       {"max_balance", a_number},
                                       {"max_imbalance", a_number},
                                       {"max_stage_imbalance", a_number}})},
       {"sensitivities", an_object_of({{"final", dictionary_of(dictionary_of(a_number)), true},
                                       {"lyapunov_exponents", array_of(a_number)}})},
       {"ladder", ladder},
       {"expectations", array_of(expectation)},
       {"solver", solver},
       {"backend", a_text},
       {"engine", an_object_of({{"name", a_text, true}, {"ranks", a_number, true}})},
       {"wall_seconds", a_number},
       {"cpu_seconds", a_number},
       {"steps_per_second", a_number}});
}

}  // namespace

std::optional<std::string> summary_defect(const Json& summary) {
  return summary_kind()(summary, "");
}

}  // namespace courant
