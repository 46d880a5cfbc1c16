#include "courant/integrators/step/vector_field.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <utility>

#include "courant/tests/integrators/certificate/ladder_catalogue.hpp"

using namespace courant;

namespace {

// The velocity at the ladder's point.
VectorXd velocity(const examples::SystemPointer& system, const InitialGuess& guess) {
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, guess);
  const VectorField field(system, ladder, Backend::interpreter);
  VectorField::Evaluation evaluate(field);
  VectorXd rate(ladder.point.x.size());
  evaluate(ladder.point.x, rate, ladder.point.t);
  return rate;
}

}  // namespace

// Mistakes that these cases have to notice:
//  * derivatives of high order are lost as round-off
//  * equations that were chosen elsewhere are believed where they say nothing
//  * all equations are believed whatever they leave
//  * a coefficient that rounding left of a zero is scaled up and tells an unknown
BOOST_AUTO_TEST_SUITE(vector_field)

// m q'' = -m g e_y - 2 λ q on q² = l², from (l, 0) with the velocity 0.1 √l downwards: λ = m v²/(2 l²).
BOOST_AUTO_TEST_CASE(units_are_no_matter) {
  for (const auto& [m, l] : {std::pair{1.0, 1.0}, {1e-9, 1e-6}, {1e6, 1e3}, {1e-9, 1e3}}) {
    const double mass = m, length = l, v = 0.1 * std::sqrt(l), g = 9.81;
    const auto pendulum = examples::flat(
        4, 1, 5, [=](const ExprVector& x, const ExprVector& w, const ExprVector& z, const Expr&) {
          return examples::equations({w[0] - x[2] / mass, w[1] - x[3] / mass,
                                      w[2] + 2 * z[0] * x[0], w[3] + mass * g + 2 * z[0] * x[1],
                                      square(x[0]) + square(x[1]) - length * length});
        });
    const VectorXd rate = velocity(pendulum, examples::at({l, 0, 0, -m * v}));
    BOOST_TEST(std::fabs(rate[0]) < 1e-14 * v);
    BOOST_TEST(rate[1] == -v, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(rate[2] == -m * v * v / l, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(rate[3] == -m * g, boost::test_tools::tolerance(1e-12));
  }
}

// (1 - x) (x' - 2 - x) = 0 and x (x' - 2 - x) = 0, of which the first is chosen at x = 1/4: at x = 1 it says nothing.
BOOST_AUTO_TEST_CASE(where_the_chosen_equations_are_dependent) {
  const auto repeated = examples::flat(
      1, 0, 2, [](const ExprVector& x, const ExprVector& w, const ExprVector&, const Expr&) {
        const Expr law = w[0] - 2.0 - x[0];
        return examples::equations({(1.0 - x[0]) * law, x[0] * law});
      });
  const ConstraintLadder ladder = ConstraintAlgorithm().run(repeated, examples::at({0.25}));
  BOOST_TEST_REQUIRE((ladder.verdict == Verdict::regular));
  const VectorField field(repeated, ladder, Backend::interpreter);
  VectorField::Evaluation evaluate(field);
  VectorXd rate(1);
  for (const double x : {0.25, 0.9, 1.0, 1.5, 0.0}) {
    evaluate(VectorXd::Constant(1, x), rate, 0.0);
    BOOST_TEST(std::fabs(rate[0] - 2.0 - x) < 1e-12, x);
    BOOST_TEST(std::fabs(evaluate.left_out()[0]) < 1e-12, x);
  }
}

// x₅ = sin t, x_{i-1} = x_i': equations are differentiated up to six times, and each of them is needed.
BOOST_AUTO_TEST_CASE(of_a_long_chain) {
  const auto chain = examples::flat(
      6, 0, 6, [](const ExprVector& x, const ExprVector& w, const ExprVector&, const Expr& t) {
        return examples::equations(
            {x[5] - sin(t), x[0] - w[1], x[1] - w[2], x[2] - w[3], x[3] - w[4], x[4] - w[5]});
      });
  const ConstraintLadder ladder = ConstraintAlgorithm().run(chain, {.x = VectorXd::Zero(6)});
  const VectorField field(chain, ladder, Backend::interpreter);
  VectorField::Evaluation evaluate(field);
  const double c = std::cos(1.0), s = std::sin(1.0);
  VectorXd rate(6);
  evaluate((VectorXd(6) << c, s, -c, -s, c, s).finished(), rate, 1.0);
  BOOST_TEST((rate - (VectorXd(6) << -s, c, s, -c, -s, c).finished()).lpNorm<Eigen::Infinity>() <
             1e-12);
  BOOST_TEST(evaluate.left_out().lpNorm<Eigen::Infinity>() < 1e-12);
}

// q' = i, q + (e^(log u) - u) = max(t - 1, 0), u = c: as the charge of a diode in series with its law, the second
// equation contains u with the coefficient e^(log u)/u - 1, of which doubles leave 10⁻¹⁶ for some c. Differentiated, it
// tells q' and not u', which at the corner in t = 1 would have to be 10¹⁶.
BOOST_AUTO_TEST_CASE(what_rounding_left_of_a_coefficient_tells_no_unknown) {
  int seen = 0;
  for (double c = 3.7; c < 13.0; c += 0.9) {
    if (std::exp(std::log(c)) / c - 1.0 == 0.0) continue;
    ++seen;
    for (const double size : {1e-15, 1.0, 1e9}) {  // of charges
      const auto circuit = examples::flat(
          1, 2, 3,
          [=](const ExprVector& x, const ExprVector& w, const ExprVector& z, const Expr& t) {
            const Expr ramp = select(t < Expr(1.0), Expr(0.0), t - 1.0);
            return examples::equations(
                {w[0] - z[0], x[0] / size + exp(log(z[1])) - z[1] - ramp, z[1] - c});
          });
      const ConstraintLadder ladder = certificate(
          circuit, {.x = VectorXd::Zero(1), .v = {}, .z = (VectorXd(2) << 0, c).finished()}, {},
          Decider::digits);
      BOOST_TEST_REQUIRE((ladder.verdict == Verdict::regular));
      const VectorField field(circuit, ladder, Backend::interpreter);
      VectorField::Evaluation evaluate(field);
      VectorXd rate(1);
      for (const double t : {0.0, 0.5, 1.0, 1.5, 2.0}) {
        const double charge = size * std::max(t - 1.0, 0.0), current = t < 1.0 ? 0.0 : size;
        evaluate(VectorXd::Constant(1, charge), rate, t);
        BOOST_TEST(std::fabs(rate[0] - current) <= 1e-12 * size,
                   c << ' ' << size << ' ' << t << ": " << rate[0]);
        BOOST_TEST(std::fabs(evaluate.z()[1] - c) <= 1e-12 * c);
      }
    }
  }
  BOOST_TEST(seen > 0);
}

BOOST_AUTO_TEST_CASE(of_a_point_there_is_one) {
  const auto point = examples::flat(
      0, 0, 0, [](const ExprVector&, const ExprVector&, const ExprVector&, const Expr&) {
        return ExprVector(0);
      });
  BOOST_TEST(point->auxiliary_guess(VectorXd(0), VectorXd(0)).size() == 0);
  ConstraintLadder ladder;
  ladder.verdict = Verdict::regular;
  ladder.point = {0.0, VectorXd(0), VectorXd(0), VectorXd(0)};
  const VectorField field(point, ladder, Backend::interpreter);
  VectorField::Evaluation evaluate(field);
  VectorXd rate(3);
  evaluate(ladder.point.x, rate, 0.0);
  BOOST_TEST(rate.size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
