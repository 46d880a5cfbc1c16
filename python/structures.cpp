// Dirac structures and implicit systems of one's own in Python.
#include "courant/python/conversions.hpp"
#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant::python {
namespace {

class StructureOfPython final : public DiracStructure {
 public:
  StructureOfPython(std::string name, const py::object& manifold, Index ports, Index equations)
      : DiracStructure(std::move(name), kept<Manifold>(manifold), ports, equations) {}

  bool is_dirac() const override {
    const py::gil_scoped_acquire locked;
    const py::function claim = override_of<DiracStructure>(this, "is_dirac");
    return !claim || claim().cast<bool>();
  }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override {
    const py::gil_scoped_acquire locked;
    const py::function membership = required<DiracStructure>(this, "membership");
    return to_vector(port_size() > 0 ? membership(traced(x), traced(v), traced(alpha), traced(u))
                                     : membership(traced(x), traced(v), traced(alpha)));
  }
};

class SystemOfPython final : public ImplicitSystem {
 public:
  SystemOfPython(const py::object& manifold, Index unknowns, Index equations, Names names)
      : ImplicitSystem(kept<Manifold>(manifold), unknowns, equations, std::move(names)) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override {
    const py::gil_scoped_acquire locked;
    return to_vector(
        required<ImplicitSystem>(this, "residual")(traced(x), traced(v), traced(z), t));
  }
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override {
    const py::gil_scoped_acquire locked;
    const py::function energy = override_of<ImplicitSystem>(this, "energy");
    if (!energy) return std::nullopt;
    return to_expr(energy(traced(x), traced(z), t));
  }
};

}  // namespace

void bind_structures(py::module_& module) {
  py::class_<DiracStructure, StructureOfPython, std::shared_ptr<DiracStructure>>(module,
                                                                                 "DiracStructure")
      .def(py::init<std::string, py::object, Index, Index>())
      .def_property_readonly("name", &DiracStructure::name)
      .def_property_readonly("ports", &DiracStructure::port_size)
      .def_property_readonly("equations", &DiracStructure::equation_count)
      .def(
          "membership",
          [](const DiracStructure& D, const py::object& x, const py::object& v,
             const py::object& alpha, const py::object& u) {
            return traced(D.membership(to_vector(x), to_vector(v), to_vector(alpha),
                                       u.is_none() ? ExprVector(0) : to_vector(u)));
          },
          py::arg("x"), py::arg("v"), py::arg("alpha"), py::arg("u") = py::none())
      .def("__repr__", &DiracStructure::name);
  py::class_<ImplicitSystem, SystemOfPython, std::shared_ptr<ImplicitSystem>>(module,
                                                                              "ImplicitSystem")
      .def(py::init([](const py::object& manifold, Index equations,
                       std::vector<std::string> unknowns, std::vector<std::string> coordinates,
                       std::vector<std::string> names) {
        const auto count = static_cast<Index>(unknowns.size());
        return std::make_unique<SystemOfPython>(
            manifold, count, equations,
            ImplicitSystem::Names{.coordinates = std::move(coordinates),
                                  .auxiliary = std::move(unknowns),
                                  .equations = std::move(names)});
      }))
      .def_property_readonly("equations", &ImplicitSystem::equation_count)
      .def_property_readonly("coordinates",
                             [](const ImplicitSystem& S) { return S.names().coordinates; })
      .def_property_readonly("unknowns",
                             [](const ImplicitSystem& S) { return S.names().auxiliary; })
      .def("residual", [](const ImplicitSystem& S, const py::object& x, const py::object& v,
                          const py::object& z, const py::object& t) {
        return traced(S.residual(to_vector(x), to_vector(v), to_vector(z), to_expr(t)));
      });
}

}  // namespace courant::python
