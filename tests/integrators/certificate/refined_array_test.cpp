#include "courant/integrators/certificate/refined_array.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/certificate/level_certainty.hpp"
#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * bounds of numbers of 113 bits are those of doubles (core/numbers/quadruple.hpp)
//  * a zero is corrected the wrong way
//  * what contradicts itself with more digits is taken for a zero
//  * of the terms of one entry the last is taken (integrators/certificate/derivative_array.cpp)
//  * other ranks with more digits are taken for the same
//    (integrators/certificate/level_certainty.cpp)
BOOST_AUTO_TEST_SUITE(refined_array_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

// x x' = x y beside x² + y² = 1 twice, the second time with a term that is zero but for rounding.
SystemPointer circle_twice(double scale = 1.0) {
  return flat(2, 0, 3, [scale](V x, V v, V, T) {
    const Expr planted = scale * (square(sin(x[0] + 0.3)) + square(cos(x[0] + 0.3)) - 1) * x[1];
    const Expr circle = square(x[0]) + square(x[1]) - 1;
    return equations({x[0] * v[0] - x[0] * x[1], circle, 3 * circle + planted});
  });
}

ConsistentJet jet_of(const SystemPointer& system, std::initializer_list<double> x, Index level) {
  const ConsistentPoint consistent(system, at(x), {});
  const ConsistentJet jet = consistent.find(consistent.start().at_level(level));
  BOOST_TEST_REQUIRE(jet.zero().found);
  return jet;
}

}  // namespace

// 0.6² + 0.8² is 1 to 53 bits only, so that its zero needs a correction.
BOOST_AUTO_TEST_CASE(a_zero_is_found_to_113_bits) {
  const ConsistentJet jet = jet_of(circle_twice(1e6), {0.6, -0.8}, 2);
  BOOST_TEST_REQUIRE(jet.array().residual(jet.zero().y).lpNorm<Eigen::Infinity>() > 1e-20);
  const auto refined = RefinedArray::at(jet.array(), jet.zero());
  BOOST_TEST_REQUIRE(refined.has_value());
  BOOST_TEST(refined->residual(jet.zero().y).lpNorm<Eigen::Infinity>() < 1e-25);
  BOOST_TEST(refined->level_of(jet.zero().y) == 2);
}

// The values are those of the array where that is known well, and bounds are 2⁶⁰ times smaller beside the rounding of
// the result.
BOOST_AUTO_TEST_CASE(numbers_are_those_of_the_array_with_smaller_bounds) {
  const ConsistentJet jet = jet_of(circle_twice(), {0.6, -0.8}, 1);
  const auto refined = RefinedArray::at(jet.array(), jet.zero());
  BOOST_TEST_REQUIRE(refined.has_value());
  VectorXd y = jet.zero().y;
  y[0] += 0.25;
  y[1] += 0.125;
  const Linearization rough = jet.array().linearize(y), fine = refined->linearize(y);
  BOOST_TEST((rough.value - fine.value).lpNorm<Eigen::Infinity>() < 1e-14);
  BOOST_TEST(MatrixXd(rough.jacobian - fine.jacobian).lpNorm<Eigen::Infinity>() < 1e-13);
  for (Index i = 0; i < fine.value.size(); ++i)
    BOOST_TEST(fine.value_error[i] <=
               1e-17 * rough.value_error[i] + 1.2e-16 * std::fabs(fine.value[i]));
  // What doubles leave open of the planted term's slope by y is zero here.
  for (const Linearization* at : {&rough, &fine}) BOOST_TEST((at->error.coeffs() >= 0.0).all());
  BOOST_TEST(fine.error.coeff(2, 1) < 1e-3 * rough.error.coeff(2, 1) + 1e-15);
}

// x² + y² = 1 and 1 + 10⁻²⁰ contradict each other to 113 bits.
BOOST_AUTO_TEST_CASE(what_is_no_zero_is_not_refined) {
  const auto system = flat(2, 0, 2, [](V x, V, V, T) {
    return equations({square(x[0]) + square(x[1]) - 1, square(x[0]) + square(x[1]) - 1 - 1e-20});
  });
  const DerivativeArray array(system, 0.0, Eigen::Vector2d(0.6, -0.8));
  Zero zero(VectorXd::Zero(4));
  zero.nominal = VectorXd::Ones(4);
  zero.found = true;
  BOOST_TEST(!RefinedArray::at(array, zero).has_value());
  const DerivativeArray circle(circle_twice(), 0.0, Eigen::Vector2d(0.6, -0.8));
  zero.y[2] = -0.8;
  BOOST_TEST(RefinedArray::at(circle, zero).has_value());
  zero.found = false;
  BOOST_TEST(!RefinedArray::at(circle, zero).has_value());
}

// Ranks that 113 bits confirm are those of the levels, and no others.
BOOST_AUTO_TEST_CASE(ranks_are_confirmed_or_not) {
  const ConsistentJet jet = jet_of(circle_twice(), {0.6, -0.8}, 1);
  std::vector<LadderLevel> levels = levels_at(jet);
  BOOST_TEST(refined_with(jet, levels).has_value());
  --levels[1].all.rank;
  BOOST_TEST(!refined_with(jet, levels).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
