#include "courant/manifolds/hyperbolic.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

// Mistakes that these cases have to notice:
//  * distances of the sphere
BOOST_AUTO_TEST_SUITE(hyperbolic)

using namespace courant;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

Vector2d at(double distance) { return {std::cosh(distance), std::sinh(distance)}; }

double lorentz(const VectorXd& x, const VectorXd& y) { return x.dot(y) - 2.0 * x[0] * y[0]; }

}  // namespace

// H¹ is a line with the hyperbolic angle as its length.
BOOST_AUTO_TEST_CASE(the_line_adds_hyperbolic_angles) {
  const Hyperbolic H(1);
  const Vector2d x = at(0.7);
  const Vector2d unit(std::sinh(0.7), std::cosh(0.7));
  for (const double length : {-1.5, 1e-9, 0.4, 2.0}) {
    BOOST_TEST((H.retract(x, length * unit) - at(0.7 + length)).norm() < 1e-14);
    BOOST_TEST((H.inverse_retract(x, at(0.7 + length)) - length * unit).norm() < 1e-14);
  }
}

// The law of cosines of a right-angled triangle: cosh c = cosh a cosh b.
BOOST_AUTO_TEST_CASE(right_angled_triangle) {
  const Hyperbolic H(2);
  const Vector3d corner(1.0, 0.0, 0.0);
  const VectorXd a = H.retract(corner, Vector3d(0.0, 0.8, 0.0));
  const VectorXd b = H.retract(corner, Vector3d(0.0, 0.0, 1.3));
  const VectorXd v = H.inverse_retract(a, b);
  BOOST_TEST(std::cosh(std::sqrt(lorentz(v, v))) == std::cosh(0.8) * std::cosh(1.3),
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(the_lower_sheet_is_not_in_it) {
  const Hyperbolic H(2);
  BOOST_TEST(H.point_defect(Vector3d(-1.0, 0.0, 0.0)) == 2.0);
  BOOST_TEST(H.point_defect(H.project(Vector3d(-1.0, 3.0, 4.0))) < 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()
