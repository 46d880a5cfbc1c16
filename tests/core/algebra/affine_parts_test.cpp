#include "courant/core/algebra/affine_parts.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * what is not affine is taken for affine: a product or a quotient of two that vary, a function, a power
//  * a part is left as it was, or written by another unknown's slope
//  * what does not vary changes its bits
BOOST_AUTO_TEST_SUITE(affine_parts)

namespace {

const Graph graph;
const ExprVector u = graph.variables("u", 2), p = graph.variables("p", 2);

ExprVector one(const Expr& a) { return ExprVector::Constant(1, a); }

double value(const Expr& a, const VectorXd& of_u, const VectorXd& of_p) {
  return Function("f", {{"u", u}, {"p", p}}, one(a))({of_u, of_p})[0];
}

}  // namespace

BOOST_AUTO_TEST_CASE(parts_have_one_product_for_each_unknown) {
  const Expr part = p[0] + 3.0 * (p[1] - 0.5 * (p[0] * u[0] + 2.0 * (u[0] - u[1])));
  const Expr written = with_affine_parts(one(part * part), u)[0];
  BOOST_TEST(to_string(written) == "(p[0] + 3*p[1] - 3*0.5*(p[0] + 2)*u[0] + 3*u[1])^2");
  // In the end of a sum with what is not affine, too.
  BOOST_TEST(to_string(with_affine_parts(one(sin(u[0]) + (u[1] + p[0]) * p[1]), u)[0]) ==
             "sin(u[0]) + p[0]*p[1] + p[1]*u[1]");
}

BOOST_AUTO_TEST_CASE(values_are_the_same) {
  const Expr a = p[0] - (u[0] - p[1]) / p[0], b = 2.0 * u[1] - u[0] * p[1];
  const VectorXd of_u = Eigen::Vector2d(0.7, -0.3), of_p = Eigen::Vector2d(1.3, 0.4);
  for (const Expr& f : {a, a * b, a / b, exp(b), pow(a, 3), u[0] / u[1], p[0] / u[0], u[0] * u[1],
                        max(a, b), sqrt(a * a + b * b), a - cos(b) * p[1], Expr(p[0] * p[1])}) {
    const Expr written = with_affine_parts(one(f), u)[0];
    BOOST_TEST(std::abs(value(written, of_u, of_p) - value(f, of_u, of_p)) < 1e-14,
               to_string(f) << " is written " << to_string(written));
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_vary_stays) {
  const Expr f = (p[0] + p[1]) - p[0] * 3.0;
  BOOST_TEST(with_affine_parts(one(f), u)[0] == f);
  BOOST_TEST(with_affine_parts(one(u[0]), u)[0] == u[0]);
  BOOST_TEST(with_affine_parts(one(Expr(2.0)), u)[0].value() == 2.0);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
