#include "courant/core/solve/exponentials.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

// Mistakes that these cases have to notice:
//  * exponentials are followed to wherever their tangents point
BOOST_AUTO_TEST_SUITE(exponentials)

using namespace courant;

namespace {

struct Formulas {
  Graph graph;
  ExprVector y = graph.variables("y", 2), p = graph.variables("p", 1);
  Exponentials of(const ExprVector& equations) const {
    return Exponentials("equations", {{"y", y}, {"p", p}}, equations);
  }
};

ExprVector one(const Expr& a) { return ExprVector::Constant(1, a); }

}  // namespace

// Each argument once, also within a condition; not those of parameters alone.
BOOST_AUTO_TEST_CASE(arguments) {
  const Formulas f;
  const Expr a = f.y[0] / 0.025;
  ExprVector equations(2);
  equations << select(a < 40.0, exp(a), 3.0) + exp(a) * exp(f.p[0]), sinh(f.y[1] - f.p[0]) + a;
  const Exponentials exponentials = f.of(equations);
  BOOST_TEST_REQUIRE(exponentials.count() == 2);
  const VectorXd values =
      exponentials.arguments()({VectorXd{{0.5, 7.0}}, VectorXd::Constant(1, 3.0)});
  BOOST_TEST(values[0] == 20.0);
  BOOST_TEST(values[1] == 4.0);
  BOOST_TEST(f.of(one(f.y[0] * exp(f.p[0]))).count() == 0);
  BOOST_TEST(Exponentials().count() == 0);
}

// L = F and ∂L/∂y = ∂F/∂y at ā = a(y); elsewhere L is F with the tangents of its exponentials at ā.
BOOST_AUTO_TEST_CASE(tangents) {
  const Formulas f;
  const Exponentials exponentials =
      f.of(one(3.0 * f.y[1] + select(f.y[0] < 2.0, exp(f.y[0]), f.y[0]) - f.p[0]));
  const VectorXd y{{0.5, 2.0}}, p = VectorXd::Constant(1, 0.25);
  const auto at = [&](double held) {
    return exponentials.linearized()({y, p, VectorXd::Constant(1, held)})[0];
  };
  BOOST_TEST(std::abs(at(0.5) - (6.0 + std::exp(0.5) - 0.25)) < 1e-14);
  BOOST_TEST(std::abs(at(-1.0) - (6.0 + std::exp(-1.0) * (1.0 + 0.5 + 1.0) - 0.25)) < 1e-14);
  // The branch is that of ā.
  BOOST_TEST(std::abs(at(3.0) - (6.0 + 0.5 - 0.25)) < 1e-14);
  const MatrixXd J = exponentials.linearized().jacobian({y, p, VectorXd::Constant(1, -1.0)});
  BOOST_TEST(std::abs(J(0, 0) - std::exp(-1.0)) < 1e-15);
  BOOST_TEST(J(0, 1) == 3.0);
}

// Down and over short ways as asked, up by the logarithm; both ways for sinh.
BOOST_AUTO_TEST_CASE(ways_up_are_short) {
  const Formulas f;
  const Expr first = exp(f.y[0]);
  const Exponentials exponentials = f.of(one(first + sinh(f.y[1])));
  BOOST_REQUIRE(exponentials.count() == 2);
  const auto moved = [&](double from, double to) {
    VectorXd held = VectorXd::Constant(2, from);
    exponentials.move(held, VectorXd::Constant(2, to));
    return held;
  };
  BOOST_TEST(moved(30.0, 10.0)[0] == 10.0);
  BOOST_TEST(moved(30.0, 30.5)[0] == 30.5);
  BOOST_TEST(std::abs(moved(30.0, 1030.0)[0] - (30.0 + std::log(1001.0))) < 1e-13);
  BOOST_TEST(std::abs(moved(-400.0, 30.0)[0] - std::log(31.0)) < 1e-14);  // from where it is flat
  BOOST_TEST(moved(0.0, -1000.0)[0] == -1000.0);
  BOOST_TEST(std::abs(moved(0.0, -1000.0)[1] + std::log(1001.0)) < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
