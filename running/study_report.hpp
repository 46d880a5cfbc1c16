// StudyReport: what a study measured, as a value with one reader and one writer.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "courant/reading/findings.hpp"

namespace courant {

// What a study of convergence found: a row for each method and step size.
struct StudyReport {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  // One step size.
  struct Row {
    double step = kUnknown, error = kUnknown, seconds = kUnknown;
    double order = kUnknown;  // between it and the row before
    long steps = 0, iterations = 0, factorizations = 0;
    std::string message = "";  // why these steps cannot be made; empty if they can
  };
  // One method on one problem.
  struct Method {
    std::string experiment = "", method = "";
    std::vector<std::string> quantities = {};  // whose error it is
    std::string reference = "";                // what it is the distance from, in words
    std::optional<int> reference_order = {};   // of its method; none: a closed form
    double reference_error = 0.0;              // by how much it may be off
    std::optional<double> order = {};          // the slope of log(error) over log(step)
    // That of each of the quantities by itself, as many as these, or none: a small one may hide behind others.
    std::vector<std::optional<double>> orders = {};
    std::string remark = "";
    std::vector<Row> rows = {};  // from long steps to short ones
  };

  bool is_interrupted = false;
  std::vector<Method> methods;

  // Those of all methods; nothing where these differ, or where there is no method.
  std::optional<std::string> reference() const;
  std::optional<std::vector<std::string>> quantities() const;
};

// As `courant study --json` prints it and study.json has it, see docs/experiment-format.md: what is not
// known is null.
Json to_json(const StudyReport& report);
// Throws Json::exception for JSON that is none of a study.
StudyReport read_study_report(const Json& json);

// A row a step: experiment, method, step, steps, error, order, iterations, factorizations, seconds,
// message, reference.
std::string study_csv(const StudyReport& report);

}  // namespace courant
