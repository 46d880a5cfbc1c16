#include "courant/integrators/step/space_formulas.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/torus.hpp"

BOOST_AUTO_TEST_SUITE(space_formulas)

using namespace courant;

BOOST_AUTO_TEST_CASE(flat_spaces_have_none) {
  for (const SpaceFormulas& space : {SpaceFormulas(Euclidean(3)), SpaceFormulas(Torus(2))}) {
    BOOST_TEST(!space.has_basis());
    BOOST_TEST(!space.has_equations());
  }
}

// A group has equations, but its tangent vectors need no basis.
BOOST_AUTO_TEST_CASE(of_a_group) {
  const SpaceFormulas space{SpecialOrthogonal3()};
  BOOST_TEST(!space.has_basis());
  BOOST_TEST(space.has_equations());
}

BOOST_AUTO_TEST_CASE(of_a_sphere) {
  const Sphere sphere(3);
  const SpaceFormulas space(sphere);
  const Function projected("projected", space.basis, {});
  const Function constraint("constraint", space.constraint, {});
  std::mt19937 generator(1);
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd x = sphere.random_point(generator);
    const VectorXd columns = VectorXd::Random(12);
    const MatrixXd expected = sphere.tangent_projector(x).matrix() * columns.reshaped(4, 3);
    BOOST_TEST((projected({x, columns}).reshaped(4, 3) - expected).norm() < 1e-15);
    BOOST_TEST(std::abs(constraint({x})[0]) < 1e-15);
    BOOST_TEST(std::abs(constraint({VectorXd(2.0 * x)})[0]) > 0.1);
  }
}

BOOST_AUTO_TEST_SUITE_END()
