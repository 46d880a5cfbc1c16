// What is wrong with an experiment.
#pragma once

#include <string>

#include "courant/reading/experiment.hpp"

namespace courant {

// The problems, a line each; nothing if there are none.
inline std::string problems(const Json& experiment) {
  try {
    read_experiment(experiment.dump());
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace courant
