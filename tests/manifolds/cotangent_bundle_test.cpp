#include "courant/manifolds/cotangent_bundle.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include "catalogue.hpp"
#include "courant/core/expressions/derivative.hpp"

// Mistakes that these cases have to notice:
//  * the sign of the torsion
//  * the frame of a flat space is a matrix
BOOST_AUTO_TEST_SUITE(cotangent_bundle)

using namespace courant;
using Eigen::Vector3d;

namespace {

VectorXd torsion(const CotangentBundle& M, const VectorXd& x, const VectorXd& v) {
  return values(M.torsion(constants(VectorXd(M.position(x))), constants(VectorXd(M.momentum(x))),
                          constants(v)));
}

// ω in the frame, as the class comment has it.
double frame_form(const CotangentBundle& M, const VectorXd& x, const VectorXd& a,
                  const VectorXd& b) {
  return M.vertical(b).dot(M.horizontal(a)) - M.vertical(a).dot(M.horizontal(b)) -
         torsion(M, x, M.horizontal(a)).dot(M.horizontal(b));
}

// dq ∧ dP of the ambient space, P = C(q)ᵀ p, pulled back along the frame.
double ambient_form(const CotangentBundle& M, const VectorXd& x, const VectorXd& a,
                    const VectorXd& b) {
  Graph graph;
  const ExprVector at = graph.variables("x", x.size());
  const ExprVector q = M.position(at);
  const ExprVector P = M.base()->coframe(q).transpose() * ExprVector(M.momentum(at));
  const auto rate = [&](const ExprVector& y, const VectorXd& v) -> VectorXd {
    const ExprVector along = tangent(y, at, constants(VectorXd(M.frame(x) * v)));
    return values(substitute(along, at, constants(x)));
  };
  return rate(q, a).dot(rate(P, b)) - rate(q, b).dot(rate(P, a));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_canonical_form_in_frames_is_that_of_the_ambient_space) {
  std::mt19937 generator(9);
  for (const auto& manifold : test::manifold_catalogue()) {
    const auto M = std::dynamic_pointer_cast<const CotangentBundle>(manifold);
    if (!M) continue;
    for (int i = 0; i < 3; ++i) {
      const VectorXd x = M->random_point(generator);
      const VectorXd a = M->random_tangent(x, 1.0, generator);
      const VectorXd b = M->random_tangent(x, 1.0, generator);
      const double expected = ambient_form(*M, x, a, b);
      BOOST_TEST(std::abs(frame_form(*M, x, a, b) - expected) < 1e-12 * (1.0 + x.squaredNorm()),
                 M->name());
    }
  }
}

// A matrix of its size would not fit into memory.
BOOST_AUTO_TEST_CASE(a_flat_space_of_many_dimensions_has_no_torsion) {
  const Index n = 100000;
  const CotangentBundle M(std::make_shared<Euclidean>(n));
  BOOST_TEST(torsion(M, VectorXd::Ones(2 * n), VectorXd::Ones(n)).isZero(0.0));
}

BOOST_AUTO_TEST_CASE(torsion_of_the_left_trivialisation_is_minus_the_bracket) {
  const CotangentBundle M(std::make_shared<SpecialOrthogonal3>());
  std::mt19937 generator(3);
  const VectorXd x = M.random_point(generator);
  const Vector3d p = M.momentum(x);
  const Vector3d v(0.2, -0.7, 1.1);
  // ⟨p, -v × w⟩ = ⟨v × p, w⟩
  BOOST_TEST((torsion(M, x, v) - v.cross(p)).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(torsion_of_the_sphere_vanishes) {
  const CotangentBundle M(std::make_shared<Sphere>(2));
  std::mt19937 generator(4);
  const VectorXd x = M.random_point(generator);
  const VectorXd v = M.base()->random_tangent(M.position(x), 1.0, generator);
  BOOST_TEST((M.base()->tangent_projector(M.position(x)) * torsion(M, x, v)).norm() < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
