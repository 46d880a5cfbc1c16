#include "courant/integrators/certificate/obstruction.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/certificate/derivative_array.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"
#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * a direction that is no tangent makes a point look singular
//  * a vanishing gradient is certain though errors turn what the Jacobian does not see
//  * where round-off hides everything nothing is taken to be there
//  * what the error of a zero may make of numbers is doubted, though they are small
//  * rows that vanish at the point are measured in units that they do not have
//  * directions beside the tangent space are evidence that nothing is hidden
//  * squares that bounds cover are not seen
//  * squares that errors of the unseen combination may explain say that nothing is hidden
BOOST_AUTO_TEST_SUITE(obstruction_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

// What is seen of F = 0 along d at x, known to this error, where J(x) has this rank.
Obstruction::Answer answer(const std::function<ExprVector(V x)>& F, Index n, const VectorXd& x,
                           Index rank, const VectorXd& d, double error = 0.0) {
  const Index m = F(ExprVector::Constant(n, Expr(0.0))).size();
  const auto system = flat(n, 0, m, [&](V q, V, V, T) { return F(q); });
  const DerivativeArray array(system, 0.0, x);
  VectorXd y = VectorXd::Zero(2 * n), direction = y;
  direction.head(n) = d;
  const SparseMatrixXd magnitude = GenericScaling(array, y, direction.cwiseAbs()).magnitude;
  return Obstruction(array, y, VectorXd::Constant(2 * n, error), rank, magnitude)
      .is_seen_along(direction);
}

bool is_seen(const std::function<ExprVector(V x)>& F, Index n, const VectorXd& x, Index rank,
             const VectorXd& d) {
  const Obstruction::Answer seen = answer(F, n, x, rank, d);
  BOOST_TEST((seen != Obstruction::Answer::unknown));
  return seen == Obstruction::Answer::yes;
}

VectorXd vector(std::initializer_list<double> values) { return at(values).x; }

}  // namespace

// z² = 0 at 0 has no linear part; the cone x² + y² = z² neither; nor the node of a lemniscate.
BOOST_AUTO_TEST_CASE(singular_zeros) {
  BOOST_TEST(is_seen([](V x) { return equations({square(x[0]) + 0 * x[1]}); }, 2, vector({0, 0}), 0,
                     vector({0.7, 0.3})));
  BOOST_TEST(is_seen([](V x) { return equations({square(x[0]) + square(x[1]) - square(x[2])}); }, 3,
                     vector({0, 0, 0}), 0, vector({0.7, 0.3, 0.2})));
  // In units of 10⁻⁸, and beside a regular equation.
  BOOST_TEST(is_seen(
      [](V x) {
        return equations({1e-8 * square(x[0]), x[1] + square(x[0])});
      },
      3, vector({0, 0, 0}), 1, vector({0.7, 0, 0.3})));
}

// A row that vanishes at the point has no unit there, and one of 10⁻²⁴ is no round-off of the others:
// Cawley's z² = 0 with z in units of 10⁻¹², beside an equation that is curved in the same direction.
BOOST_AUTO_TEST_CASE(rows_that_vanish_are_measured_by_what_they_are_nearby) {
  BOOST_TEST(is_seen(
      [](V x) {
        return equations({square(1e-12 * x[0]), x[1] + square(x[2])});
      },
      3, vector({0, 0, 0}), 1, vector({0.7, 0, 0.3})));
}

// Redundant equations have dependent linear parts and vanish together.
BOOST_AUTO_TEST_CASE(regular_zeros) {
  const auto twice = [](V x) {
    const Expr circle = square(x[0]) + square(x[1]) - 1;
    return equations({circle, circle * (2 + x[0]), x[2] - exp(x[2] * circle) * x[2] + circle});
  };
  BOOST_TEST(!is_seen(twice, 3, vector({0.6, -0.8, 0.3}), 1, vector({0.8, 0.6, 0.4})));
  BOOST_TEST(!is_seen(twice, 3, vector({1, 0, 0}), 1, vector({0, 0.6, 0.4})));
}

// Off the tangent space there are no zeros to speak of, and whatever J does not see is quadratic: the
// circle and its double from (1, 0), along (1, 0). That is no evidence that nothing is hidden, either.
BOOST_AUTO_TEST_CASE(a_direction_that_is_no_tangent_says_nothing) {
  const auto twice = [](V x) {
    const Expr circle = square(x[0]) + square(x[1]) - 1;
    return equations({circle, 2 * circle + square(circle)});
  };
  BOOST_TEST(
      (answer(twice, 2, vector({1, 0}), 1, vector({0.4, 0.5})) == Obstruction::Answer::beside));
}

// z² beside a sum of 10⁹ that cancels; z² next to an equation whose linear part is known to a hundredth. The numbers
// are squares all the same.
BOOST_AUTO_TEST_CASE(squares_below_their_bounds_are_likely) {
  using Answer = Obstruction::Answer;
  const auto covered = [](V x) { return equations({square(x[0]) + ((x[1] + 1e9) - x[1] - 1e9)}); };
  BOOST_TEST((answer(covered, 2, vector({0, 0.2}), 0, vector({0.7, 0.3})) == Answer::likely));
  const auto beside = [](V x) { return equations({square(x[0]), x[1] + square(x[0])}); };
  BOOST_TEST((answer(beside, 2, vector({0, 0}), 1, vector({0.7, 0})) == Answer::yes));
  BOOST_TEST((answer(beside, 2, vector({0, 0}), 1, vector({0.7, 0}), 0.01) == Answer::likely));
}

// A sum of 10¹² that cancels hides x³, which could be as large as x².
BOOST_AUTO_TEST_CASE(what_errors_hide_is_left_open) {
  const auto hidden = [](V x) {
    return equations({x[0] * square(x[0]) + ((x[1] + 1e12) - x[1] - 1e12)});
  };
  BOOST_TEST(
      (answer(hidden, 2, vector({0, 0.2}), 0, vector({0.7, 0.3})) == Obstruction::Answer::unknown));
}

// Where a zero is known to 10⁻⁶ only, bounds of errors are larger than ε². The numbers are far below it.
BOOST_AUTO_TEST_CASE(the_error_of_a_zero_hides_nothing_that_numbers_show) {
  const auto twice = [](V x) {
    const Expr circle = square(x[0]) + square(x[1]) - 1;
    return equations({circle, circle * (2 + x[0])});
  };
  BOOST_TEST((answer(twice, 2, vector({0.6, -0.8}), 1, vector({0.4, 0.3}), 1e-6) ==
              Obstruction::Answer::no));
}

// As many equations as their rank: nothing is left unseen.
BOOST_AUTO_TEST_CASE(full_rank) {
  BOOST_TEST(!is_seen([](V x) { return equations({square(x[0]) + square(x[1]) - 1}); }, 2,
                      vector({1, 0}), 1, vector({0, 1})));
}

BOOST_AUTO_TEST_SUITE_END()
