// What the base class derives from the few functions that a manifold supplies.
#include "courant/manifolds/manifold.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/matrix_group.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"

// Mistakes that these cases have to notice:
//  * velocities across the tangent space pass for tangent
//  * the greatest constraint counts, negative ones not
//  * Newton's method for the inverse takes what is far for found
//  * a projection takes what is far for found
//  * random tangent vectors of the wrong length
BOOST_AUTO_TEST_SUITE(manifold)

using namespace courant;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// The circle with a retraction that has no closed inverse here, and nothing but what is required.
class Bare final : public Manifold {
 public:
  Bare() : Manifold("Bare", 1, 2, 2) {}
  bool has_inverse() const override { return false; }

 private:
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override {
    return (x + v) / sqrt((x + v).squaredNorm());
  }
  ExprMatrix do_frame(const ExprVector& x) const override {
    return ExprMatrix::Identity(2, 2) - x * x.transpose();
  }
  ExprMatrix do_coframe(const ExprVector& x) const override { return do_frame(x); }
  ExprVector do_constraint(const ExprVector& x) const override {
    return ExprVector::Constant(1, x.squaredNorm() - 1.0);
  }
};

class Sized final : public Manifold {
 public:
  Sized(Index dimension, Index ambient, Index tangent)
      : Manifold("Sized", dimension, ambient, tangent) {}

 private:
  ExprVector do_retract(const ExprVector& x, const ExprVector&) const override { return x; }
  ExprMatrix do_frame(const ExprVector&) const override {
    return ExprMatrix::Zero(ambient_dimension(), tangent_dimension());
  }
  ExprMatrix do_coframe(const ExprVector&) const override {
    return ExprMatrix::Zero(tangent_dimension(), ambient_dimension());
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(inverse_by_newton) {
  const Bare M;
  const Vector2d x(0.6, 0.8);
  for (const double length : {0.0, 1e-8, 0.5, 3.0}) {
    const VectorXd v = length * Vector2d(-0.8, 0.6);
    BOOST_TEST((M.inverse_retract(x, M.retract(x, v)) - v).norm() < 1e-13);
  }
  BOOST_CHECK_THROW(M.inverse_retract(x, -x), std::domain_error);
  BOOST_CHECK_THROW(M.inverse_retract(constants(x), constants(x)), std::logic_error);
}

BOOST_AUTO_TEST_CASE(projection_by_gauss_newton) {
  const Bare M;
  const VectorXd x = M.project(Vector2d(3.0, -4.0));
  BOOST_TEST((x - Vector2d(0.6, -0.8)).norm() < 1e-15);
  BOOST_TEST((M.project(x) - x).norm() < 1e-16);
  BOOST_CHECK_THROW(M.project(Vector2d(0.0, 0.0)), std::domain_error);
}

BOOST_AUTO_TEST_CASE(bases_and_defects) {
  const Bare M;
  const Vector2d x(0.6, 0.8);
  const MatrixXd B = M.tangent_basis(x);
  BOOST_TEST(B.rows() == 2);
  BOOST_TEST(B.cols() == 1);
  BOOST_TEST(B.norm() == 1.0, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(std::abs(B.col(0).dot(x)) < 1e-15);
  BOOST_TEST(M.point_defect(2.0 * x) == 3.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(M.tangent_defect(x, x) == 0.8, boost::test_tools::tolerance(1e-14));
  std::mt19937 generator(1);
  BOOST_TEST(M.random_tangent(x, 2.5, generator).norm() == 2.5,
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(expressions_and_numbers_give_the_same) {
  const Bare M;
  Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const ExprVector y = M.retract(x, ExprVector(Expr(2.0) * x));
  BOOST_TEST(!y[0].is_constant());
  BOOST_TEST(M.retract(Vector2d(0.6, 0.8), Vector2d(1.2, 1.6))[0] == 0.6,
             boost::test_tools::tolerance(1e-15));
}

// R(v_x) = x + v_x, to the bit, with what belongs to it: the tangent spaces are Rⁿ, and every point is reached.
BOOST_AUTO_TEST_CASE(remark_4_2_the_retraction_of_a_vector_space) {
  const Euclidean space(3);
  const Vector3d x(0.3, -2.0, 1e3), v(0.7, 5.0, -0.25);
  BOOST_TEST(VectorXd(space.retract(x, v)) == VectorXd(x + v));
  BOOST_TEST(VectorXd(space.retract(x, Vector3d::Zero())) == VectorXd(x));
  BOOST_TEST(VectorXd(space.inverse_retract(x, x + v)) == VectorXd(x + v - x));
  BOOST_TEST(space.frame(x).is_identity());
  BOOST_TEST(std::isinf(space.injectivity_radius(x)));
}

// On Heisenberg's group and on GL(n) tangent vectors have as many entries as points, and others than velocities.
BOOST_AUTO_TEST_CASE(vectors_that_are_velocities) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto heisenberg = std::make_shared<MatrixGroup>(MatrixAlgebra::heisenberg(1));
  BOOST_TEST(Euclidean(3).has_velocities_as_vectors());
  BOOST_TEST(Sphere(2).has_velocities_as_vectors());
  // Along a fibre over a curved base they are not.
  const CotangentBundle bundle(std::make_shared<Sphere>(2));
  std::mt19937 generator(2);
  const auto among = bundle.velocities_among_components(bundle.random_point(generator));
  BOOST_TEST(among.head(3).all());
  BOOST_TEST(!among.all());
  BOOST_TEST(!heisenberg->has_velocities_as_vectors());
  BOOST_TEST(!MatrixGroup(MatrixAlgebra::gl(2)).has_velocities_as_vectors());
  BOOST_TEST(!SpecialOrthogonal3().has_velocities_as_vectors());
  BOOST_TEST(!Product({line, heisenberg}).has_velocities_as_vectors());
  BOOST_TEST(!CotangentBundle(heisenberg).has_velocities_as_vectors());
}

BOOST_AUTO_TEST_CASE(errors) {
  BOOST_CHECK_THROW(Sized(-1, 2, 2), std::invalid_argument);
  BOOST_CHECK_THROW(Sized(3, 2, 3), std::invalid_argument);
  BOOST_CHECK_THROW(Sized(3, 3, 2), std::invalid_argument);
  BOOST_CHECK_THROW(Euclidean(-1), std::invalid_argument);
  BOOST_CHECK_THROW(Euclidean(3).retract(Vector3d::Zero(), Vector2d::Zero()),
                    std::invalid_argument);
  // A constraint is needed where n < N, and not where n = N.
  BOOST_CHECK_THROW(Sized(1, 2, 1).constraint(Vector2d(0.0, 0.0)), std::logic_error);
  BOOST_TEST(Sized(2, 2, 2).constraint(Vector2d(0.0, 0.0)).size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
