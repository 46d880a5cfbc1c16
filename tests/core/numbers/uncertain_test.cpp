#include "courant/core/numbers/uncertain.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "courant/core/expressions/function.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(uncertain_test)

namespace {

// f and its Jacobian as series of order K at x with these uncertainties, by the interpreter.
struct Series {
  Function f;
  Index order;

  std::vector<Uncertain> at(const std::vector<Uncertain>& x) const {
    std::vector<Uncertain> in, out(size());
    for (const Uncertain& number : x) {
      in.push_back(number);
      for (Index i = 1; i <= order; ++i) in.push_back(i == 1 ? 1.0 : 0.0);
    }
    const Uncertain* pointers[] = {in.data()};
    f.taylor_with_jacobian(pointers, order, out.data());
    return out;
  }
  std::vector<double> at(const std::vector<double>& x) const {
    std::vector<double> in, out(size());
    for (const double number : x) {
      in.push_back(number);
      for (Index i = 1; i <= order; ++i) in.push_back(i == 1 ? 1.0 : 0.0);
    }
    const double* pointers[] = {in.data()};
    f.taylor_with_jacobian(pointers, order, out.data());
    return out;
  }
  std::size_t size() const {
    return static_cast<std::size_t>((f.output_size() + f.nonzeros()) * (order + 1));
  }
};

// Every operation that has derivatives, away from its singular points.
Series all_functions(Index order) {
  Graph graph;
  const ExprVector x = graph.variables("x", 3);
  ExprVector F(14);
  const Expr a = x[0], b = x[1], c = x[2];
  F << sin(a + 0.3) * cos(b), exp(a * b) / (1 + c * c), sqrt(1 + a * a + b), log(2 + c) - a,
      tan(0.3 * a) + tanh(b), sinh(c) - cosh(a), asin(0.2 * a) * acos(0.1 * b), atan(a * c),
      atan2(1 + a, 2 + b), pow(2 + a, 3) / pow(3 + b, 2), pow(2 + a, Expr(1.7)), pow(2 + c, a),
      abs(a - 5) + min(a, b + 7) - max(c, a - 7), (a - b) * (a + b) - (a * a - b * b);
  return {Function("F", {{"x", x}}, F, {.differentiate = {"x"}}), order};
}

}  // namespace

BOOST_AUTO_TEST_CASE(values_are_those_of_doubles_to_the_last_bit) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Series series = all_functions(4);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<double> x = {uniform(generator), uniform(generator), uniform(generator)};
    const std::vector<double> plain = series.at(x);
    const std::vector<Uncertain> bounded =
        series.at(std::vector<Uncertain>{{x[0], 1e-9}, Uncertain::rounded(x[1]), Uncertain(x[2])});
    for (std::size_t i = 0; i < plain.size(); ++i) BOOST_TEST(plain[i] == bounded[i].value);
  }
}

// The number that is meant may lie anywhere in the intervals of the inputs.
BOOST_AUTO_TEST_CASE(bounds_hold_within_the_intervals) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Series series = all_functions(3);
  double sharpest = std::numeric_limits<double>::infinity();
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Uncertain> x;
    std::vector<double> meant;
    for (int i = 0; i < 3; ++i) {
      x.emplace_back(uniform(generator), 1e-7);
      meant.push_back(x.back().value + 1e-7 * uniform(generator));
    }
    const std::vector<Uncertain> bounded = series.at(x);
    const std::vector<double> exact = series.at(meant);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double off = std::fabs(exact[i] - bounded[i].value);
      // To first order: the second is 10⁻⁷ of it.
      BOOST_TEST(off <= bounded[i].error * (1.0 + 1e-5) + 1e-15);
      if (off > 1e-10) sharpest = std::min(sharpest, bounded[i].error / off);
    }
  }
  BOOST_TEST(sharpest < 1.2);  // and they are no larger than they must be
}

// Roundings alone, against the same formulas with twice the digits.
BOOST_AUTO_TEST_CASE(what_cancels_is_within_its_error) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const Uncertain a = Uncertain::rounded(uniform(generator));
    const Uncertain sine = evaluate(Op::sin, a), cosine = evaluate(Op::cos, a);
    BOOST_TEST(!(sine * sine + cosine * cosine - 1.0).is_nonzero());
    const Uncertain root = evaluate(Op::sqrt, a * a + 1.0);
    BOOST_TEST(!(root * root - a * a - 1.0).is_nonzero());
    BOOST_TEST(!(evaluate(Op::log, evaluate(Op::exp, a)) - a).is_nonzero());
    // The control: what differs by a hundred roundings is not zero.
    BOOST_TEST((a * (1.0 + 1e-13) - a).is_nonzero());
  }
  const Uncertain tenths = Uncertain::rounded(0.1) + Uncertain::rounded(0.2);
  BOOST_TEST(!(tenths - Uncertain::rounded(0.3)).is_nonzero());
}

BOOST_AUTO_TEST_CASE(structural_zeros_are_exact) {
  const Uncertain a = {0.3, 1e-5}, zero = 0.0;
  BOOST_TEST((a * zero).is_exactly(0.0));
  BOOST_TEST((zero / a).is_exactly(0.0));
  BOOST_TEST((zero + zero).is_exactly(0.0));
  BOOST_TEST((a + zero).error == a.error);
  BOOST_TEST((a * Uncertain(-1.0)).error == a.error);
  BOOST_TEST(evaluate(Op::sin, zero).is_exactly(0.0));
  BOOST_TEST(evaluate(Op::sqrt, zero).is_exactly(0.0));
  BOOST_TEST(Uncertain::rounded(2.0).error == 0.0);
  BOOST_TEST(Uncertain::rounded(0.375).error == 0.0);
  BOOST_TEST(Uncertain::rounded(0.1).error > 0.0);
}

BOOST_AUTO_TEST_CASE(nothing_is_known_where_a_divisor_may_vanish) {
  const Uncertain quotient = Uncertain(1.0) / Uncertain(1e-17, 1e-16);
  BOOST_TEST(!quotient.is_nonzero());
  BOOST_TEST(std::isinf(quotient.error));
  // Numbers that leave the range of doubles when divided are no numbers.
  BOOST_TEST(!Uncertain::rounded(1e-320).is_nonzero());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
