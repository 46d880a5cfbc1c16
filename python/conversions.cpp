#include "courant/python/conversions.hpp"

#include <cmath>
#include <utility>

namespace courant::python {
namespace {

py::object wrapped(py::array array) {
  static py::object& traced_array =
      *new py::object(py::module_::import("courant._trace").attr("TracedArray"));
  return array.attr("view")(traced_array);
}

py::array objects(const std::vector<py::ssize_t>& shape) {
  static py::object& empty = *new py::object(py::module_::import("numpy").attr("empty"));
  return empty(shape, "O");
}

// Takes the place of an entry, which is None.
void put(py::array& array, py::ssize_t i, const Expr& value) {
  auto** const entries = static_cast<PyObject**>(array.mutable_data());
  py::object entry = value.is_constant() ? py::object(py::float_(value.value())) : py::cast(value);
  Py_XDECREF(std::exchange(entries[i], entry.release().ptr()));
}

bool is_iterable(py::handle object) {
  return py::isinstance<py::iterable>(object) && !py::isinstance<py::str>(object) &&
         !py::isinstance<Expr>(object);
}

}  // namespace

Expr to_expr(py::handle object) {
  if (py::isinstance<Expr>(object)) return object.cast<Expr>();
  if (py::isinstance<py::array>(object) && py::reinterpret_borrow<py::array>(object).size() == 1)
    return to_expr(object.attr("item")());
  const double number = PyFloat_AsDouble(object.ptr());
  if (number == -1.0 && PyErr_Occurred()) throw py::error_already_set();
  return number;
}

ExprVector to_vector(py::handle object) {
  if (!is_iterable(object) || (py::isinstance<py::array>(object) &&
                               py::reinterpret_borrow<py::array>(object).ndim() == 0)) {
    ExprVector one(1);
    one[0] = to_expr(object);
    return one;
  }
  std::vector<Expr> entries;
  for (const py::handle entry : object) {
    if (is_iterable(entry))  // a matrix, row by row
      for (const Expr& inner : to_vector(entry)) entries.push_back(inner);
    else
      entries.push_back(to_expr(entry));
  }
  ExprVector vector(static_cast<Index>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i) vector[static_cast<Index>(i)] = entries[i];
  return vector;
}

ExprMatrix to_matrix(py::handle object) {
  std::vector<ExprVector> rows;
  for (const py::handle row : object) rows.push_back(to_vector(row));
  const Index columns = rows.empty() ? 0 : rows[0].size();
  ExprMatrix matrix(static_cast<Index>(rows.size()), columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != columns)
      throw py::value_error("row " + std::to_string(i) + " of a matrix has " +
                            std::to_string(rows[i].size()) + " entries, expected " +
                            std::to_string(columns) + " as in the first");
    matrix.row(static_cast<Index>(i)) = rows[i].transpose();
  }
  return matrix;
}

py::object traced(const ExprVector& vector) { return traced(vector, {vector.size()}); }

py::object traced(const ExprVector& vector, const std::vector<Index>& shape) {
  py::array array = objects({shape.begin(), shape.end()});
  for (Index i = 0; i < vector.size(); ++i) put(array, i, vector[i]);
  return wrapped(std::move(array));
}

py::object traced(const ExprMatrix& matrix) {
  py::array array = objects({matrix.rows(), matrix.cols()});
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j) put(array, i * matrix.cols() + j, matrix(i, j));
  return wrapped(std::move(array));
}

std::shared_ptr<py::object> held(py::object object) {
  return {new py::object(std::move(object)), [](py::object* pointer) {
            if (Py_IsInitialized() == 0) return;
            const py::gil_scoped_acquire locked;
            delete pointer;
          }};
}

py::array_t<double> owned(std::vector<double>&& numbers, py::ssize_t rows, py::ssize_t columns) {
  auto moved = std::make_unique<std::vector<double>>(std::move(numbers));
  double* const data = moved->data();
  const py::capsule owner(moved.get(),
                          [](void* p) { delete static_cast<std::vector<double>*>(p); });
  moved.release();
  return py::array_t<double>({rows, columns}, data, owner);
}

py::object to_python(const Json& json) {
  switch (json.type()) {
    case Json::value_t::object: {
      py::dict dict;
      for (const auto& [key, value] : json.items()) dict[py::str(key)] = to_python(value);
      return dict;
    }
    case Json::value_t::array: {
      py::list list;
      for (const Json& value : json) list.append(to_python(value));
      return list;
    }
    case Json::value_t::string:
      return py::str(json.get_ref<const std::string&>());
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_float:
      return py::float_(json.get<double>());
    default:
      return py::none();
  }
}

Json to_json(py::handle object) {
  if (object.is_none()) return nullptr;
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::isinstance<py::int_>(object)) return object.cast<std::int64_t>();
  if (py::isinstance<py::float_>(object)) return object.cast<double>();
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (py::isinstance<py::dict>(object)) {
    Json json = Json::object();
    for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(object)) {
      if (!py::isinstance<py::str>(key))
        throw py::type_error("a key of an experiment is " + std::string(py::repr(key)) +
                             ", expected a text");
      json[key.cast<std::string>()] = to_json(value);
    }
    return json;
  }
  if (py::hasattr(object, "tolist")) return to_json(object.attr("tolist")());  // numpy
  if (py::isinstance<py::iterable>(object)) {
    Json json = Json::array();
    for (const py::handle entry : object) json.push_back(to_json(entry));
    return json;
  }
  throw py::type_error("an experiment has no place for " + std::string(py::repr(object)) +
                       "; expected numbers, texts, lists, dictionaries");
}

}  // namespace courant::python
