#include <boost/test/unit_test.hpp>
#include <sstream>

#include "courant/core/expressions/expr.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a formula with 0/0 is told as -nan/x (core/expressions/expr.cpp)
BOOST_AUTO_TEST_SUITE(expr_printing_test)

namespace {

struct Names {
  Graph graph;
  Expr x = graph.variable("x"), y = graph.variable("y"), z = graph.variable("z");
};

BOOST_FIXTURE_TEST_CASE(parentheses_are_written_where_they_matter, Names) {
  BOOST_TEST(to_string(x + y * z) == "x + y*z");
  BOOST_TEST(to_string((x + y) * z) == "(x + y)*z");
  BOOST_TEST(to_string(x * y * z) == "x*y*z");
  BOOST_TEST(to_string(y * x * z) == "x*y*z");  // the same node, as it was written first
  BOOST_TEST(to_string(x - (y - z)) == "x - (y - z)");
  BOOST_TEST(to_string((x - y) - z) == "x - y - z");
  BOOST_TEST(to_string(x / (y * z)) == "x/(y*z)");
  BOOST_TEST(to_string(x / y / z) == "x/y/z");
  BOOST_TEST(to_string(x / (y / z)) == "x/(y/z)");
  BOOST_TEST(to_string(-(x + y)) == "-(x + y)");
  BOOST_TEST(to_string(-(x * y)) == "-x*y");
  BOOST_TEST(to_string(x * x) == "x^2");
  BOOST_TEST(to_string(pow(x + y, 3)) == "(x + y)^3");
  BOOST_TEST(to_string(pow(-x, 3)) == "(-x)^3");
  BOOST_TEST(to_string(-pow(x, 3)) == "-x^3");
  BOOST_TEST(to_string(pow(pow(x, 3), 4)) == "(x^3)^4");
  BOOST_TEST(to_string(pow(x, y * z)) == "x^(y*z)");
  BOOST_TEST(to_string(pow(x, pow(y, z))) == "x^y^z");
  BOOST_TEST(to_string(pow(x, -2)) == "x^(-2)");
  BOOST_TEST(to_string(exp(-x)) == "exp(-x)");
}

// 0/0 has no sign, and nothing is made of it.
BOOST_FIXTURE_TEST_CASE(what_is_no_number_stays_so, Names) {
  const Expr none = Expr(0.0) / 0.0;
  for (const Expr& a : {none / -x, -x * none, none - x, x + none, -none, x - none, none * 0.0})
    BOOST_TEST(to_string(a) == "nan");
  BOOST_TEST((Expr(0.0) * x).is_constant(0.0));
}

BOOST_FIXTURE_TEST_CASE(conditions_and_functions_are_written_as_in_formulas, Names) {
  BOOST_TEST(to_string(select(x < y, x, -y)) == "if(x < y, x, -y)");
  BOOST_TEST(to_string(logical_or(logical_and(x < y, y <= z), equal(x, z))) ==
             "x < y && y <= z || x == z");
  BOOST_TEST(to_string(logical_and(x, logical_or(y, z))) == "x && (y || z)");
  BOOST_TEST(to_string(logical_not(x < y)) == "!(x < y)");
  BOOST_TEST(to_string(x + y < z) == "x + y < z");
  BOOST_TEST(to_string((x < y) + 1.0) == "(x < y) + 1");
  BOOST_TEST(to_string(min(x, max(y, z)) + 1.0) == "min(x, max(y, z)) + 1");
  BOOST_TEST(to_string(atan2(y, x)) == "atan2(y, x)");
  BOOST_TEST(to_string(stumpff(2, x) * arccos_factor(0, y)) == "stumpff(2, x)*arccos_factor(0, y)");
}

BOOST_FIXTURE_TEST_CASE(numbers_are_short_and_exact, Names) {
  BOOST_TEST(to_string(0.1 * x) == "0.1*x");
  BOOST_TEST(to_string(x * 3.0) == "3*x");
  BOOST_TEST(to_string(x + 1e-300) == "x + 1e-300");
  BOOST_TEST(std::stod(to_string(Expr(1.0 / 3.0))) == 1.0 / 3.0);
  BOOST_TEST(to_string(Expr(-2.5)) == "-2.5");
  BOOST_TEST(to_string(x + -2.0) == "x - 2");
  BOOST_TEST(to_string(x + -2.0 * y) == "x - 2*y");
  BOOST_TEST(to_string(-2.0 * y + x * y * -3.0) == "-2*y - 3*x*y");
  BOOST_TEST(to_string(x - -2.0) == "x - (-2)");
  BOOST_TEST(to_string(x / -2.0) == "x/(-2)");
  BOOST_TEST(to_string(pow(-2.0, x)) == "(-2)^x");
}

BOOST_FIXTURE_TEST_CASE(long_expressions_are_cut_off, Names) {
  // Written out, this doubles with each step.
  Expr f = x + y;
  for (int i = 0; i < 10'000; ++i) f = sin(f) * f;
  const std::string text = to_string(f, 100);
  BOOST_TEST(text.size() == 100 + std::string("…").size());
  BOOST_TEST(text.ends_with("…"));
  BOOST_TEST(to_string(x + y, 5) == "x + y");
  BOOST_TEST(to_string(x + y, 4) == "x + …");
  BOOST_TEST(to_string(graph.variable("λλ") + x, 3) == "λ…");  // no half of a character
}

BOOST_FIXTURE_TEST_CASE(streams_and_matrices_print, Names) {
  std::ostringstream out;
  out << x + y << "; " << ExprVector::Constant(2, x).transpose();
  BOOST_TEST(out.str() == "x + y; x x");
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
