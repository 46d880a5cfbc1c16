#include "courant/core/numbers/quadruple.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/expressions/function.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * sine and cosine are exchanged
//  * a series that loses its digits is taken for right to the last one
//    (core/expressions/taylor.cpp)
BOOST_AUTO_TEST_SUITE(quadruple_test)

namespace {

// f and f' at x + δ as series of order K of x + δ + s, in the order of taylor_with_jacobian.
std::vector<Quadruple> series(const std::function<Expr(const Expr&)>& f, double x, double delta,
                              Index order) {
  Graph graph;
  const ExprVector variable = graph.variables("x", 1);
  const Function function("f", {{"x", variable}}, ExprVector::Constant(1, f(variable[0])),
                          {.differentiate = {"x"}});
  std::vector<Quadruple> in(static_cast<std::size_t>(order + 1), 0.0), out(2 * in.size());
  in[0] = Quadruple(x) + delta;
  if (order > 0) in[1] = 1.0;
  const Quadruple* pointers[] = {in.data()};
  function.taylor_with_jacobian(pointers, order, out.data());
  return out;
}

// |a - b| by numbers of 113 bits.
double distance(const Quadruple& a, const Quadruple& b) {
  return std::fabs(static_cast<double>(a - b));
}

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_have_113_bits) {
  const Quadruple tiny = 0x1p-112;
  BOOST_TEST(static_cast<double>((1.0 + tiny) - 1.0) == 0x1p-112);
  BOOST_TEST(static_cast<double>((1.0 + 0x1p-114 * Quadruple(1.0)) - 1.0) == 0.0);
  BOOST_TEST(distance(Quadruple(1.0) / 3.0 * 3.0, 1.0) < 1e-33);
}

// Each function against an identity that another one of them enters.
BOOST_AUTO_TEST_CASE(functions_are_right_to_113_bits) {
  const Quadruple x = Quadruple(3.0) / 7.0;
  const auto f = [](Op op, const Quadruple& a) { return evaluate(op, a); };
  const Quadruple s = f(Op::sin, x), c = f(Op::cos, x), sh = f(Op::sinh, x), ch = f(Op::cosh, x);
  constexpr double rounding = 1e-32;
  BOOST_TEST(distance(s * s + c * c, 1.0) < rounding);
  BOOST_TEST(distance(f(Op::tan, x) * c, s) < rounding);
  BOOST_TEST(distance(f(Op::asin, s), x) < rounding);
  BOOST_TEST(distance(f(Op::acos, c), x) < rounding);
  BOOST_TEST(distance(f(Op::atan, s / c), x) < rounding);
  BOOST_TEST(distance(f(Op::exp, x), ch + sh) < rounding);
  BOOST_TEST(distance(f(Op::log, ch + sh), x) < rounding);
  BOOST_TEST(distance(f(Op::tanh, x) * ch, sh) < rounding);
  BOOST_TEST(distance(f(Op::sqrt, x) * f(Op::sqrt, x), x) < rounding);
  BOOST_TEST(distance(pow(x, 2.5) * pow(x, 0.5), x * x * x) < rounding);
  BOOST_TEST(distance(atan2(s, -c), f(Op::acos, -1.0) - x) < rounding);
  BOOST_TEST(std::isnan(static_cast<double>(f(Op::log, -1.0))));
}

// Series of formulas: sin² + cos² is constant, and what doubles lose of x is there.
BOOST_AUTO_TEST_CASE(series_are_right_to_113_bits) {
  const auto one =
      series([](const Expr& x) { return square(sin(x)) + square(cos(x)) - 1; }, 0.3, 0, 5);
  for (const Quadruple& coefficient : one) BOOST_TEST(distance(coefficient, 0.0) < 1e-33);
  const auto square_of = series([](const Expr& x) { return x * x - 1; }, 1.0, 0x1p-80, 2);
  BOOST_TEST(static_cast<double>(square_of[0]) == 0x1p-79, boost::test_tools::tolerance(1e-9));
  // Stumpff's c_0 (x²) = cos x and its slope; beyond 64 the series is not summed.
  const auto stumpff_of =
      series([](const Expr& x) { return stumpff(0, x * x) - cos(x); }, 1.5, 0, 4);
  for (const Quadruple& coefficient : stumpff_of) BOOST_TEST(distance(coefficient, 0.0) < 1e-31);
  BOOST_TEST(std::isnan(
      static_cast<double>(series([](const Expr& x) { return stumpff(0, x); }, 65.0, 0, 0)[0])));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
