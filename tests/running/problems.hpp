// Systems of experiments, integrated by any method without the files of a run.
#pragma once

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "courant/manifolds/measurement.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant::test {

struct Problem {
  Experiment experiment;
  ConstraintLadder ladder;

  // The last state of `steps` steps over `time` by the method that this JSON describes.
  VectorXd end(const Json& method, double time, long steps) const {
    const double h = time / static_cast<double>(steps);
    const auto stepper = start(method, h);
    for (long k = 0; k < steps; ++k) stepper->step();
    return stepper->state().x;
  }
  std::unique_ptr<Stepper> start(const Json& method, double h,
                                 Backend backend = Backend::interpreter) const {
    const PreparedMethod prepared = prepare(method, h, backend);
    return prepared.integrator->start(prepared.initial, h);
  }
  PreparedMethod prepare(const Json& method, double h,
                         Backend backend = Backend::interpreter) const {
    Findings findings;
    const auto choice = method_kinds().read(JsonReader(method, "/method", findings));
    findings.require_clean();
    return choice->prepare({.system = experiment.model.system,
                            .ladder = ladder,
                            .initial = ladder.point,
                            .step = h,
                            .backend = backend,
                            .vocabulary = &experiment.model.vocabulary});
  }

  // The order that the method shows against `exact` (some coordinates of the end, after `time`).
  double order(const Json& method, double time, const VectorXd& exact, Index first = 0,
               std::vector<long> counts = {16, 32, 64, 128}) const {
    std::vector<double> steps, errors;
    for (const long count : counts) {
      steps.push_back(time / static_cast<double>(count));
      const VectorXd x = end(method, time, count);
      errors.push_back((x.segment(first, exact.size()) - exact).norm());
    }
    return log_log_slope(steps, errors, 1e-12);
  }
};

inline Problem problem(const Json& experiment) {
  Problem result{read_experiment(experiment.dump()), {}};
  result.ladder = consistent_start(result.experiment);
  return result;
}

// A file of experiments/ (tests run in the folder of the sources).
inline Json experiment_file(const std::string& name) {
  std::ifstream file("experiments/" + name + ".json");
  return Json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
}

inline Json method_1(const char* discretization) {
  return {{"type", "discretize-first"}, {"discretization", discretization}};
}
inline Json method_2(const char* discretization) {
  return {{"type", "constrain-first"}, {"discretization", discretization}};
}

}  // namespace courant::test
