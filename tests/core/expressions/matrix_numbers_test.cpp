#include "courant/core/expressions/matrix_numbers.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/expressions/derivative.hpp"

// Mistakes that these cases have to notice:
//  * affine equations are solved by the matrix of another step
//  * points that change with each step are numbers that a matrix is made of
//  * the matrix of equations that are not affine counts as theirs
BOOST_AUTO_TEST_SUITE(matrix_numbers)

using namespace courant;

namespace {

// Two equations for x with parameters h (one number) and c (two).
struct Equations {
  Graph graph;
  ExprVector x = graph.variables("x", 2), h = graph.variables("h", 1), c = graph.variables("c", 2);

  MatrixNumbers numbers(const Expr& first) const {
    ExprVector F(2);
    F << first, x[1] - c[1];
    return {F, jacobian(F, x).values, {x, h, c}};
  }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(are_those_of_affine_equations, Equations) {
  using Groups = std::vector<Index>;
  BOOST_TEST((*numbers(x[0] + h[0] * x[1] - c[0]).groups() == Groups{1}));
  BOOST_TEST((numbers(3.0 * x[0] - c[0]).groups()->empty()));
  BOOST_TEST(!numbers(c[0] * x[0] - h[0]).groups());  // two numbers
  BOOST_TEST(!numbers(pow(x[0], 3) - h[0] * x[1]).groups());
  BOOST_TEST(!numbers(x[0] - sign(x[1])).groups());
}

BOOST_FIXTURE_TEST_CASE(are_compared_with_those_that_were_kept, Equations) {
  double at[] = {1.0, 2.0}, step = 0.1, other[] = {3.0, 4.0};
  const Inputs in(at, {&step, other});
  MatrixNumbers some = numbers(x[0] + h[0] * x[1] - c[0]);
  some.keep(in);
  at[0] = other[0] = 5.0;
  BOOST_TEST(some.are_kept(in));
  step = 0.2;
  BOOST_TEST(!some.are_kept(in));
  some.keep(in);
  BOOST_TEST(some.are_kept(in));

  BOOST_TEST(numbers(x[0] - h[0]).are_kept(in));
  MatrixNumbers unknown = numbers(c[0] * x[0] - h[0]);
  unknown.keep(in);
  BOOST_TEST(!unknown.are_kept(in));
  BOOST_TEST(!MatrixNumbers().are_kept(in));
}

BOOST_AUTO_TEST_SUITE_END()
