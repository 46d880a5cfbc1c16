#include "courant/integrators/certificate/dimensionless_arguments.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../example_systems.hpp"
#include "courant/manifolds/euclidean.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * slopes of nothing are the least of all
BOOST_AUTO_TEST_SUITE(dimensionless_arguments_test)

namespace {

std::shared_ptr<const ImplicitSystem> system_of(examples::FormulaSystem::Formula formula) {
  return std::make_shared<examples::FormulaSystem>(std::make_shared<Euclidean>(2), 0, 1,
                                                   std::move(formula));
}

}  // namespace

// cos (3 x₀ x₁) twice and exp (-5 t): at x = (2, 0) the slope by x₀ is 0.
BOOST_AUTO_TEST_CASE(slopes_of_what_sines_and_exponentials_are_of) {
  const auto system =
      system_of([](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr& t) {
        const Expr angle = 3.0 * x[0] * x[1];
        return ExprVector(ExprVector::Constant(
            1, v[0] - cos(angle) + sqrt(1.0 + square(x[0])) * sin(angle) * exp(-5.0 * t)));
      });
  const DimensionlessArguments arguments(*system);
  const auto slopes = arguments.slopes(VectorXd{{2.0, 0.0, 7.0, 7.0, 0.5}});
  BOOST_TEST_REQUIRE(slopes.size() == 2u);
  for (const auto& [argument, unknown, size] : slopes) {
    BOOST_TEST(argument == (unknown == 1 ? 0 : 1));
    BOOST_TEST((unknown == 1 || unknown == 4));
    BOOST_TEST(size == (unknown == 1 ? 6.0 : 5.0));
  }
}

BOOST_AUTO_TEST_CASE(polynomials_have_no_such_arguments) {
  const auto system =
      system_of([](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector(ExprVector::Constant(1, v[0] - x[0] * x[1]));
      });
  BOOST_TEST(DimensionlessArguments(*system).slopes(VectorXd::Ones(5)).empty());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
