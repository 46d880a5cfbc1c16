// courant._courant: what of the library Python sees. The package courant/ makes it what people expect.
#include "courant/core/files/output_file.hpp"
#include "courant/core/words/version.hpp"
#include "courant/integrators/step/solve_error.hpp"
#include "courant/python/conversions.hpp"
#include "courant/running/run_files.hpp"

namespace courant::python {
namespace {

// Raises the class of this name of courant._errors.
void raise(const char* name, const py::object& argument) {
  const py::object type = py::module_::import("courant._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(argument).ptr());
}

void translate(std::exception_ptr pointer) {
  if (!pointer) return;
  try {
    std::rethrow_exception(pointer);
  } catch (const ExperimentError& error) {
    py::list problems;
    for (const Problem& problem : error.problems())
      problems.append(py::make_tuple(problem.where, problem.what));
    raise("ExperimentError", problems);
  } catch (const SolveError& error) {
    raise("SolveError", py::str(error.what()));
  } catch (const OutputError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const RunFileError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  }
}

}  // namespace

PYBIND11_MODULE(_courant, module) {
  module.attr("__version__") = COURANT_VERSION_STRING;
  py::register_exception_translator(&translate);
  bind_expressions(module);
  bind_formulas(module);
  bind_manifolds(module);
  bind_structures(module);
  bind_methods(module);
  bind_step_inputs(module);
  bind_laws(module);
  bind_kinds(module);
  bind_experiments(module);
  bind_runs(module);
}

}  // namespace courant::python
