// Objects of Python in experiments.
#pragma once

#include "courant/python/conversions.hpp"

namespace courant::python {

// While this lives, {"type": "python", "object": k} in an experiment that is read stands for objects[k].
class ObjectsOfExperiment {
 public:
  explicit ObjectsOfExperiment(py::list objects);
  ~ObjectsOfExperiment();
  ObjectsOfExperiment(const ObjectsOfExperiment&) = delete;
  ObjectsOfExperiment& operator=(const ObjectsOfExperiment&) = delete;

 private:
  py::list before_;
};

}  // namespace courant::python
