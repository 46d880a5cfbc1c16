#include "courant/integrators/maps/adjoint.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/tests/integrators/example_systems.hpp"

BOOST_AUTO_TEST_SUITE(adjoint)

using namespace courant;

// Implicit Euler is the adjoint of explicit Euler; 1-θ of θ.
BOOST_AUTO_TEST_CASE(of_theta_is_one_minus_theta) {
  const auto group = std::make_shared<SpecialOrthogonal3>();
  std::mt19937 generator(1);
  const VectorXd x = group->random_point(generator);
  const VectorXd v = group->random_tangent(x, 1.0, generator);
  for (const double theta : {0.0, 0.25, 0.5}) {
    const Adjoint adjoint(std::make_shared<Theta>(group, theta));
    const Theta other(group, 1.0 - theta);
    const auto [a0, a1] = adjoint.forward(x, v);
    const auto [b0, b1] = other.forward(x, v);
    BOOST_TEST((a0 - b0).norm() + (a1 - b1).norm() < 1e-15);
    const auto [y, w] = adjoint.inverse(a0, a1);
    BOOST_TEST((y - x).norm() + (w - v).norm() < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(of_the_adjoint_is_the_map) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto map = std::make_shared<Theta>(sphere, 0.2);
  const Adjoint twice(std::make_shared<Adjoint>(map));
  std::mt19937 generator(1);
  const VectorXd x = sphere->random_point(generator);
  const VectorXd v = sphere->random_tangent(x, 1.0, generator);
  BOOST_TEST((twice.forward(x, v).first - map->forward(x, v).first).norm() == 0.0);
  BOOST_TEST((twice.forward(x, v).second - map->forward(x, v).second).norm() == 0.0);
  BOOST_TEST(twice.name() == "Adjoint(Adjoint(Theta(0.2)))");
}

// A step h of the adjoint undoes a step -h, where the system depends on time too: q̈ = t².
BOOST_AUTO_TEST_CASE(of_explicit_euler_with_time) {
  const auto plane = std::make_shared<Euclidean>(2);
  const auto system = std::make_shared<examples::FormulaSystem>(
      plane, 0, 2, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr& t) {
        return (ExprVector(2) << v[0] - x[1], v[1] - square(t)).finished();
      });
  const auto euler = std::make_shared<Theta>(plane, 0.0);
  const DiscretizeFirst there(system, euler), back(system, std::make_shared<Adjoint>(euler));
  const State start{0.7, Eigen::Vector2d(0.3, -0.4), {}, {}};
  const double h = 0.25;
  const State end = there.advance(start, h);
  BOOST_TEST(end.x[1] == -0.4 + h * 0.49, boost::test_tools::tolerance(1e-14));
  BOOST_TEST((back.advance(end, -h).x - start.x).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(a_null_map_is_an_error) {
  BOOST_CHECK_THROW(Adjoint(nullptr), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
