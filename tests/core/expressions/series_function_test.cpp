#include "courant/core/expressions/series_function.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/numbers/ball.hpp"

BOOST_AUTO_TEST_SUITE(series_function_test)

using namespace courant;

namespace {

struct Answer {
  std::vector<Digits> series;
  bool is_at_edge;
};

// f on x + t to this order.
Answer along_a_line(const SeriesFunction& f, double x, Index order, int side = 0) {
  std::vector<Digits> in(static_cast<std::size_t>(order + 1));
  in[0] = Digits::written(x);
  if (order > 0) in[1] = 1.0;
  std::vector<Digits> out(static_cast<std::size_t>(f.output_size() * (order + 1)));
  const Digits* group = in.data();
  const bool is_at_edge = f.run(&group, order, out.data(), side);
  return {out, is_at_edge};
}

}  // namespace

BOOST_AUTO_TEST_CASE(series_have_the_digits_of_the_decision) {
  const Graph graph;
  const ExprVector x = ExprVector::Constant(1, graph.variable("x"));
  const SeriesFunction f({x},
                         ExprVector::Constant(1, sin(x[0]) * sin(x[0]) + cos(x[0]) * cos(x[0])));
  const Answer answer = along_a_line(f, 0.3, 4);
  BOOST_TEST((answer.series[0] - Digits(1.0)).shrinks());
  for (std::size_t i = 1; i <= 4; ++i) BOOST_TEST(answer.series[i].shrinks());
  const SeriesFunction exponential({x}, ExprVector::Constant(1, exp(x[0])));
  const Answer taylor = along_a_line(exponential, 0.0, 3);
  BOOST_TEST((taylor.series[3] * Digits(6.0) - Digits(1.0)).shrinks());
}

BOOST_AUTO_TEST_CASE(a_switch_at_its_edge_is_said_and_has_two_sides) {
  const Graph graph;
  const ExprVector x = ExprVector::Constant(1, graph.variable("x"));
  const SeriesFunction f({x}, ExprVector::Constant(1, abs(x[0])));
  BOOST_TEST(!along_a_line(f, 0.1, 1).is_at_edge);
  BOOST_TEST(along_a_line(f, 0.0, 1).is_at_edge);
  BOOST_TEST(static_cast<double>(along_a_line(f, 0.0, 1, 1).series[1]) == 1.0);
  BOOST_TEST(static_cast<double>(along_a_line(f, 0.0, 1, -1).series[1]) == -1.0);
}

BOOST_AUTO_TEST_CASE(what_only_time_switches_is_what_it_is_a_moment_later) {
  const Graph graph;
  const ExprVector t = ExprVector::Constant(1, graph.variable("t"));
  const SeriesFunction f({t}, ExprVector::Constant(1, select(t[0] <= 0.5, Expr(1.0), Expr(2.0))),
                         0);
  const Answer answer = along_a_line(f, 0.5, 1);
  BOOST_TEST(!answer.is_at_edge);
  BOOST_TEST(static_cast<double>(answer.series[0]) == 2.0);
}

// Balls contain the numbers that digits have, of functions, powers and quotients, to a high order.
BOOST_AUTO_TEST_CASE(series_of_balls_contain_those_of_digits) {
  if (!Ball::is_available()) return;
  const Graph graph;
  const ExprVector x = ExprVector::Constant(1, graph.variable("x"));
  const Expr& a = x[0];
  ExprVector formulas(16);
  formulas << a * a - 3.0 * a, 1.0 / (1.0 + a), sqrt(1.0 + a), exp(a), log(a), sin(a), cos(a),
      tan(a), asin(a), acos(a), atan(a), sinh(a) + cosh(a), tanh(a), pow(a, Expr(1.5)),
      pow(a, 2.0 + a), atan2(a, 1.0 - a);
  const SeriesFunction f({x}, formulas);
  constexpr Index order = 6;
  const Answer digits = along_a_line(f, 0.3, order);
  std::vector<Ball> in(order + 1), out(static_cast<std::size_t>(f.output_size() * (order + 1)));
  in[0] = Ball::written(0.3);
  in[1] = 1.0;
  const Ball* group = in.data();
  BOOST_TEST(!f.run(&group, order, out.data()));
  for (std::size_t i = 0; i < out.size(); ++i) {
    Ball difference = out[i];
    for (const double term : digits.series[i].terms()) difference -= term;
    BOOST_TEST_CONTEXT("coefficient " << i) {
      BOOST_TEST(out[i].radius() < 1e-140);
      // Digits have 256 bits.
      BOOST_TEST(difference.widened_by(1.0, -240).contains_zero());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_switch_that_a_ball_does_not_decide_is_at_its_edge) {
  if (!Ball::is_available()) return;
  const Graph graph;
  const ExprVector x = ExprVector::Constant(1, graph.variable("x"));
  const SeriesFunction f({x}, ExprVector::Constant(1, max(x[0], Expr(0.0))));
  Ball out;
  for (const double half_width : {0.5, 2.0}) {
    const Ball in = Ball(1.0).widened_by(half_width, 0);
    const Ball* group = &in;
    BOOST_TEST(f.run(&group, 0, &out) == (half_width > 1.0));
  }
}

BOOST_AUTO_TEST_SUITE_END()
