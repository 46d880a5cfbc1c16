// Discretization maps, projectors and integrators of one's own in Python.
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/python/conversions.hpp"

namespace courant::python {
namespace {

class MapOfPython final : public DiscretizationMap {
 public:
  MapOfPython(std::string name, const py::object& manifold, int order, bool is_symmetric,
              double stage_time)
      : DiscretizationMap(std::move(name), kept<Manifold>(manifold)),
        order_(order),
        is_symmetric_(is_symmetric),
        stage_time_(stage_time) {}

  bool has_inverse() const override {
    const py::gil_scoped_acquire locked;
    return static_cast<bool>(override_of<DiscretizationMap>(this, "inverse"));
  }
  int order() const override { return order_; }
  bool is_symmetric() const override { return is_symmetric_; }
  double stage_time() const override { return stage_time_; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override {
    const py::gil_scoped_acquire locked;
    const auto [first, second] =
        pair(required<DiscretizationMap>(this, "forward")(traced(x), traced(v)));
    return {first, second};
  }
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override {
    const py::gil_scoped_acquire locked;
    const auto [x, v] = pair(required<DiscretizationMap>(this, "inverse")(traced(x0), traced(x1)));
    return {x, v};
  }
  static std::pair<ExprVector, ExprVector> pair(const py::object& two) {
    if (!py::isinstance<py::sequence>(two) || py::len(two) != 2)
      throw py::type_error("a discretization map returned " + std::string(py::repr(two)) +
                           ", expected two arrays");
    return {to_vector(two[py::int_(0)]), to_vector(two[py::int_(1)])};
  }

  int order_;
  bool is_symmetric_;
  double stage_time_;
};

class ProjectorOfPython final : public Projector {
 public:
  explicit ProjectorOfPython(std::string name) : Projector(std::move(name)) {}

 private:
  ExprMatrix do_directions(const ExprVector& x, const Expr&, const LinearMap<Expr>& tangents,
                           const ExprMatrix& conormals) const override {
    const py::gil_scoped_acquire locked;
    return to_matrix(required<Projector>(this, "directions")(traced(x), traced(tangents.matrix()),
                                                             traced(conormals)));
  }
};

class IntegratorOfPython;

// Steps are calls of Python: the GIL is taken for each.
class StepperOfPython final : public Stepper {
 public:
  StepperOfPython(std::shared_ptr<const ImplicitSystem> system, std::string name, py::object owner)
      : Stepper(std::move(name), std::move(system)), owner_(std::move(owner)) {}
  ~StepperOfPython() override {
    const py::gil_scoped_acquire locked;
    owner_ = py::object();
  }

 private:
  void do_step(const State& before, double h, State& after) override {
    const py::gil_scoped_acquire locked;
    after.x = owner_.attr("step")(before.t, before.x, h).cast<VectorXd>();
    if (after.x.size() != before.x.size())
      throw py::value_error(method() + ".step returned " + std::to_string(after.x.size()) +
                            " numbers, expected " + std::to_string(before.x.size()));
    after.v = before.v;
    after.z = before.z;
  }
  void do_keep(const State& before, const State&) override { stage_ = before; }
  void do_stage(Step& step) const override { step.stage = stage_; }
  void do_forget() override {}
  std::unique_ptr<Stepper> do_fresh() const override {
    const py::gil_scoped_acquire locked;
    return std::make_unique<StepperOfPython>(system_of(), method(), owner_);
  }
  bool do_keeps_to_manifold() const override { return false; }
  std::shared_ptr<const ImplicitSystem> system_of() const;

  py::object owner_;
  State stage_;
};

class IntegratorOfPython final : public Integrator {
 public:
  IntegratorOfPython(const py::object& system, std::string name, int order, bool is_symmetric)
      : Integrator(kept<ImplicitSystem>(system)),
        name_(std::move(name)),
        order_(order),
        is_symmetric_(is_symmetric) {}

  std::string name() const override { return name_; }
  int order() const override { return order_; }
  bool is_symmetric() const override { return is_symmetric_; }
  bool is_native() const override { return false; }

 private:
  std::unique_ptr<Stepper> do_stepper() const override {
    const py::gil_scoped_acquire locked;
    return std::make_unique<StepperOfPython>(system(), name_,
                                             py::cast(static_cast<const Integrator*>(this)));
  }

  std::string name_;
  int order_;
  bool is_symmetric_;
};

std::shared_ptr<const ImplicitSystem> StepperOfPython::system_of() const {
  return owner_.cast<const Integrator*>()->system();
}

}  // namespace

void bind_methods(py::module_& module) {
  py::class_<DiscretizationMap, MapOfPython, std::shared_ptr<DiscretizationMap>>(
      module, "DiscretizationMap")
      .def(py::init<std::string, py::object, int, bool, double>())
      .def_property_readonly("name", &DiscretizationMap::name)
      .def_property_readonly("order", &DiscretizationMap::order)
      .def("forward",
           [](const DiscretizationMap& map, const py::object& x, const py::object& v) {
             const auto both = map.forward(to_vector(x), to_vector(v));
             return py::make_tuple(traced(both.first), traced(both.second));
           })
      .def("inverse",
           [](const DiscretizationMap& map, const py::object& x0, const py::object& x1) {
             const auto both = map.inverse(to_vector(x0), to_vector(x1));
             return py::make_tuple(traced(both.x), traced(both.v));
           })
      .def("__repr__", &DiscretizationMap::name);
  py::class_<Projector, ProjectorOfPython, std::shared_ptr<Projector>>(module, "Projector")
      .def(py::init<std::string>())
      .def_property_readonly("name", &Projector::name)
      .def("__repr__", &Projector::name);
  py::class_<Integrator, IntegratorOfPython, std::shared_ptr<Integrator>>(module, "Integrator")
      .def(py::init<py::object, std::string, int, bool>())
      .def_property_readonly("name", &Integrator::name)
      .def_property_readonly("order", &Integrator::order)
      .def("__repr__", &Integrator::name);
}

}  // namespace courant::python
