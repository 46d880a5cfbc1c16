#include "courant/integrators/vector_field.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <utility>

#include "courant/tests/integrators/ladder/ladder_catalogue.hpp"

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
