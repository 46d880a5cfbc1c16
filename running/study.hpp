// Studies: how the error of methods depends on step size and work.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/study_report.hpp"

namespace courant {

// One method on one problem.
struct StudySubject {
  std::string name;  // of the experiment, to tell two with the same method apart
  Experiment experiment;
};

// Which steps a study compares, of which quantities, and who is told of it.
struct StudyOptions {
  int steps = 5;  // step sizes: h, h/2, …; at least 2
  // Names of coordinates and observables whose error is measured. Empty: those that the experiment
  // has a closed form of, or else all coordinates.
  std::vector<std::string> quantities = {};
  Backend backend = Backend::automatic;
  const std::atomic<bool>* stop = nullptr;  // set by someone else: the study is interrupted
  std::function<void(const std::string& what)> on_progress = {};   // before each piece of work
  std::function<void(const StudyReport::Method&)> on_method = {};  // after each method
};

// The error of a run is the greatest Euclidean norm of (quantities - reference) at the times of the
// longest step, at most 1000 of them. The reference is the closed form in t that the experiment
// expects at every step, `{"state": {"q": "cos(t)"}, "tolerance": …}`, where there is one for each
// quantity; otherwise a run from the same consistent point by rkf78, which is of order 8, or by the
// method itself where there is no vector field, at steps that are halved until only round-off
// changes; the last change is what the reference may be off by. The order is the slope of log(error) over log(step) at
// the four smallest steps whose errors are above ten times that of the reference and above round-off.
// The time is that of the steps alone, the least of several runs where they are short.
//
// Steps that cannot be made have the message why, and no error. Throws ExperimentError for an experiment
// without a method, or without one of the quantities.
StudyReport study(std::span<const StudySubject> subjects, const StudyOptions& options);

}  // namespace courant
