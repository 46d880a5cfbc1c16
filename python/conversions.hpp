// Arrays of expressions between C++ and Python, and objects of Python that C++ keeps.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/reading/findings.hpp"

namespace courant::python {

namespace py = pybind11;

// An expression, or a number. Throws TypeError for what is neither.
Expr to_expr(py::handle object);

// Anything that is iterated over as a vector, a matrix, is one: lists, tuples, arrays. A vector may be written as a
// number. Throws TypeError.
ExprVector to_vector(py::handle object);
ExprMatrix to_matrix(py::handle object);

// Traced arrays, see courant/_trace.py: numpy's functions work on them.
py::object traced(const ExprVector& vector);
py::object traced(const ExprMatrix& matrix);
py::object traced(const ExprVector& vector, const std::vector<Index>& shape);

// An object that C++ holds, and lets go of in any thread. What is held to the end of the program is left: its
// interpreter is gone by then.
std::shared_ptr<py::object> held(py::object object);

// A pointer to an object of a class of C++, or of one of Python that is derived from it, which lives as long as the
// pointer: so do the methods that it overrides.
template <class Class>
std::shared_ptr<const Class> kept(py::object object) {
  const Class* const pointer = object.cast<const Class*>();
  return std::shared_ptr<const Class>(pointer, [held = held(std::move(object))](const Class*) {});
}

// The method of an object that its class in Python overrides; null if it does not. The GIL is held.
template <class Class>
py::function override_of(const Class* object, const char* name) {
  return py::get_override(object, name);
}

// As override_of; throws NotImplementedError where it is not there.
template <class Class>
py::function required(const Class* object, const char* name) {
  py::function method = py::get_override(object, name);
  if (!method) {
    const std::string type = py::str(py::cast(object).attr("__class__").attr("__name__"));
    PyErr_SetString(PyExc_NotImplementedError,
                    (type + "." + name + " is missing: the class has to define it").c_str());
    throw py::error_already_set();
  }
  return method;
}

// Numbers as an array that owns them, without a copy.
py::array_t<double> owned(std::vector<double>&& numbers, py::ssize_t rows, py::ssize_t columns);

// JSON, and values of Python.
py::object to_python(const Json& json);
Json to_json(py::handle object);

// Parts of the module, one source each.
void bind_expressions(py::module_& module);
void bind_formulas(py::module_& module);
void bind_manifolds(py::module_& module);
void bind_structures(py::module_& module);
void bind_methods(py::module_& module);
void bind_step_inputs(py::module_& module);
void bind_laws(py::module_& module);
void bind_kinds(py::module_& module);
void bind_experiments(py::module_& module);
void bind_runs(py::module_& module);

}  // namespace courant::python
