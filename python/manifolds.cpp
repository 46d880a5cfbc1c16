// Manifolds in Python: those of the catalogue, and classes of one's own.
#include <random>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/hyperbolic.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/stiefel.hpp"
#include "courant/manifolds/symmetric_positive_definite.hpp"
#include "courant/manifolds/tangent_bundle.hpp"
#include "courant/manifolds/torus.hpp"
#include "courant/python/conversions.hpp"

namespace courant::python {
namespace {

// A manifold whose maps are methods of a class of Python, traced when they are needed.
class ManifoldOfPython final : public Manifold {
 public:
  ManifoldOfPython(std::string name, Index n, Index N, Index tangent)
      : Manifold(std::move(name), n, N, tangent) {}

  bool has_inverse() const override {
    const py::gil_scoped_acquire locked;
    return static_cast<bool>(override_of<Manifold>(this, "inverse_retract"));
  }
  bool is_geodesic() const override {
    const py::gil_scoped_acquire locked;
    const py::function claim = override_of<Manifold>(this, "is_geodesic");
    return claim && claim().cast<bool>();
  }

 private:
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override {
    return vector("retract", x, v);
  }
  ExprMatrix do_frame(const ExprVector& x) const override { return matrix("frame", x); }
  ExprMatrix do_coframe(const ExprVector& x) const override { return matrix("coframe", x); }
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override {
    return vector("inverse_retract", x, y);
  }
  ExprVector do_constraint(const ExprVector& x) const override {
    const py::gil_scoped_acquire locked;
    const py::function constraint = override_of<Manifold>(this, "constraint");
    return constraint ? to_vector(constraint(traced(x))) : ExprVector(0);
  }
  double do_injectivity_radius(const VectorXd& x) const override {
    const py::gil_scoped_acquire locked;
    const py::function radius = override_of<Manifold>(this, "injectivity_radius");
    return radius ? radius(x).cast<double>() : std::numeric_limits<double>::infinity();
  }
  double do_separation(const VectorXd& x, const VectorXd& y) const override {
    const py::gil_scoped_acquire locked;
    const py::function separation = override_of<Manifold>(this, "separation");
    return separation ? separation(x, y).cast<double>() : (x - y).norm();
  }

  template <class... Vectors>
  ExprVector vector(const char* name, const Vectors&... arguments) const {
    const py::gil_scoped_acquire locked;
    return to_vector(required<Manifold>(this, name)(traced(arguments)...));
  }
  // On an open subset of Rⁿ velocities are their own coordinates, unless the class says otherwise.
  ExprMatrix matrix(const char* name, const ExprVector& x) const {
    const py::gil_scoped_acquire locked;
    const bool is_open = dimension() == ambient_dimension() && dimension() == tangent_dimension();
    if (is_open && !override_of<Manifold>(this, name))
      return ExprMatrix::Identity(dimension(), dimension());
    return to_matrix(required<Manifold>(this, name)(traced(x)));
  }
};

// Numbers where all entries are known, else a traced array.
template <class Matrix>
py::object known_or_traced(const Matrix& matrix) {
  if (matrix.unaryExpr([](const Expr& entry) { return entry.is_constant(); }).all())
    return py::cast(values(matrix));
  return traced(matrix);
}

using Class = py::class_<Manifold, ManifoldOfPython, std::shared_ptr<Manifold>>;

template <class Space>
using ClassOf = py::class_<Space, Manifold, std::shared_ptr<Space>>;

template <class Group>
std::shared_ptr<Group> group(const std::string& retraction) {
  if (retraction == "exponential") return std::make_shared<Group>(Group::exponential());
  if (retraction == "cayley") return std::make_shared<Group>(Group::cayley());
  throw py::value_error("retraction is \"" + retraction +
                        "\", expected \"exponential\" or \"cayley\"");
}

void bind_catalogue(py::module_& module) {
  ClassOf<Euclidean>(module, "Euclidean", "Rⁿ.").def(py::init<Index>(), py::arg("n"));
  ClassOf<Torus>(module, "Torus", "n angles.").def(py::init<Index>(), py::arg("n"));
  ClassOf<Sphere>(module, "Sphere", "Sⁿ in R^(n+1); retraction \"exponential\" or \"projective\".")
      .def(py::init([](Index n, const std::string& retraction) {
             if (retraction == "exponential")
               return std::make_shared<Sphere>(n, Sphere::exponential());
             if (retraction == "projective")
               return std::make_shared<Sphere>(n, Sphere::projective());
             throw py::value_error("retraction is \"" + retraction +
                                   "\", expected \"exponential\" or \"projective\"");
           }),
           py::arg("n"), py::arg("retraction") = "exponential");
  ClassOf<Hyperbolic>(module, "Hyperbolic", "Hⁿ, the hyperboloid in R^(n+1).")
      .def(py::init<Index>(), py::arg("n"));
  ClassOf<Stiefel>(module, "Stiefel", "n × k matrices with orthonormal columns.")
      .def(py::init<Index, Index>(), py::arg("n"), py::arg("k"));
  ClassOf<SpecialOrthogonal>(module, "SpecialOrthogonal", "SO(n).")
      .def(py::init<Index>(), py::arg("n"));
  ClassOf<SpecialOrthogonal3>(module, "SO3", "Rotations; retraction \"exponential\" or \"cayley\".")
      .def(py::init(&group<SpecialOrthogonal3>), py::arg("retraction") = "exponential");
  ClassOf<SpecialEuclidean3>(module, "SE3",
                             "Rigid motions; retraction \"exponential\" or \"cayley\".")
      .def(py::init(&group<SpecialEuclidean3>), py::arg("retraction") = "exponential");
  ClassOf<SymmetricPositiveDefinite>(module, "SymmetricPositiveDefinite",
                                     "Symmetric positive definite n × n matrices.")
      .def(py::init<Index>(), py::arg("n"));
  ClassOf<Product>(module, "Product", "M₁ × … × M_k.")
      .def(py::init([](const std::vector<py::object>& factors) {
             std::vector<std::shared_ptr<const Manifold>> manifolds;
             for (const py::object& factor : factors) manifolds.push_back(kept<Manifold>(factor));
             return std::make_shared<Product>(std::move(manifolds));
           }),
           py::arg("factors"));
  ClassOf<TangentBundle>(module, "TangentBundle", "TM.")
      .def(py::init([](const py::object& base) {
             return std::make_shared<TangentBundle>(kept<Manifold>(base));
           }),
           py::arg("base"));
  ClassOf<CotangentBundle>(module, "CotangentBundle", "T*M.")
      .def(py::init([](const py::object& base) {
             return std::make_shared<CotangentBundle>(kept<Manifold>(base));
           }),
           py::arg("base"));
}

}  // namespace

void bind_manifolds(py::module_& module) {
  Class(module, "Manifold")
      .def(py::init<std::string, Index, Index, Index>())
      .def_property_readonly("name", &Manifold::name)
      .def_property_readonly("dimension", &Manifold::dimension)
      .def_property_readonly("ambient_dimension", &Manifold::ambient_dimension)
      .def_property_readonly("tangent_dimension", &Manifold::tangent_dimension)
      .def(
          "retract",
          [](const Manifold& M, const py::object& x, const py::object& v) {
            return known_or_traced(M.retract(to_vector(x), to_vector(v)));
          },
          py::arg("x"), py::arg("v"),
          "R(x, v), a point (N,), of a point x (N,) and a tangent vector v (Ñ,).")
      .def(
          "inverse_retract",
          [](const Manifold& M, const py::object& x, const py::object& y) {
            return known_or_traced(M.inverse_retract(to_vector(x), to_vector(y)));
          },
          py::arg("x"), py::arg("y"), "v (Ñ,) with R(x, v) = y, of points x, y (N,).")
      .def(
          "frame",
          [](const Manifold& M, const py::object& x) {
            return known_or_traced(M.frame(to_vector(x)).matrix());
          },
          py::arg("x"), "E(x), N × Ñ: dx/dt = E(x) v.")
      .def(
          "coframe",
          [](const Manifold& M, const py::object& x) {
            return known_or_traced(M.coframe(to_vector(x)).matrix());
          },
          py::arg("x"), "C(x), Ñ × N: v = C(x) dx/dt.")
      .def(
          "constraint",
          [](const Manifold& M, const py::object& x) {
            return known_or_traced(M.constraint(to_vector(x)));
          },
          py::arg("x"),
          "Functions that vanish on the manifold, (c,); none on an open subset of Rⁿ.")
      .def("project", &Manifold::project, py::arg("x"), "A point of the manifold near x, (N,).")
      .def("separation", &Manifold::separation, py::arg("x"), py::arg("y"),
           "The distance of two points, or what the class says it is.")
      .def("injectivity_radius", &Manifold::injectivity_radius, py::arg("x"),
           "How long tangent vectors at x may be for R(x, ·) to be inverted.")
      .def("point_defect", &Manifold::point_defect, py::arg("x"),
           "How far x is from the manifold: the greatest entry of its constraint.")
      .def("tangent_defect", &Manifold::tangent_defect, py::arg("x"), py::arg("v"),
           "How far v is from a tangent vector at x.")
      .def(
          "random_point",
          [](const Manifold& M, std::uint32_t seed) {
            std::mt19937 generator(seed);
            return M.random_point(generator);
          },
          py::arg("seed") = 1, "A point of the manifold, (N,), the same for a seed.")
      .def("__repr__", &Manifold::name);
  bind_catalogue(module);
}

}  // namespace courant::python
