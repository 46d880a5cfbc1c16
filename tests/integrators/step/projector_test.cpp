#include "courant/integrators/step/projector.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/integrators/methods/projector_laws.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

// Mistakes that these cases have to notice:
//  * the momentum projector ignores its metric
//  * the momentum projector ignores units
//  * a constant is no term of its equation (integrators/step/natural_units.cpp)
BOOST_AUTO_TEST_SUITE(projector)

using namespace courant;
using Eigen::Vector4d;

namespace {

std::vector<std::string> failed(const Projector& projector, const Manifold& manifold,
                                std::span<const ConstrainedPoint> points) {
  std::vector<std::string> laws;
  for (const LawResult& result : check_projector(projector, manifold, points))
    if (!result.passed()) laws.push_back(result.law.substr(0, 2));
  return laws;
}

// Two constraints on R⁴ with random gradients.
std::vector<ConstrainedPoint> random_points() {
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  std::vector<ConstrainedPoint> points;
  for (int i = 0; i < 3; ++i)
    points.push_back({VectorXd::NullaryExpr(4, [&] { return normal(generator); }),
                      MatrixXd::NullaryExpr(2, 4, [&] { return normal(generator); })});
  return points;
}

// A projector of which the directions and claims can be replaced.
class Planted final : public Projector {
 public:
  using Directions = std::function<ExprMatrix(const ExprMatrix&)>;
  Planted(Directions directions, bool orthogonal, bool constant)
      : Projector("planted"),
        directions_(std::move(directions)),
        orthogonal_(orthogonal),
        constant_(constant) {}
  bool is_orthogonal() const override { return orthogonal_; }
  bool has_constant_directions(Index) const override { return constant_; }

 private:
  ExprMatrix do_directions(const ExprVector&, const Expr&, const LinearMap<Expr>&,
                           const ExprMatrix& conormals) const override {
    return directions_(conormals);
  }
  Directions directions_;
  bool orthogonal_, constant_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(laws_hold) {
  const Euclidean space(4);
  const auto points = random_points();
  const auto metric = [](const ExprVector& x) {
    ExprMatrix G = ExprMatrix::Identity(4, 4);
    G(0, 0) = 2.0 + square(x[1]);
    G(0, 1) = G(1, 0) = 0.3;
    return G;
  };
  BOOST_TEST(failed(OrthogonalProjector(), space, points).empty());
  BOOST_TEST(failed(OrthogonalProjector(Vector4d(1.0, 2.0, 1e-3, 10.0)), space, points).empty());
  BOOST_TEST(failed(OrthogonalProjector(space, metric), space, points).empty());
  BOOST_TEST(failed(MomentumProjector(space, {2, 3}), space, points).empty());
  BOOST_TEST(failed(MomentumProjector(space, {1, 2, 3}), space, points).empty());

  // On T*S², where bases are of use.
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2));
  std::mt19937 generator(3);
  std::vector<ConstrainedPoint> on_bundle;
  for (int i = 0; i < 3; ++i) {
    const VectorXd x = M->random_point(generator);
    on_bundle.push_back({x, M->random_tangent(x, 1.0, generator).transpose()});
  }
  BOOST_TEST(failed(MomentumProjector(M), *M, on_bundle).empty());
  VectorXd units = VectorXd::Ones(6);
  units.tail(3).setConstant(1e-3);
  BOOST_TEST(failed(OrthogonalProjector(units), *M, on_bundle).empty());
}

BOOST_AUTO_TEST_CASE(laws_reject_what_is_planted) {
  const Euclidean space(4);
  const auto points = random_points();
  const auto conormals = [](const ExprMatrix& C) { return C; };
  BOOST_TEST(failed(Planted(conormals, true, false), space, points).empty());
  const MatrixXd first = points.front().conormals.transpose();
  const auto tangent = [&](const ExprMatrix&) -> ExprMatrix {
    return constants(MatrixXd(QrDecomposition::in_order(first).Q().rightCols(2)));
  };
  BOOST_TEST(failed(Planted(tangent, false, false), space, points).front() == "J1");
  // Along one of the conormals that are given, whichever they are.
  const auto of_the_conormals = [](const ExprMatrix& C) -> ExprMatrix {
    ExprMatrix W = C;
    W.col(1) += constants(Vector4d(0.3, 0.3, 0.3, 0.3));
    return W;
  };
  BOOST_TEST(failed(Planted(of_the_conormals, false, false), space, points) ==
                 std::vector<std::string>{"J2"},
             boost::test_tools::per_element());
  const auto oblique = [](const ExprMatrix& C) -> ExprMatrix {
    return constants(Vector4d(1, 2, 3, 4)).asDiagonal() * C;
  };
  BOOST_TEST(failed(Planted(oblique, true, false), space, points) == std::vector<std::string>{"J3"},
             boost::test_tools::per_element());
  BOOST_TEST(
      failed(Planted(conormals, false, true), space, points) == std::vector<std::string>{"J3"},
      boost::test_tools::per_element());
}

// BᵀGB W = C: a displacement W μ is G-orthogonal to every w with Cᵀw = 0.
BOOST_AUTO_TEST_CASE(nearest_in_a_metric) {
  const Euclidean space(4);
  const auto points = random_points();
  const MatrixXd& C = points[0].conormals;
  const Vector4d units(1.0, 2.0, 1e-3, 10.0);
  const MatrixXd one = MatrixXd::Identity(4, 4);
  const QrDecomposition factors = QrDecomposition::in_order(C.transpose());
  const MatrixXd normal = factors.Q(2), tangent = factors.Q().rightCols(2);
  const MatrixXd W = OrthogonalProjector(units).directions(points[0].x, one, normal);
  const MatrixXd G = units.cwiseAbs2().cwiseInverse().asDiagonal();
  BOOST_TEST((tangent.transpose() * G * W).norm() < 1e-9 * (G * W).norm());
  const MatrixXd V = OrthogonalProjector(space, [&](const ExprVector&) -> ExprMatrix {
                       return constants(G);
                     }).directions(points[0].x, one, normal);
  BOOST_TEST((W - V * (V.transpose() * W)).norm() < 1e-12);
}

// W = g β for the momentum part β of a conormal: g given, or diag(u²) of units.
BOOST_AUTO_TEST_CASE(momenta_move_along_g_beta) {
  const Euclidean space(4);
  const Vector4d conormal = Vector4d(0.3, -0.5, 0.8, 0.2).normalized();
  const auto defect = [&](const MomentumProjector& projector, const Vector4d& expected) {
    const VectorXd W = projector.directions(VectorXd::Zero(4), MatrixXd::Identity(4, 4), conormal);
    return 1.0 - std::abs(W.dot(expected.normalized()));
  };
  const MomentumProjector in_units(space, {2, 3}, {}, Vector4d(1.0, 1.0, 2.0, 0.5));
  BOOST_TEST(defect(in_units, Vector4d(0.0, 0.0, 4.0 * 0.8, 0.25 * 0.2)) < 1e-14);
  const MomentumProjector in_metric(space, {2, 3}, [](const ExprVector&) -> ExprMatrix {
    return constants(MatrixXd(Eigen::Matrix2d{{3.0, 1.0}, {1.0, 2.0}}));
  });
  BOOST_TEST(defect(in_metric, Vector4d(0.0, 0.0, 3.0 * 0.8 + 0.2, 0.8 + 2.0 * 0.2)) < 1e-14);
}

// Where momenta are small numbers the momentum part of a conormal is small or large, and the
// directions are a complement all the same.
BOOST_AUTO_TEST_CASE(transversality_does_not_depend_on_units) {
  const Euclidean space(4);
  for (const double unit : {1e-12, 1.0, 1e12}) {
    // Σ c_q dq + c_p dp with c_p measured by 1/unit.
    const Vector4d conormal = Vector4d(0.3, -0.5, 0.8 / unit, 0.2 / unit).normalized();
    const Vector4d units(1.0, 1.0, unit, unit);
    const MomentumProjector projector(space, {2, 3}, {}, units);
    BOOST_CHECK_NO_THROW(
        projector.directions(VectorXd::Zero(4), MatrixXd::Identity(4, 4), conormal));
    BOOST_CHECK_THROW(projector.directions(VectorXd::Zero(4), MatrixXd::Identity(4, 4),
                                           Vector4d(0.6, 0.8, 0.0, 0.0)),
                      std::domain_error);
  }
}

BOOST_AUTO_TEST_CASE(errors) {
  const Euclidean space(4);
  BOOST_CHECK_THROW(OrthogonalProjector(Vector4d(1, 0, 1, 1)), std::invalid_argument);
  BOOST_CHECK_THROW(MomentumProjector(space, {4}), std::invalid_argument);
  BOOST_CHECK_THROW(MomentumProjector(nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(
      MomentumProjector(space, {2, 3},
                        [](const ExprVector&) -> ExprMatrix { return ExprMatrix::Identity(3, 3); }),
      std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
