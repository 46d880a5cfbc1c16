#include "courant/integrators/methods/explicit_runge_kutta.hpp"

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/tests/integrators/certificate/ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * a coefficient of Fehlberg's method is another one
BOOST_AUTO_TEST_SUITE(explicit_runge_kutta_test)

using namespace courant;

namespace {

namespace odeint = boost::numeric::odeint;
using Pair2 = std::array<double, 2>;

constexpr double kStart = 0.3, kStep = 0.4;
constexpr int kSteps = 25;

// A driven pendulum: q' = w, w' = cos t - sin q.
std::shared_ptr<const VectorField> pendulum() {
  const auto system = examples::flat(
      2, 0, 2, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr& t) {
        return examples::equations({v[0] - x[1], v[1] - cos(t) + sin(x[0])});
      });
  const ConstraintLadder ladder =
      ConstraintAlgorithm().run(system, {.t = kStart, .x = VectorXd{{1.0, 0.5}}});
  return std::make_shared<VectorField>(system, ladder, Backend::interpreter);
}

VectorXd by_courant(ExplicitRungeKutta::Kind kind) {
  const State start{.t = kStart, .x = VectorXd{{1.0, 0.5}}};
  return ExplicitRungeKutta(pendulum(), kind).advance(start, kStep, kSteps).x;
}

template <class Method>
VectorXd by_odeint() {
  Pair2 x = {1.0, 0.5};
  Method method;
  const auto rate = [](const Pair2& at, Pair2& rate, double t) {
    rate = {at[1], std::cos(t) - std::sin(at[0])};
  };
  for (int k = 0; k < kSteps; ++k) method.do_step(rate, x, kStart + k * kStep, kStep);
  return VectorXd{{x[0], x[1]}};
}

}  // namespace

// Coefficients typed twice, here and by the authors of Boost: in long steps each of them is seen.
BOOST_AUTO_TEST_CASE(steps_are_those_of_odeint) {
  using Kind = ExplicitRungeKutta::Kind;
  const auto differ = [](const VectorXd& a, const VectorXd& b) {
    return (a - b).lpNorm<Eigen::Infinity>();
  };
  BOOST_TEST(differ(by_courant(Kind::classical), by_odeint<odeint::runge_kutta4<Pair2>>()) < 1e-13);
  BOOST_TEST(differ(by_courant(Kind::dormand_prince),
                    by_odeint<odeint::runge_kutta_dopri5<Pair2>>()) < 1e-13);
  BOOST_TEST(differ(by_courant(Kind::fehlberg),
                    by_odeint<odeint::runge_kutta_fehlberg78<Pair2>>()) < 1e-13);
  // The methods themselves are told apart.
  BOOST_TEST(differ(by_courant(Kind::classical), by_courant(Kind::dormand_prince)) > 1e-6);
  BOOST_TEST(differ(by_courant(Kind::fehlberg), by_courant(Kind::dormand_prince)) > 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
