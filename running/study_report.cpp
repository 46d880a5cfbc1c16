#include "courant/running/study_report.hpp"

#include <algorithm>
#include <cmath>

#include "courant/running/comma_separated.hpp"

namespace courant {
namespace {

Json known_or_null(double value) { return std::isnan(value) ? Json() : Json(value); }

template <class Value>
Json known_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

double number_or_unknown(const Json& value) {
  return value.is_null() ? StudyReport::kUnknown : value.get<double>();
}

template <class Value>
std::optional<Value> value_if_known(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<Value>());
}

// What all methods have in this place.
template <class Value>
std::optional<Value> shared(const std::vector<StudyReport::Method>& methods,
                            Value StudyReport::Method::*place) {
  if (methods.empty() || std::ranges::any_of(methods, [&](const StudyReport::Method& method) {
        return method.*place != methods.front().*place;
      }))
    return std::nullopt;
  return methods.front().*place;
}

Json row_json(const StudyReport::Row& row) {
  return {{"step", row.step},
          {"steps", row.steps},
          {"error", known_or_null(row.error)},
          {"order", known_or_null(row.order)},
          {"iterations", row.iterations},
          {"factorizations", row.factorizations},
          {"seconds", known_or_null(row.seconds)},
          {"message", row.message}};
}

}  // namespace

std::optional<std::string> StudyReport::reference() const {
  return shared(methods, &Method::reference);
}

std::optional<std::vector<std::string>> StudyReport::quantities() const {
  return shared(methods, &Method::quantities);
}

Json to_json(const StudyReport& report) {
  Json methods = Json::array();
  for (const StudyReport::Method& method : report.methods) {
    Json rows = Json::array(), orders = Json::object();
    for (std::size_t i = 0; i < method.orders.size(); ++i)
      orders[method.quantities[i]] = known_or_null(method.orders[i]);
    for (const StudyReport::Row& row : method.rows) rows.push_back(row_json(row));
    methods.push_back({{"experiment", method.experiment},
                       {"method", method.method},
                       {"quantities", method.quantities},
                       {"reference", method.reference},
                       {"reference_order", known_or_null(method.reference_order)},
                       {"reference_error", method.reference_error},
                       {"order", known_or_null(method.order)},
                       {"orders", orders},
                       {"remark", method.remark},
                       {"rows", rows}});
  }
  return {{"status", report.is_interrupted ? "interrupted" : "completed"},
          {"reference", known_or_null(report.reference())},
          {"quantities", known_or_null(report.quantities())},
          {"methods", methods}};
}

StudyReport read_study_report(const Json& json) {
  StudyReport report;
  report.is_interrupted = json.at("status") == "interrupted";
  for (const Json& method : json.at("methods")) {
    StudyReport::Method& read = report.methods.emplace_back();
    method.at("experiment").get_to(read.experiment);
    method.at("method").get_to(read.method);
    method.at("quantities").get_to(read.quantities);
    method.at("reference").get_to(read.reference);
    read.reference_order = value_if_known<int>(method.at("reference_order"));
    method.at("reference_error").get_to(read.reference_error);
    read.order = value_if_known<double>(method.at("order"));
    if (const Json& orders = method.at("orders"); !orders.empty())
      for (const std::string& quantity : read.quantities)
        read.orders.push_back(value_if_known<double>(orders.at(quantity)));
    method.at("remark").get_to(read.remark);
    for (const Json& row : method.at("rows"))
      read.rows.push_back({.step = row.at("step").get<double>(),
                           .error = number_or_unknown(row.at("error")),
                           .seconds = number_or_unknown(row.at("seconds")),
                           .order = number_or_unknown(row.at("order")),
                           .steps = row.at("steps").get<long>(),
                           .iterations = row.at("iterations").get<long>(),
                           .factorizations = row.at("factorizations").get<long>(),
                           .message = row.at("message").get<std::string>()});
  }
  return report;
}

std::string study_csv(const StudyReport& report) {
  std::string csv =
      "experiment,method,step,steps,error,order,iterations,factorizations,seconds,message,"
      "reference\n";
  for (const StudyReport::Method& method : report.methods)
    for (const StudyReport::Row& row : method.rows) {
      csv += csv_cell(method.experiment) + "," + csv_cell(method.method);
      const Json cells = row_json(row);
      for (const Json& value : cells) csv += "," + csv_cell(value);
      csv += "," + csv_cell(method.reference) + '\n';
    }
  return csv;
}

}  // namespace courant
