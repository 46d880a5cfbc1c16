#include "courant/manifolds/implicit_submanifold.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "catalogue.hpp"

// Mistakes that these cases have to notice:
//  * the inverse is not tangent
//  * a point counts as on it when it is on the surrounding manifold
//  * a radius that does not see the curvature
BOOST_AUTO_TEST_SUITE(implicit_submanifold)

using namespace courant;
using Eigen::Vector3d;

namespace {

ImplicitSubmanifold unit_sphere() {
  return ImplicitSubmanifold(
      "UnitSphere", std::make_shared<Euclidean>(3),
      [](const ExprVector& x) {
        return ExprVector(ExprVector::Constant(1, x.squaredNorm() - 1.0));
      },
      1);
}

}  // namespace

// The sphere as {‖x‖² = 1} has the frame of Sphere and the orthographic retraction
// v + √(1 - ‖v‖²) x, curvature 1.
BOOST_AUTO_TEST_CASE(the_sphere_by_its_equation) {
  const ImplicitSubmanifold S = unit_sphere();
  const Sphere sphere(2);
  const Vector3d x = Vector3d(1.0, 2.0, -2.0) / 3.0;
  BOOST_TEST((S.frame(x).matrix() - sphere.frame(x).matrix()).norm() < 1e-15);
  BOOST_TEST((S.coframe(x).matrix() - sphere.coframe(x).matrix()).norm() < 1e-15);
  BOOST_TEST(S.injectivity_radius(x) == 0.5, boost::test_tools::tolerance(1e-13));
  const Vector3d unit = Vector3d(2.0, -1.0, 0.0).normalized();
  for (const double length : {0.0, 1e-8, 1e-4, 0.2, 0.4999}) {
    const Vector3d expected = length * unit + std::sqrt(1.0 - length * length) * x;
    BOOST_TEST((S.retract(x, length * unit) - expected).norm() < 1e-15);
    BOOST_TEST((S.inverse_retract(x, expected) - length * unit).norm() < 1e-15);
  }
}

// What the class comment says about M3: below 1e-14 inside the radius, and not far outside.
BOOST_AUTO_TEST_CASE(points_stay_on_it_within_the_radius) {
  for (const auto& M : {test::ellipsoid(), test::spherical_circle()}) {
    std::mt19937 generator(8);
    for (int i = 0; i < 20; ++i) {
      const VectorXd x = M->random_point(generator);
      const VectorXd v = M->random_tangent(x, 0.999 * M->injectivity_radius(x), generator);
      BOOST_TEST(M->point_defect(M->retract(x, v)) < 1e-14, M->name());
    }
  }
  const ImplicitSubmanifold S = unit_sphere();
  BOOST_TEST(!(S.point_defect(S.retract(Vector3d(1, 0, 0), Vector3d(0, 3, 0))) < 1e-3));
}

BOOST_AUTO_TEST_CASE(two_equations) {
  // A circle: the sphere of radius 2 and a plane through (0, 0, 1).
  const ImplicitSubmanifold C(
      "Circle", std::make_shared<Euclidean>(3),
      [](const ExprVector& x) {
        ExprVector c(2);
        c << x.squaredNorm() - 4.0, x[2] - 1.0;
        return c;
      },
      2);
  BOOST_TEST(C.dimension() == 1);
  const double radius = std::sqrt(3.0);
  const Vector3d x(radius, 0.0, 1.0);
  BOOST_TEST(C.injectivity_radius(x) == radius / 2, boost::test_tools::tolerance(1e-13));
  const Vector3d expected(std::sqrt(3.0 - 0.25), 0.5, 1.0);
  BOOST_TEST((C.retract(x, Vector3d(0.0, 0.5, 0.0)) - expected).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(errors) {
  const auto one = [](const ExprVector& x) { return ExprVector(x.head(1)); };
  BOOST_CHECK_THROW(ImplicitSubmanifold("S", nullptr, one, 1), std::invalid_argument);
  BOOST_CHECK_THROW(ImplicitSubmanifold("S", std::make_shared<Euclidean>(3), one, 2),
                    std::invalid_argument);
  BOOST_CHECK_THROW(ImplicitSubmanifold("S", std::make_shared<Euclidean>(0), one, 1),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
