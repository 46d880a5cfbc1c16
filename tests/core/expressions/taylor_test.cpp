#include "courant/core/expressions/taylor.hpp"

#include <boost/test/unit_test.hpp>

#include "../numbers/operation_catalogue.hpp"
#include "../random_expressions.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/numbers/special_functions.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(taylor_test)

namespace {

constexpr Index K = 10;
using Series = Eigen::Matrix<double, K + 1, 1>;

Series apply(Op op, std::int32_t k, const Series& a, const Series& b = Series::Zero(),
             const Series& c = Series::Zero()) {
  Series out = Series::Constant(std::numeric_limits<double>::quiet_NaN());
  VectorXd scratch(taylor::scratch_size(K));
  taylor::apply(op, k, K, a.data(), b.data(), c.data(), out.data(), scratch.data());
  return out;
}

// a + t
Series line(double a) { return a * Series::Unit(0) + Series::Unit(1); }

template <class Coefficient>
Series series(const Coefficient& coefficient) {
  return Series::NullaryExpr([&](Index n) { return coefficient(static_cast<double>(n)); });
}

double factorial(double n) { return std::tgamma(n + 1.0); }

double error(const Series& a, const Series& b) {
  return ((a - b).array().abs() / (b.array().abs() + 1e-2 * b.lpNorm<Eigen::Infinity>()))
      .maxCoeff();
}

BOOST_AUTO_TEST_CASE(known_series_come_out) {
  const auto sign = [](double n) { return std::fmod(n, 2.0) == 0.0 ? 1.0 : -1.0; };
  const auto even = [](double n) { return std::fmod(n, 2.0) == 0.0; };
  const auto alternating = [](double n) { return std::fmod(n, 4.0) < 2.0 ? 1.0 : -1.0; };
  const Series t = line(0.0);
  BOOST_TEST(error(apply(Op::exp, 0, line(0.5)),
                   series([](double n) { return std::exp(0.5) / factorial(n); })) < 1e-14);
  BOOST_TEST(error(apply(Op::log, 0, line(1.0)),
                   series([&](double n) { return n == 0 ? 0.0 : -sign(n) / n; })) < 1e-14);
  BOOST_TEST(error(apply(Op::divide, 0, line(1.0), Series(2.0 * Series::Unit(0) - Series::Unit(1))),
                   series([](double n) { return (n == 0 ? 0.5 : 1.5 * std::pow(0.5, n)); })) <
             1e-14);
  BOOST_TEST(error(apply(Op::sin, 0, t), series([&](double n) {
                     return even(n) ? 0.0 : alternating(n) / factorial(n);
                   })) < 1e-14);
  BOOST_TEST(error(apply(Op::cos, 0, t), series([&](double n) {
                     return even(n) ? alternating(n) / factorial(n) : 0.0;
                   })) < 1e-14);
  BOOST_TEST(error(apply(Op::sinh, 0, t),
                   series([&](double n) { return even(n) ? 0.0 : 1.0 / factorial(n); })) < 1e-14);
  BOOST_TEST(error(apply(Op::cosh, 0, t),
                   series([&](double n) { return even(n) ? 1.0 / factorial(n) : 0.0; })) < 1e-14);
  BOOST_TEST(error(apply(Op::atan, 0, t),
                   series([&](double n) { return even(n) ? 0.0 : alternating(n) / n; })) < 1e-14);
  Series tangent;
  tangent << 0.0, 1.0, 0.0, 1.0 / 3, 0.0, 2.0 / 15, 0.0, 17.0 / 315, 0.0, 62.0 / 2835, 0.0;
  BOOST_TEST(error(apply(Op::tan, 0, t), tangent) < 1e-14);
  BOOST_TEST(error(apply(Op::tanh, 0, t), series([&](double n) {
                     return alternating(n) * tangent[static_cast<Index>(n)];
                   })) < 1e-14);
  Series arcsine;
  arcsine << 0.0, 1.0, 0.0, 1.0 / 6, 0.0, 3.0 / 40, 0.0, 15.0 / 336, 0.0, 105.0 / 3456, 0.0;
  BOOST_TEST(error(apply(Op::asin, 0, t), arcsine) < 1e-14);
  Series root;  // √(1 + t)
  root[0] = 1.0;
  for (Index n = 1; n <= K; ++n)
    root[n] = root[n - 1] * (1.5 - static_cast<double>(n)) / static_cast<double>(n);
  BOOST_TEST(error(apply(Op::sqrt, 0, line(1.0)), root) < 1e-14);
  BOOST_TEST(error(apply(Op::pow, 0, line(1.0), Series(0.5 * Series::Unit(0))), root) < 1e-14);
  BOOST_TEST(error(apply(Op::power, 4, line(1.0)), series([](double n) {
                     return n <= 4 ? 24.0 / factorial(n) / factorial(4 - n) : 0.0;
                   })) < 1e-14);
  BOOST_TEST(error(apply(Op::power, -1, line(1.0)), series(sign)) < 1e-14);
  BOOST_TEST(error(apply(Op::stumpff, 3, t),
                   series([&](double n) { return sign(n) / factorial(2 * n + 3); })) < 1e-14);
}

BOOST_AUTO_TEST_CASE(powers_of_what_vanishes_are_exact) {
  const Series t = line(0.0), cube = Series::Unit(3);
  BOOST_TEST(apply(Op::power, 3, t) == cube);
  BOOST_TEST(apply(Op::pow, 0, t, Series(3.0 * Series::Unit(0))) ==
             cube);  // an exponent that doesn't move
  BOOST_TEST(apply(Op::abs, 0, Series(-t)) == t);
  BOOST_TEST(apply(Op::min, 0, t, Series(2.0 * t)) == t);
  BOOST_TEST(apply(Op::max, 0, t, Series(2.0 * t)) == Series(2.0 * t));
  BOOST_TEST(apply(Op::less, 0, Series(-t), t) == Series::Zero());  // decided at t = 0
  BOOST_TEST(!apply(Op::sqrt, 0, t).allFinite());
}

// c_k along s₀ + t, where the way of computing changes with s₀ and the order: s c_{k+2} = 1/k! -
// c_k as series.
BOOST_AUTO_TEST_CASE(series_of_stumpff_functions_satisfy_their_recurrence) {
  double inverse_factorial = 1.0;
  for (int k = 0; k <= 6; ++k) {
    for (double s = -60.0; s < 400.0; s += 7.3) {
      const Series c = apply(Op::stumpff, k, line(s)), next = apply(Op::stumpff, k + 2, line(s));
      const Series left = apply(Op::multiply, 0, line(s), next),
                   right = inverse_factorial * Series::Unit(0) - c;
      for (Index n = 0; n <= K; ++n) {
        const double before = n > 0 ? std::fabs(next[n - 1]) : inverse_factorial;
        const double scale = std::fabs(s * next[n]) + before + std::fabs(c[n]);
        BOOST_TEST(std::fabs(left[n] - right[n]) < 1e-12 * scale,
                   "k = " << k << ", s = " << s << ", n = " << n);
      }
      BOOST_TEST(c[0] == stumpff(k, s));
    }
    inverse_factorial /= k + 1.0;
  }
}

// Coefficients by repeated differentiation by t, symbolically, along polynomial operands.
template <class Formula>
void compare_with_repeated_derivatives(const Formula& formula, Index arguments,
                                       const VectorXd& start, std::mt19937& generator,
                                       const std::string& name) {
  Graph graph;
  const ExprVector t = graph.variables("t", 1);
  MatrixXd operand = MatrixXd::Zero(arguments, K + 1);
  ExprVector path(arguments);
  for (Index i = 0; i < arguments; ++i) {
    operand.row(i).head(3) = 0.3 * random_point(generator, 3).transpose();
    operand(i, 0) = start[i];
    path[i] = operand(i, 0) + t[0] * (operand(i, 1) + t[0] * operand(i, 2));
  }
  Graph formal;
  const ExprVector u = formal.variables("u", arguments);
  const Function function("f", {{"u", u}}, formula(u));
  const MatrixXd taylor = function.taylor(std::vector{operand});

  ExprVector y = formula(path);
  double inverse_factorial = 1.0;
  for (Index n = 0; n <= K; ++n) {
    const VectorXd value = Function("y", {{"t", t}}, y)({VectorXd::Zero(1)});
    for (Index i = 0; i < y.size(); ++i) {
      const double scale = taylor.row(i).lpNorm<Eigen::Infinity>();
      BOOST_TEST(std::fabs(inverse_factorial * value[i] - taylor(i, n)) <=
                     1e-11 * scale + 1e-9 * std::fabs(taylor(i, n)),
                 name << ", coefficient " << n << " at " << start.transpose() << ": "
                      << taylor(i, n) << " and " << inverse_factorial * value[i]);
    }
    y = tangent(y, t, ExprVector::Constant(1, Expr(1.0)));
    inverse_factorial /= static_cast<double>(n + 1);
  }
}

BOOST_AUTO_TEST_CASE(series_of_operations_are_repeated_derivatives) {
  std::mt19937 generator(3);
  for (const auto& sample : operation_catalogue()) {
    for (const VectorXd& point : sample.points) {
      const auto formula = [&](const ExprVector& u) {
        return ExprVector::Constant(1, sample.apply(u));
      };
      if (sample.op == Op::select || sample.op == Op::logical_not)
        continue;  // a moving condition has no derivative
      compare_with_repeated_derivatives(formula, point.size(), point, generator, sample.name);
    }
  }
}

BOOST_AUTO_TEST_CASE(series_of_random_expressions_are_repeated_derivatives) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 generator(seed);
    const auto formula = [&](const ExprVector& u) {
      std::mt19937 same(seed);
      return ExprVector(random_expressions(same, u, 6, true).tail(2));
    };
    compare_with_repeated_derivatives(formula, 2, random_point(generator, 2), generator,
                                      "seed " + std::to_string(seed));
  }
}

BOOST_AUTO_TEST_CASE(a_selection_follows_its_condition) {
  Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const Function f("f", {{"x", x}},
                   ExprVector::Constant(1, select(x[0] < 0.0, log(x[1]), square(x[1]))));
  MatrixXd in(2, 3);
  in << 0.5, 1.0, 0.0, -1.0, 1.0, 0.0;  // log of a negative number is not taken
  const MatrixXd out = f.taylor(std::vector{in});
  BOOST_TEST(out(0, 0) == 1.0);
  BOOST_TEST(out(0, 1) == -2.0);
  BOOST_TEST(out(0, 2) == 1.0);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
