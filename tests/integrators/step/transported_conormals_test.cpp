#include "courant/integrators/step/transported_conormals.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/linear/qr_decomposition.hpp"

// Mistakes that these cases have to notice:
//  * all conormals are the first one
//  * what equations leave open is taken for a contradiction
//  * combinations of equations stay those of the last point
//  * conormals begin near one reference alone
BOOST_AUTO_TEST_SUITE(transported_conormals)

using namespace courant;

namespace {

// A pendulum of length 1 in the plane, ξ = (q, v): q' = v, v' = λ q - (0, 1), and the length, twice
// differentiated. M_f: |q| = 1, q·v = 0, with the conormals (q, 0) and (v, q).
struct Pendulum {
  // `repeats`: with the length once more, and its sum with another equation.
  explicit Pendulum(bool repeats = false) {
    Graph graph;
    const ExprVector jets = graph.variables("y", 13);  // ξ, ξ', ξ'', λ
    const ExprVector x0 = graph.variables("x0", 4), t = graph.variables("t", 1);
    const ExprVector x = x0 + jets.head(4), rate = jets.segment(4, 4), second = jets.segment(8, 4);
    const auto dot = [](const ExprVector& a, const ExprVector& b) { return Expr(a.dot(b)); };
    const ExprVector q = x.head(2), v = x.tail(2), dq = rate.head(2), ddq = second.head(2);
    ExprVector F(9);
    F << dq - v, rate.tail(2) - jets[12] * q, dot(q, q) - 1.0, dot(q, dq),
        dot(dq, dq) + dot(q, ddq), ddq - rate.tail(2);
    F[3] += 1.0;
    if (repeats) {
      F.conservativeResize(11);
      F[9] = 3.0 * F[4];
      F[10] = F[4] + 2.0 * F[6];
    }
    functions = {TransportedConormals::trace(graph, F, jets, 4, 2,
                                             {{"x0", x0}, {"basis", ExprVector(0)}, {"t", t}}),
                 Backend::interpreter};
  }

  // At an angle, with its rate. Sets x and the jets.
  void place(double angle, double rate) {
    const Eigen::Vector2d q(std::sin(angle), -std::cos(angle)),
        along(std::cos(angle), std::sin(angle));
    const double lambda = q[1] - rate * rate;
    const Eigen::Vector2d acceleration = lambda * q - Eigen::Vector2d(0.0, 1.0);
    x << q, rate * along;
    y << Eigen::Vector4d::Zero(), rate * along, acceleration, acceleration, Eigen::Vector2d::Zero(),
        lambda;
    exact.setZero();
    exact.col(0).head(2) = q;
    exact.col(1) << rate * along, q;
  }

  void move(TransportedConormals& conormals) const {
    conormals.move_to({.jets = y.data(), .origin = x.data(), .basis = nullptr, .t = &t});
  }

  // How far C is from an orthonormal basis of the span.
  double defect(const MatrixXd& C) const {
    const MatrixXd Q = orthonormalized(exact);
    return (C.transpose() * C - MatrixXd::Identity(2, 2)).norm() +
           (C - Q * (Q.transpose() * C)).norm();
  }

  TransportedConormals::Functions functions;
  VectorXd x = VectorXd(4), y = VectorXd(13);
  MatrixXd exact = MatrixXd(4, 2);
  double t = 0.0;
};

void follow_a_curve_of(Pendulum pendulum) {
  TransportedConormals conormals(pendulum.functions, 4, 2);
  MatrixXd before;
  for (int k = 0; k < 500; ++k) {
    const double angle = 1.2 * std::cos(0.02 * k);
    pendulum.place(angle, -0.9 * std::sin(0.02 * k) + 0.1 * angle);
    pendulum.move(conormals);
    const MatrixXd C = conormals.matrix();
    BOOST_TEST(pendulum.defect(C) < 1e-12);
    if (k > 0) BOOST_TEST((C - before).norm() < 0.06);
    pendulum.move(conormals);  // the same again while nothing is kept
    BOOST_TEST((conormals.matrix() - C).norm() < 1e-12);
    conormals.keep();
    before = C;
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(follow_a_curve) { follow_a_curve_of(Pendulum()); }

// Equations that say nothing new leave open which combinations give the conormals, not the conormals.
BOOST_AUTO_TEST_CASE(follow_a_curve_with_redundant_equations) { follow_a_curve_of(Pendulum(true)); }

// The first ones are nearest to a reference, at whatever point that is; where it is at right angles, to another one.
BOOST_AUTO_TEST_CASE(begin_near_a_reference) {
  Pendulum pendulum;
  pendulum.place(0.3, 0.0);
  const auto references = TransportedConormals::references(orthonormalized(pendulum.exact));
  BOOST_TEST_REQUIRE(references.size() >= 2u);
  const auto is_nearest = [&](const MatrixXd& C, const MatrixXd& to) {
    const MatrixXd seen = C.transpose() * to;
    return std::abs(seen(0, 1) - seen(1, 0)) < 1e-12;
  };
  for (const double angle : {0.3, 0.4, 1.2, 0.3 + 0.5 * M_PI}) {
    pendulum.place(angle, 0.0);
    TransportedConormals conormals(pendulum.functions, 4, 2, references);
    pendulum.move(conormals);
    BOOST_TEST(pendulum.defect(conormals.matrix()) < 1e-12, angle);
    BOOST_TEST(is_nearest(conormals.matrix(), references[angle > 1.5 ? 1 : 0]), angle);
  }
}

BOOST_AUTO_TEST_CASE(jump) {
  Pendulum pendulum;
  TransportedConormals conormals(pendulum.functions, 4, 2);
  for (const double angle : {0.3, 0.31, 1.9, -1.0, -0.99}) {
    pendulum.place(angle, 0.5 + angle);
    pendulum.move(conormals);
    BOOST_TEST(pendulum.defect(conormals.matrix()) < 1e-12);
    conormals.keep();
  }
  // The wrong place has others.
  pendulum.place(0.5, 0.5);
  BOOST_TEST(pendulum.defect(conormals.matrix()) > 0.1);
}

BOOST_AUTO_TEST_SUITE_END()
