#include "courant/integrators/maps/theta.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/expressions/derivative.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"

BOOST_AUTO_TEST_SUITE(theta)

using namespace courant;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Both sides of Proposition 6.2 on TR² at one point, for a one-form α and R_d = (R¹, R²).
struct Forms {
  MatrixXd A;                    // ∂α_i/∂q^j
  MatrixXd second;               // ∂²α_i/∂q^j∂q^k q̇^k
  MatrixXd A1, A2;               // A at R¹, R²
  MatrixXd q1, q2, v1, v2;       // ∂R/∂q, ∂R/∂q̇
  MatrixXd pulled_back, lifted;  // R_d*(-dα + dα) and d_T dα, on (q, q̇)
};

template <class OneForm, class Map>
Forms forms(const OneForm& alpha, const Map& R_d, const Vector2d& q, const Vector2d& v) {
  Graph graph;
  const ExprVector y = graph.variables("y", 4);
  VectorXd point(4);
  point << q, v;
  const auto at = [](const ExprMatrix& E, const ExprVector& variables, const VectorXd& where) {
    const ExprVector entries = E.reshaped();
    return MatrixXd(
        values(substitute(entries, variables, constants(where))).reshaped(E.rows(), E.cols()));
  };
  const ExprVector position = graph.variables("q", 2);
  const ExprMatrix A = jacobian(ExprVector(alpha(position)), position).dense();
  const ExprMatrix change =
      tangent(ExprVector(A.reshaped()), position, ExprVector(constants(v))).reshaped(2, 2);
  const auto [first, second] = R_d(ExprVector(y.head(2)), ExprVector(y.tail(2)));
  const MatrixXd J1 = at(jacobian(first, y).dense(), y, point);
  const MatrixXd J2 = at(jacobian(second, y).dense(), y, point);
  const VectorXd r1 = at(first, y, point), r2 = at(second, y, point);
  Forms f;
  f.A = at(A, position, q);
  f.second = at(change, position, q);
  f.A1 = at(A, position, r1);
  f.A2 = at(A, position, r2);
  f.q1 = J1.leftCols(2), f.v1 = J1.rightCols(2);
  f.q2 = J2.leftCols(2), f.v2 = J2.rightCols(2);
  // dα(a, b) = aᵀ (Aᵀ - A) b; d_T of the form Ω is (∂_v Ω, Ω; Ω, 0).
  f.pulled_back = J2.transpose() * (f.A2.transpose() - f.A2) * J2 -
                  J1.transpose() * (f.A1.transpose() - f.A1) * J1;
  f.lifted = MatrixXd::Zero(4, 4);
  f.lifted.topLeftCorner(2, 2) = f.second.transpose() - f.second;
  f.lifted.topRightCorner(2, 2) = f.lifted.bottomLeftCorner(2, 2) = f.A.transpose() - f.A;
  return f;
}

double skew_part(const MatrixXd& X) { return (X - X.transpose()).norm(); }
double defect_16(const Forms& f, double sign) {
  return skew_part(sign * f.second - f.q1.transpose() * f.A1 * f.q1 +
                   f.q2.transpose() * f.A2 * f.q2);
}
double defect_17(const Forms& f, double sign) {
  const MatrixXd X = f.q1.transpose() * f.A1 * f.v1 - f.q2.transpose() * f.A2 * f.v2;
  const MatrixXd Y = f.v1.transpose() * f.A1 * f.q1 - f.v2.transpose() * f.A2 * f.q2;
  return (sign * (f.A - f.A.transpose()) - (X - Y.transpose())).norm();
}
double defect_18(const Forms& f) {
  return skew_part(f.v1.transpose() * f.A1 * f.v1 - f.v2.transpose() * f.A2 * f.v2);
}

}  // namespace

// (16), (17), (18) are the dq ∧ dq, dq ∧ dq̇ and dq̇ ∧ dq̇ parts of R_d*(-dα + dα) = d_T dα, with
// one ∂R/∂q̇ in (17), two in (18), and the signs of (19) on the left of (16) and (17).
BOOST_AUTO_TEST_CASE(proposition_6_2) {
  const Vector2d q(0.4, -0.7), v(0.6, 0.9);
  const auto linear = [](const ExprVector& x) {
    return (ExprVector(2) << 0.3 * x[0] - 0.2 * x[1], 0.9 * x[0]).finished();
  };
  // e^x dy, and the midpoint rule in the coordinates (e^x, y), where it is linear.
  const auto curved = [](const ExprVector& x) {
    return (ExprVector(2) << Expr(0.0), exp(x[0])).finished();
  };
  const auto in_coordinates = [](const ExprVector& x, const ExprVector& w) {
    const Expr half = 0.5 * w[0];
    return DiscretizationMap::PointPair<Expr>{
        (ExprVector(2) << x[0] + log(1.0 - half), x[1] - 0.5 * w[1]).finished(),
        (ExprVector(2) << x[0] + log(1.0 + half), x[1] + 0.5 * w[1]).finished()};
  };
  const auto on_the_plane = [](double value) {
    return [map = Theta(std::make_shared<Euclidean>(2), value)](
               const ExprVector& x, const ExprVector& w) { return map.forward(x, w); };
  };
  for (const Forms& f :
       {forms(linear, on_the_plane(0.5), q, v), forms(curved, in_coordinates, q, v)}) {
    BOOST_TEST((f.pulled_back - f.lifted).norm() < 1e-14);
    BOOST_TEST(defect_16(f, -1.0) + defect_17(f, -1.0) + defect_18(f) < 1e-14);
    BOOST_TEST(defect_17(f, 1.0) > 1.0);  // the sign as printed
  }
  BOOST_TEST(defect_16(forms(curved, in_coordinates, q, v), 1.0) > 1.0);
  // The left side of (17) against factors ∂R/∂q alone, as printed.
  const Forms f = forms(linear, on_the_plane(0.5), q, v);
  const MatrixXd X = f.q1.transpose() * f.A1 * f.q1 - f.q2.transpose() * f.A2 * f.q2;
  for (const double sign : {-1.0, 1.0})
    BOOST_TEST((sign * (f.A - f.A.transpose()) - (X - X.transpose())).norm() > 1.0);
  // Off the middle (18) fails, and so does the proposition's conclusion; with α that is not linear
  // the midpoint rule fails too.
  const Forms off = forms(linear, on_the_plane(0.3), q, v);
  BOOST_TEST(defect_18(off) > 0.1);
  BOOST_TEST(skew_part(off.q1.transpose() * off.A1 * off.q1 -
                       off.q2.transpose() * off.A2 * off.q2) < 1e-15);  // (18) as printed holds
  BOOST_TEST((off.pulled_back - off.lifted).norm() > 0.1);
  const Forms bent = forms(curved, on_the_plane(0.5), q, v);
  BOOST_TEST(defect_16(bent, -1.0) + defect_17(bent, -1.0) + defect_18(bent) > 0.1);
  BOOST_TEST((bent.pulled_back - bent.lifted).norm() > 0.1);
}

// (16) and (18) are needed for the parts skew in (i, j) only: they are coefficients of dq^i ∧ dq^j
// and dq̇^i ∧ dq̇^j. An exact part of α adds something symmetric to them. With α + dφ,
// φ = x³/3 + x²y, the midpoint rule is as symplectic as with α, and (18) as printed fails by
// ¼ ∂³φ q̇ twice over.
BOOST_AUTO_TEST_CASE(proposition_6_2_needs_skew_parts_only) {
  const Vector2d q(0.4, -0.7), v(0.6, 0.9);
  const auto alpha = [](const ExprVector& x) {
    const Expr dx = square(x[0]) + 2.0 * x[0] * x[1], dy = square(x[0]);
    return (ExprVector(2) << 0.3 * x[0] - 0.2 * x[1] + dx, 0.9 * x[0] + dy).finished();
  };
  const Theta midpoint(std::make_shared<Euclidean>(2));
  const Forms f = forms(
      alpha, [&](const ExprVector& x, const ExprVector& w) { return midpoint.forward(x, w); }, q,
      v);
  BOOST_TEST((f.pulled_back - f.lifted).norm() < 1e-14);
  BOOST_TEST(defect_16(f, -1.0) + defect_17(f, -1.0) + defect_18(f) < 1e-14);
  const MatrixXd right_of_18 = f.v1.transpose() * f.A1 * f.v1 - f.v2.transpose() * f.A2 * f.v2;
  Eigen::Matrix2d third;  // ∂³φ/∂q^i∂q^j∂q^k q̇^k
  third << 2.0 * v[0] + 2.0 * v[1], 2.0 * v[0], 2.0 * v[0], 0.0;
  BOOST_TEST((right_of_18 + 0.25 * third).norm() < 1e-14);
}

// Example 4.8.
BOOST_AUTO_TEST_CASE(on_vector_spaces) {
  const Theta map(std::make_shared<Euclidean>(2), 0.25);
  const auto [x0, x1] = map.forward(Vector2d(1.0, 2.0), Vector2d(4.0, -8.0));
  BOOST_TEST((x0 - Vector2d(0.0, 4.0)).norm() == 0.0);
  BOOST_TEST((x1 - Vector2d(4.0, -4.0)).norm() == 0.0);
  const auto [x, v] = map.inverse(x0, x1);
  BOOST_TEST((x - Vector2d(1.0, 2.0)).norm() == 0.0);
  BOOST_TEST((v - Vector2d(4.0, -8.0)).norm() == 0.0);
}

// Example 4.9: both ends are retracted from x, and the whole geodesic has length ‖v‖.
BOOST_AUTO_TEST_CASE(along_geodesics) {
  const auto sphere = std::make_shared<Sphere>(2);
  const Theta map(sphere, 0.3);
  const Vector3d x(0.0, 0.0, 1.0);
  const Vector3d v(0.6, 0.8, 0.0);
  const auto [x0, x1] = map.forward(x, 2.0 * v);
  BOOST_TEST((x0 - (std::cos(0.6) * x - std::sin(0.6) * v)).norm() < 1e-15);
  BOOST_TEST((x1 - (std::cos(1.4) * x + std::sin(1.4) * v)).norm() < 1e-15);
  BOOST_TEST(sphere->inverse_retract(x0, x1).norm() == 2.0, boost::test_tools::tolerance(1e-14));
}

// Example 4.10 on SO(3): R_d(g, gω̂) = (g exp(-θω̂), g exp((1-θ)ω̂)), with the formula of Rodrigues.
BOOST_AUTO_TEST_CASE(along_one_parameter_subgroups) {
  using Eigen::Matrix3d;
  const Vector3d axis = Vector3d(2.0, -1.0, 2.0) / 3.0;
  const auto turned = [&](double angle) -> Matrix3d {
    Matrix3d K;
    K << 0.0, -axis[2], axis[1], axis[2], 0.0, -axis[0], -axis[1], axis[0], 0.0;
    return Matrix3d::Identity() + std::sin(angle) * K + (1.0 - std::cos(angle)) * K * K;
  };
  const auto entries = [](const Matrix3d& g) {
    const Matrix3d rows = g.transpose();
    return VectorXd(rows.reshaped());
  };
  Matrix3d g;
  g << 0.0, -1.0, 0.0, 0.6, 0.0, -0.8, 0.8, 0.0, 0.6;
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  for (const double theta : {0.0, 0.3, 0.5, 1.0}) {
    const Theta map(rotations, theta);
    const auto [g0, g1] = map.forward(entries(g), 1.2 * axis);
    BOOST_TEST((g0 - entries(g * turned(-1.2 * theta))).norm() < 1e-15);
    BOOST_TEST((g1 - entries(g * turned(1.2 * (1.0 - theta)))).norm() < 1e-15);
    const auto [middle, omega] = map.inverse(g0, g1);
    BOOST_TEST((middle - entries(g)).norm() < 1e-14);
    BOOST_TEST((omega - 1.2 * axis).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(claims) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto projective = std::make_shared<Sphere>(2, Sphere::projective());
  BOOST_TEST(Theta(sphere).name() == "Theta(0.5)");
  BOOST_TEST(Theta(sphere).order() == 2);
  BOOST_TEST(Theta(sphere, 0.25).order() == 1);
  BOOST_TEST(Theta(sphere).is_symmetric());
  BOOST_TEST(!Theta(sphere, 1.0).is_symmetric());
  BOOST_TEST(Theta(sphere, 0.3).has_inverse());
  BOOST_TEST(Theta(projective, 0.0).has_inverse());
  BOOST_TEST(Theta(projective, 1.0).has_inverse());
  BOOST_TEST(!Theta(projective, 0.5).has_inverse());
}

BOOST_AUTO_TEST_CASE(errors) {
  const auto space = std::make_shared<Euclidean>(2);
  BOOST_CHECK_THROW(Theta(space, -0.1), std::invalid_argument);
  BOOST_CHECK_THROW(Theta(space, std::nan("")), std::invalid_argument);
  BOOST_CHECK_THROW(Theta(nullptr), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
