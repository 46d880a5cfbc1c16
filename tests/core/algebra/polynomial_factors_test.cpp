#include "courant/core/algebra/polynomial_factors.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/core/algebra/normal_form.hpp"
#include "courant/core/expressions/derivative.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * what divides all coefficients but one is taken out
//  * a discriminant that is no square counts as one, as that of a circle
//  * of a difference of powers one factor alone is found
//  * a sum of squares is a product
//  * a factor that has no real zero is one
BOOST_AUTO_TEST_SUITE(polynomial_factors_test)

namespace {

struct Plane {
  Graph graph;
  ExprVector variables = graph.variables("x", 3);
  Expr x = variables[0], y = variables[1], z = variables[2];

  std::vector<Expr> factors(const Expr& a) const { return NormalForm(variables, {}).factors(a); }
  double at(const Expr& a, double of_x, double of_y, double of_z) const {
    ExprVector numbers(3);
    numbers << Expr(of_x), Expr(of_y), Expr(of_z);
    return substitute(a, variables, numbers).value();
  }
  // Whether the factors are as many, and their product is, up to one number, what was multiplied.
  bool are_factors(const Expr& product, std::size_t count) const {
    const Expr multiplied_out = NormalForm(variables, {})(product);
    const std::vector<Expr> found = factors(multiplied_out);
    BOOST_TEST(found.size() == count);
    double ratio = 0.0;
    for (const auto& [a, b, c] : {std::tuple(0.3, 1.7, -0.6), {-1.1, 0.4, 2.3}, {0.9, -0.8, 0.5}}) {
      double value = 1.0;
      for (const Expr& factor : found) value *= at(factor, a, b, c);
      const double here = at(product, a, b, c) / value;
      if (ratio == 0.0) ratio = here;
      if (!(std::fabs(here - ratio) <= 1e-9 * std::fabs(ratio))) return false;
    }
    return found.size() == count;
  }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(products_are_taken_apart, Plane) {
  BOOST_TEST(are_factors(x * y, 2));
  BOOST_TEST(are_factors(x * (y - 1.0) * (y + 1.0), 3));
  BOOST_TEST(are_factors((x - y) * (x * x + y * y - 1.0), 2));
  BOOST_TEST(are_factors((x - 2.0 * y) * (x + 3.0 * y) * (z - 0.7), 3));
  BOOST_TEST(are_factors((x * x + y * y - 1.0) * (x * x + y * y - 4.0), 2));
  BOOST_TEST(are_factors((x * x + y * y - 1.0) * ((x - 2.0) * (x - 2.0) + y * y - 1.0), 2));
  BOOST_TEST(are_factors((z + x * y) * (x + y + z * z - 1.0), 2));
  BOOST_TEST(are_factors((x - y) * (x * x + x * y + 2.0 * y * y), 2));  // degree 3 in both
  BOOST_TEST(are_factors((x - y * y) * (x * x + y + z * z) * 3.1, 2));
}

BOOST_FIXTURE_TEST_CASE(real_factors_are_found, Plane) {
  BOOST_TEST(are_factors(x * x - 2.0 * y * y, 2));
  BOOST_TEST(are_factors(pow(x, 3) - pow(y, 3), 2));
  BOOST_TEST(factors(NormalForm(variables, {})(pow(x, 4) - pow(y, 4))).size() == 2u);
  BOOST_TEST(are_factors(pow(x, 3) - 6.0 * x * x + 11.0 * x - 6.0, 3));
}

// A circle, sums of squares, a cone, the folium of Descartes, the lemniscate.
BOOST_FIXTURE_TEST_CASE(what_is_no_product_stays, Plane) {
  for (const Expr& a : {x * x + y * y - 1.0, x * x + x * y + y * y, x * x + x * y + y * y * z * z,
                        x * x + y * y - z * z, pow(x, 3) + pow(y, 3) - 3.0 * x * y,
                        square(x * x + y * y) - (x * x - y * y)}) {
    const std::vector<Expr> found = factors(NormalForm(variables, {})(a));
    BOOST_TEST_REQUIRE(found.size() == 1u);
    BOOST_TEST(are_factors(a, 1));
  }
}

// Powers count once; numbers, powers of e, divisors and what is positive are no factors.
BOOST_FIXTURE_TEST_CASE(what_cannot_vanish_is_left_out, Plane) {
  BOOST_TEST(factors(x * x * x).size() == 1u);
  BOOST_TEST(factors(-3.0 * exp(y) * (x - y) / (1.0 + z)).size() == 1u);
  BOOST_TEST((factors(exp(x + y)).empty()));
  BOOST_TEST(factors((x - y) * (x * x + y * y + 1.0)).size() == 1u);
  BOOST_TEST(factors((x - y) * (x * x + 3.0 * y * y * z * z)).size() == 1u);
  BOOST_TEST(factors((x - y) * (x * x - 3.0 * y * y * z * z)).size() == 3u);
  BOOST_TEST(factors((x - y) * sin(z)).size() == 2u);
  BOOST_TEST(factors(sqrt(x) * y).size() == 2u);
  BOOST_TEST(factors(Expr(0.0)).empty());
}

// Two factors with coefficients at random, multiplied out, in an order that is not theirs.
BOOST_FIXTURE_TEST_CASE(random_products_are_taken_apart, Plane) {
  std::mt19937 generator(3);
  const auto number = [&] { return static_cast<double>(generator() % 19) - 9.25; };
  for (int i = 0; i < 40; ++i) {
    const Expr linear = number() * x + number() * y + number(),
               quadric =
                   number() * x * x + number() * y * z + number() * z + number() * x * y + number();
    BOOST_TEST(are_factors(linear * quadric, 2));
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
