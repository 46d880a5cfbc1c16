// Numbers that functions of Python say from step to step.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/integrators/step/integrator.hpp"
#include "courant/python/conversions.hpp"

namespace courant::python {

// Coordinates u of a system that stand still while it moves, u' = 0, and where the function is from that says which
// numbers they are: ask_of(coordinates, unknowns) gives ask(t, x, v, z), which is called with the GIL at the stage of a
// step and gives an array of one number each.
struct StepInputs {
  std::vector<std::string> names;
  std::shared_ptr<py::object> ask_of;
};

// The method whose steps have u = ask(stage), by fixed point iteration over steps of the one that is given. With the
// midpoint rule that is the midpoint rule of the system in which the function stands in the place of u. Throws
// std::invalid_argument where the system has no such coordinates; a step throws ExperimentError where the method is of
// several stages.
std::shared_ptr<const Integrator> with_inputs(const std::shared_ptr<const Integrator>& method,
                                              const StepInputs& inputs);

}  // namespace courant::python
