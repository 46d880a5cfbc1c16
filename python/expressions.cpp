// Expr in Python: the scalar that functions are traced with.
#include <pybind11/operators.h>

#include <cmath>
#include <optional>

#include "courant/python/conversions.hpp"

namespace courant::python {
namespace {

// Calls courant._trace.<name>, which says in which line of the user's something cannot be traced, and raises.
[[noreturn]] void refuse(const char* name) {
  py::module_::import("courant._trace").attr(name)();
  throw py::type_error("cannot be traced");
}

Expr power(const Expr& base, double exponent) {
  const double whole = std::nearbyint(exponent);
  if (whole == exponent && std::fabs(exponent) <= 1e9) return pow(base, static_cast<int>(whole));
  if (exponent == 0.5) return sqrt(base);
  return pow(base, Expr(exponent));
}

Expr power(const Expr& base, const Expr& exponent) {
  return exponent.is_constant() ? power(base, exponent.value()) : pow(base, exponent);
}

template <class Operation>
void comparison(py::class_<Expr>& expr, const char* name, const Operation& of) {
  expr.def(name, of, py::is_operator());
  expr.def(
      name, [of](const Expr& a, double b) { return of(a, Expr(b)); }, py::is_operator());
}

}  // namespace

void bind_expressions(py::module_& module) {
  py::class_<Expr> expr(
      module, "Expr",
      "A number that is not known yet: what arrays hold while a function is traced.");
  expr.def(py::init<double>());
  py::implicitly_convertible<double, Expr>();
  py::implicitly_convertible<int, Expr>();
  expr.def(py::self + py::self)
      .def(py::self - py::self)
      .def(py::self * py::self)
      .def(py::self / py::self)
      .def(py::self + double())
      .def(double() + py::self)
      .def(py::self - double())
      .def(double() - py::self)
      .def(py::self * double())
      .def(double() * py::self)
      .def(py::self / double())
      .def(double() / py::self)
      .def(-py::self)
      .def("__pos__", [](const Expr& a) { return a; })
      .def("__abs__", [](const Expr& a) { return abs(a); })
      .def(
          "__pow__", [](const Expr& a, double b) { return power(a, b); }, py::is_operator())
      .def(
          "__pow__", [](const Expr& a, const Expr& b) { return power(a, b); }, py::is_operator())
      .def(
          "__rpow__", [](const Expr& a, double b) { return pow(Expr(b), a); }, py::is_operator());
  comparison(expr, "__lt__", [](const Expr& a, const Expr& b) { return a < b; });
  comparison(expr, "__le__", [](const Expr& a, const Expr& b) { return a <= b; });
  comparison(expr, "__gt__", [](const Expr& a, const Expr& b) { return a > b; });
  comparison(expr, "__ge__", [](const Expr& a, const Expr& b) { return a >= b; });
  comparison(expr, "__eq__", [](const Expr& a, const Expr& b) { return equal(a, b); });
  comparison(expr, "__ne__", [](const Expr& a, const Expr& b) { return logical_not(equal(a, b)); });
  comparison(expr, "__and__", [](const Expr& a, const Expr& b) { return logical_and(a, b); });
  comparison(expr, "__or__", [](const Expr& a, const Expr& b) { return logical_or(a, b); });
  expr.def("__invert__", [](const Expr& a) { return logical_not(a); })
      .def("__bool__",
           [](const Expr& a) {
             if (!a.is_constant()) refuse("refuse_truth");
             return a.value() != 0.0;
           })
      .def("__float__",
           [](const Expr& a) {
             if (!a.is_constant()) refuse("refuse_number");
             return a.value();
           })
      .def("__repr__", [](const Expr& a) { return to_string(a); })
      .def_property_readonly("is_constant", [](const Expr& a) { return a.is_constant(); });

  const auto function = [&](const char* name, Expr (*of)(const Expr&)) { module.def(name, of); };
  function("sqrt", sqrt);
  function("exp", exp);
  function("log", log);
  function("sin", sin);
  function("cos", cos);
  function("tan", tan);
  function("arcsin", asin);
  function("arccos", acos);
  function("arctan", atan);
  function("sinh", sinh);
  function("cosh", cosh);
  function("tanh", tanh);
  function("absolute", abs);
  function("sign", sign);
  function("square", square);
  module.def("arctan2", [](const Expr& y, const Expr& x) { return atan2(y, x); });
  module.def("minimum", [](const Expr& a, const Expr& b) { return min(a, b); });
  module.def("maximum", [](const Expr& a, const Expr& b) { return max(a, b); });
  module.def("select", [](const Expr& c, const Expr& a, const Expr& b) { return select(c, a, b); });
  module.def("is_expr", [](py::handle object) { return py::isinstance<Expr>(object); });
}

}  // namespace courant::python
