#include "courant/integrators/step/field_projector.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/integrators/methods/projector_laws.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

// Mistakes that these cases have to notice:
//  * given fields are taken for one-forms on the basis of the point
//  * fields that vary are called the same everywhere
BOOST_AUTO_TEST_SUITE(field_projector)

using namespace courant;

namespace {

std::vector<std::string> failed(const Projector& projector, const Manifold& manifold,
                                std::span<const ConstrainedPoint> points) {
  std::vector<std::string> laws;
  for (const LawResult& result : check_projector(projector, manifold, points))
    if (!result.passed()) laws.push_back(result.law);
  return laws;
}

// (1, x₃, 0, 2) and (0, -1, x₀², 1) on R⁴.
ExprMatrix two_fields(const ExprVector& x) {
  ExprMatrix V = ExprMatrix::Zero(4, 2);
  V(0, 0) = 1.0;
  V(1, 0) = x[3];
  V(3, 0) = 2.0;
  V(1, 1) = -1.0;
  V(2, 1) = square(x[0]);
  V(3, 1) = 1.0;
  return V;
}

}  // namespace

BOOST_AUTO_TEST_CASE(laws_hold) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const Euclidean space(4);
  std::vector<ConstrainedPoint> points;
  for (int i = 0; i < 3; ++i)
    points.push_back({VectorXd::NullaryExpr(4, [&] { return normal(generator); }),
                      MatrixXd::NullaryExpr(2, 4, [&] { return normal(generator); })});
  const FieldProjector varying(space, 2, two_fields);
  BOOST_TEST(failed(varying, space, points).empty());
  BOOST_TEST(!varying.has_constant_directions(2));
  const FieldProjector constant(space, 2, [](const ExprVector&) -> ExprMatrix {
    return constants(MatrixXd(MatrixXd::Identity(4, 2)));
  });
  BOOST_TEST(failed(constant, space, points).empty());
  BOOST_TEST(constant.has_constant_directions(2));
  BOOST_TEST(!constant.has_constant_directions(1));

  // On S² a turn about the first axis, whose bases are others at each point.
  const Sphere sphere(2);
  std::vector<ConstrainedPoint> on_sphere;
  for (int i = 0; i < 3; ++i) {
    const VectorXd x = sphere.random_point(generator);
    on_sphere.push_back({x, sphere.random_tangent(x, 1.0, generator).transpose()});
  }
  const FieldProjector turn(sphere, 1, [](const ExprVector& x) -> ExprMatrix {
    return ExprVector{{Expr(0.0), -x[2], x[1]}};
  });
  BOOST_TEST(failed(turn, sphere, on_sphere).empty());
}

// The span of the fields, whatever the conormals are.
BOOST_AUTO_TEST_CASE(points_move_along_the_fields) {
  const FieldProjector projector(Euclidean(4), 2, two_fields);
  const VectorXd x = Eigen::Vector4d(0.5, -0.3, 0.7, 1.5);
  const MatrixXd conormals = MatrixXd::Identity(4, 2);
  const MatrixXd W = projector.directions(x, LinearMap<double>::identity(4), conormals);
  const Eigen::Vector4d first(1.0, 1.5, 0.0, 2.0), second(0.0, -1.0, 0.25, 1.0);
  for (const Eigen::Vector4d& field : {first, second})
    BOOST_TEST((field - W * (W.transpose() * field)).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  const Euclidean space(4);
  BOOST_CHECK_THROW(FieldProjector(space, 3, two_fields), std::invalid_argument);
  BOOST_CHECK_THROW(FieldProjector(Euclidean(5), 2, two_fields), std::invalid_argument);
  const FieldProjector projector(space, 2, two_fields);
  const VectorXd x = Eigen::Vector4d(0.5, -0.3, 0.7, 1.5);
  const auto identity = LinearMap<double>::identity(4);
  BOOST_CHECK_THROW(projector.directions(x, identity, MatrixXd::Identity(4, 1)),
                    std::invalid_argument);
  // dx₀ + 4 dx₂ - dx₃/2 annihilates the first field, dx₁ + dx₃ the second but for x₀².
  MatrixXd meeting(4, 2);
  meeting << 1.0, 0.0, 0.0, 1.0, 4.0, 0.0, -0.5, 1.0;
  const VectorXd there = Eigen::Vector4d(0.0, -0.3, 0.7, -2.0);
  BOOST_CHECK_THROW(projector.directions(there, identity, meeting), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
