// The laws of objects, measured.
#include "courant/integrators/maps/laws.hpp"

#include "courant/integrators/methods/integrator_laws.hpp"
#include "courant/integrators/methods/projector_laws.hpp"
#include "courant/manifolds/laws.hpp"
#include "courant/python/conversions.hpp"
#include "courant/structures/laws.hpp"

namespace courant::python {

void bind_laws(py::module_& module) {
  py::class_<LawResult>(module, "Law", "One law of one object: what was measured, and its bound.")
      .def_readonly("subject", &LawResult::subject)
      .def_readonly("law", &LawResult::law)
      .def_readonly("defect", &LawResult::defect)
      .def_readonly("bound", &LawResult::bound)
      .def_readonly("where", &LawResult::where)
      .def_property_readonly("passed", &LawResult::passed)
      .def("__repr__", [](const LawResult& result) {
        std::ostringstream text;
        text << result;
        return text.str();
      });
  module.def("laws_of_manifold",
             [](const py::object& manifold) { return check_manifold(*kept<Manifold>(manifold)); });
  module.def("laws_of_structure", [](const py::object& structure) {
    return check_structure(*kept<DiracStructure>(structure));
  });
  module.def("laws_of_map", [](const py::object& map) {
    return check_discretization_map(*kept<DiscretizationMap>(map));
  });
  module.def("laws_of_projector", [](const py::object& projector, const py::object& manifold,
                                     const VectorXd& x, const MatrixXd& conormals) {
    const std::vector<ConstrainedPoint> points = {{.x = x, .conormals = conormals}};
    return check_projector(*kept<Projector>(projector), *kept<Manifold>(manifold), points);
  });
  module.def("laws_of_integrator", [](const py::object& integrator, const VectorXd& x, double t,
                                      double step) {
    const auto method = kept<Integrator>(integrator);
    return check_integrator(*method,
                            {.system = method->system(), .initial = {.t = t, .x = x}, .step = step})
        .laws;
  });
}

}  // namespace courant::python
