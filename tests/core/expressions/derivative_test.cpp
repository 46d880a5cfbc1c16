#include "courant/core/expressions/derivative.hpp"

#include <boost/test/unit_test.hpp>
#include <map>

#include "../numbers/operation_catalogue.hpp"
#include "../random_expressions.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/numbers/special_functions.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the sign of the derivative of a quotient
//  * the derivative of arccos is that of arcsin
//  * the arguments of atan2 are exchanged
//  * a minimum is differentiated like a maximum
//  * what is needed on one way only hides the other
//  * an unknown of the result itself has no derivative
//  * the 2 of a square stands before every product
//  * a choice by an unknown is taken for an affine map
BOOST_AUTO_TEST_SUITE(derivative_test)

namespace {

// The values of expressions in x at a point.
VectorXd at(const ExprVector& y, const ExprVector& x, const VectorXd& point) {
  return Function("y", {{"x", x}}, y)({point});
}

double at(const Expr& y, const ExprVector& x, const VectorXd& point) {
  return at(ExprVector::Constant(1, y), x, point)[0];
}

// ∂y/∂x by central differences of fourth order.
MatrixXd differences(const ExprVector& y, const ExprVector& x, const VectorXd& point, double h) {
  const Function f("y", {{"x", x}}, y);
  MatrixXd result(y.size(), x.size());
  for (Index j = 0; j < x.size(); ++j) {
    const VectorXd step = h * VectorXd::Unit(x.size(), j);
    result.col(j) = (8.0 * (f({point + step}) - f({point - step})) - f({point + 2.0 * step}) +
                     f({point - 2.0 * step})) /
                    (12.0 * h);
  }
  return result;
}

double relative(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / (1.0 + b.lpNorm<Eigen::Infinity>());
}

BOOST_AUTO_TEST_CASE(operations_have_their_textbook_derivatives) {
  using std::cos, std::cosh, std::exp, std::log, std::pow, std::sin, std::sinh, std::sqrt, std::tan,
      std::tanh;
  using Slope = std::function<std::vector<double>(const VectorXd&)>;
  using V = const VectorXd&;
  const Slope zeros = [](V u) {
    return std::vector<double>(static_cast<std::size_t>(u.size()), 0.0);
  };
  const std::map<Op, Slope> slopes = {
      {Op::negate, [](V) { return std::vector{-1.0}; }},
      {Op::add,
       [](V) {
         return std::vector{1.0, 1.0};
       }},
      {Op::subtract,
       [](V) {
         return std::vector{1.0, -1.0};
       }},
      {Op::multiply,
       [](V u) {
         return std::vector{u[1], u[0]};
       }},
      {Op::divide,
       [](V u) {
         return std::vector{1.0 / u[1], -u[0] / (u[1] * u[1])};
       }},
      {Op::sqrt, [](V u) { return std::vector{0.5 / sqrt(u[0])}; }},
      {Op::exp, [](V u) { return std::vector{exp(u[0])}; }},
      {Op::log, [](V u) { return std::vector{1.0 / u[0]}; }},
      {Op::sin, [](V u) { return std::vector{cos(u[0])}; }},
      {Op::cos, [](V u) { return std::vector{-sin(u[0])}; }},
      {Op::tan, [](V u) { return std::vector{1.0 / pow(cos(u[0]), 2)}; }},
      {Op::asin, [](V u) { return std::vector{1.0 / sqrt(1.0 - u[0] * u[0])}; }},
      {Op::acos, [](V u) { return std::vector{-1.0 / sqrt(1.0 - u[0] * u[0])}; }},
      {Op::atan, [](V u) { return std::vector{1.0 / (1.0 + u[0] * u[0])}; }},
      {Op::sinh, [](V u) { return std::vector{cosh(u[0])}; }},
      {Op::cosh, [](V u) { return std::vector{sinh(u[0])}; }},
      {Op::tanh, [](V u) { return std::vector{1.0 / pow(cosh(u[0]), 2)}; }},
      {Op::abs, [](V u) { return std::vector{u[0] > 0 ? 1.0 : -1.0}; }},
      {Op::pow,
       [](V u) {
         return std::vector{u[1] * pow(u[0], u[1] - 1.0), log(u[0]) * pow(u[0], u[1])};
       }},
      {Op::atan2,
       [](V u) {
         const double r2 = u.squaredNorm();
         return std::vector{u[1] / r2, -u[0] / r2};
       }},
      {Op::min,
       [](V u) {
         return u[0] < u[1] ? std::vector{1.0, 0.0} : std::vector{0.0, 1.0};
       }},
      {Op::max,
       [](V u) {
         return u[0] > u[1] ? std::vector{1.0, 0.0} : std::vector{0.0, 1.0};
       }},
      {Op::select,
       [](V u) {
         return u[0] != 0 ? std::vector{0.0, 1.0, 0.0} : std::vector{0.0, 0.0, 1.0};
       }},
      {Op::sign, zeros},
      {Op::less, zeros},
      {Op::less_equal, zeros},
      {Op::equal, zeros},
      {Op::logical_and, zeros},
      {Op::logical_or, zeros},
      {Op::logical_not, zeros}};
  for (const auto& sample : operation_catalogue()) {
    Graph graph;
    const ExprVector u = graph.variables("u", arity(sample.op));
    const ExprVector slope = gradient(sample.apply(u), u);
    for (const VectorXd& point : sample.points) {
      std::vector<double> expected;
      if (sample.op == Op::power)
        expected = {sample.k * std::pow(point[0], sample.k - 1)};
      else if (sample.op == Op::stumpff)  // the identity with neighbours of the other side
        expected = {
            point[0] == 0.0 ? -1.0 / std::tgamma(sample.k + 3.0)
            : sample.k == 0 ? -0.5 * stumpff(1, point[0])
            : std::fabs(point[0]) < 0.1
                ? -1.0 / std::tgamma(sample.k + 3.0) + 2.0 * point[0] / std::tgamma(sample.k + 5.0)
                : (stumpff(sample.k - 1, point[0]) - sample.k * stumpff(sample.k, point[0])) /
                      (2.0 * point[0])};
      else if (sample.op == Op::arccos_factor)
        expected = {arccos_factor(sample.k + 1, point[0])};
      else
        expected = slopes.at(sample.op)(point);
      const VectorXd value = at(slope, u, point);
      for (Index i = 0; i < value.size(); ++i)
        BOOST_TEST(std::fabs(value[i] - expected[static_cast<std::size_t>(i)]) <=
                       1e-13 * (1.0 + std::fabs(value[i])),
                   sample.name << " at " << point.transpose() << ": " << value[i]);
    }
  }
}

// Each order against differences of the one before, forward against reverse mode, and the tangent
// along a direction.
BOOST_AUTO_TEST_CASE(operations_are_differentiated_to_third_order) {
  std::mt19937 generator(1);
  for (const auto& sample : operation_catalogue()) {
    Graph graph;
    const ExprVector u = graph.variables("u", arity(sample.op));
    ExprVector y = ExprVector::Constant(1, sample.apply(u));
    for (int order = 1; order <= 3; ++order) {
      const ExprMatrix forward = jacobian(y, u).dense();
      ExprMatrix reverse(y.size(), u.size());
      for (Index i = 0; i < y.size(); ++i) reverse.row(i) = gradient(y[i], u).transpose();
      const VectorXd direction = random_point(generator, u.size());
      const ExprVector along = tangent(y, u, constants(direction));
      const ExprVector flat = forward.reshaped(), flat_reverse = reverse.reshaped();
      for (const VectorXd& point : sample.points) {
        if (sample.op == Op::select && order > 0)
          continue;  // differences would change the condition
        const double h = 5e-4 * std::max(0.008, std::min(1.0, point.cwiseAbs().minCoeff()));
        const VectorXd value = at(flat, u, point);
        const VectorXd numeric = differences(y, u, point, h).reshaped();
        BOOST_TEST_CONTEXT(sample.name << ", order " << order << ", at " << point.transpose()) {
          BOOST_TEST(relative(value, numeric) < 3e-8);
          BOOST_TEST(relative(at(flat_reverse, u, point), value) < 1e-12);
          BOOST_TEST(relative(at(along, u, point), value.reshaped(y.size(), u.size()) * direction) <
                     1e-12);
        }
      }
      y = flat;
    }
  }
}

// The 2 of a square costs nothing where a factor is known.
BOOST_AUTO_TEST_CASE(gradients_of_squares_have_one_product) {
  const Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const Expr squares = 1.5 * (x[0] * x[0]) + x[1] * x[1] / 4.0;
  const ExprVector slope = gradient(squares, x);
  BOOST_TEST((slope[0] == 3.0 * x[0]));
  BOOST_TEST((slope[1] == 0.5 * x[1]));
  const Expr distance = x[0] * x[0] + x[1] * x[1];
  const ExprVector pull = gradient(0.75 * log(distance), x);
  BOOST_TEST((pull[0] == 1.5 / distance * x[0]));
  BOOST_TEST((gradient(x[0] * x[0] * x[1], x)[0] == 2.0 * x[1] * x[0]));
  BOOST_TEST((gradient(x[0] * x[0] * (1.5 * x[1]), x)[0] == 3.0 * x[1] * x[0]));
}

BOOST_AUTO_TEST_CASE(whole_powers_have_all_derivatives_at_zero) {
  Graph graph;
  const ExprVector x = graph.variables("x", 1);
  Expr y = pow(x[0], 5);
  double expected[] = {0.0, 0.0, 0.0, 0.0, 120.0, 0.0, 0.0};
  for (const double value : expected) {
    y = gradient(y, x)[0];
    BOOST_TEST(at(y, x, VectorXd::Zero(1)) == value);
  }
  BOOST_CHECK(y == Expr(0.0));
  // Not by a logarithm: a variable exponent has none at zero.
  const ExprVector v = graph.variables("v", 2);
  BOOST_TEST(std::isnan(at(gradient(pow(v[0], v[1]), v)[1], v, operands({0.0, 2.0}))));
}

BOOST_AUTO_TEST_CASE(random_expressions_agree_in_all_modes) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 20; ++trial) {
    Graph graph;
    const ExprVector x = graph.variables("x", 4);
    const ExprVector y = random_expressions(generator, x, 40, true).tail(3);
    const VectorXd point = random_point(generator, 4), direction = random_point(generator, 4),
                   weight = random_point(generator, 3);
    const ExprMatrix J = jacobian(y, x).dense();
    const MatrixXd value = at(ExprVector(J.reshaped()), x, point).reshaped(3, 4);
    BOOST_TEST_CONTEXT("trial " << trial) {
      BOOST_TEST(relative(value, differences(y, x, point, 1e-4)) < 1e-7);
      BOOST_TEST(relative(at(tangent(y, x, constants(direction)), x, point), value * direction) <
                 1e-12);
      BOOST_TEST(relative(at(pull_back(y, x, constants(weight)), x, point),
                          value.transpose() * weight) < 1e-12);
      // The Hessian three ways: reverse over reverse, forward over reverse, and symmetric.
      const ExprVector g = gradient(y[2], x);
      const MatrixXd H = at(ExprVector(jacobian(g, x).dense().reshaped()), x, point).reshaped(4, 4);
      BOOST_TEST(relative(H, H.transpose()) < 1e-11);
      for (Index i = 0; i < 4; ++i)
        BOOST_TEST(relative(at(gradient(g[i], x), x, point), H.row(i).transpose()) < 1e-11);
      BOOST_TEST(relative(H, differences(g, x, point, 1e-4)) < 1e-6);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_pattern_of_a_jacobian_is_sparse_and_sorted) {
  Graph graph;
  const ExprVector x = graph.variables("x", 4);
  ExprVector y(4);
  y << x[3] * x[1], 2.0, sin(x[2]) - sin(x[2]) + x[0], x[0] < x[1];
  const SparseExprMatrix J = jacobian(y, x);
  BOOST_TEST(J.rows == 4);
  BOOST_TEST(J.cols == 4);
  BOOST_TEST(J.row == (std::vector<Index>{0, 0, 2}), boost::test_tools::per_element());
  BOOST_TEST(J.col == (std::vector<Index>{1, 3, 0}), boost::test_tools::per_element());
  BOOST_CHECK(J.values[0] == x[3]);
  BOOST_CHECK(J.dense()(2, 0) == Expr(1.0));
  BOOST_TEST(jacobian(y, ExprVector()).values.size() == 0);
  BOOST_TEST(jacobian(ExprVector(), x).rows == 0);
}

// f is finite with its derivatives; what is not taken is not, and meets other terms on its way.
BOOST_AUTO_TEST_CASE(branches_that_are_not_taken_stay_out) {
  Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const Expr r = sqrt(x[0]), l = log(x[0] - 1.0), safe = x[0] + 2.0 * x[1];
  const Expr condition = x[0] > 1.0;
  const std::vector<std::pair<std::string, Expr>> cases = {
      {"plain", select(condition, l, safe)},
      {"inside a function with an infinite derivative", select(condition, sqrt(l), safe)},
      {"added to itself", select(condition, l * l + sin(l), safe)},
      {"used by two choices", select(condition, l, safe) + select(x[0] > 2.0, l * x[1], safe)},
      {"used by two choices, deeper",
       select(condition, exp(1.0 / r) + l, safe) * select(x[0] > 2.0, exp(1.0 / r) * l, safe)},
      {"nested", select(x[1] < 0, safe, select(condition, l / r, safe * x[1]))},
      {"nested, otherwise",
       select(condition, select(x[1] < 0, l, r), select(x[1] < 0, l / r, safe))},
      {"a maximum", max(select(condition, 1.0 / l, safe), safe - 1.0)},
      {"the smaller one", min(safe, select(safe > -9.0, safe + 1.0, l))},
      {"of a maximum with what is not a number", max(safe, l)},
  };
  const VectorXd point = operands({0.0, 0.75});  // r' and 1/r are infinite, l is not a number
  for (const auto& [name, f] : cases) {
    BOOST_TEST_CONTEXT(name) {
      const ExprVector g = gradient(f, x);
      const ExprVector forward = jacobian(ExprVector::Constant(1, f), x).dense().reshaped();
      const ExprVector hessian = jacobian(g, x).dense().reshaped();
      const ExprVector reverse_hessian = gradient(g[0] + 3.0 * g[1], x);
      const VectorXd slope = at(g, x, point);
      BOOST_TEST(slope.allFinite());
      BOOST_TEST((slope - at(forward, x, point)).norm() < 1e-15);
      BOOST_TEST((at(tangent(ExprVector::Constant(1, f), x, constants(point)), x, point)[0]) ==
                     slope.dot(point),
                 boost::test_tools::tolerance(1e-14));
      const MatrixXd H = at(hessian, x, point).reshaped(2, 2);
      BOOST_TEST(H.allFinite());
      BOOST_TEST((at(reverse_hessian, x, point) - (H.row(0) + 3.0 * H.row(1)).transpose()).norm() <
                 1e-14);
    }
  }
  // The control: with the other branch the derivative is not finite.
  BOOST_TEST(!at(gradient(select(x[0] >= 0.0, r, safe), x), x, point).allFinite());
}

BOOST_AUTO_TEST_CASE(gradients_nest) {
  // f(x) = |∇g|², g = x₀³ x₁ + sin x₁: ∇f = 2 ∇²g ∇g
  Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const ExprVector slope = gradient(gradient(pow(x[0], 3) * x[1] + sin(x[1]), x).squaredNorm(), x);
  const double a = 0.7, b = -1.3;
  const Eigen::Vector2d g(3 * a * a * b, a * a * a + std::cos(b));
  Eigen::Matrix2d H;
  H << 6 * a * b, 3 * a * a, 3 * a * a, -std::sin(b);
  BOOST_TEST((at(slope, x, Eigen::Vector2d(a, b)) - 2.0 * H * g).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(affine_maps_are_told_from_others) {
  const Graph graph;
  const ExprVector x = graph.variables("x", 2), p = graph.variables("p", 2);
  const auto is_affine_in_x = [&](const Expr& y) {
    return is_affine(ExprVector::Constant(1, y), x);
  };
  for (const Expr& y : {Expr(2.0), exp(p[0]), x[0] - sin(p[0]) * x[1] / p[1] + 3.0, -(x[0] + p[0]),
                        select(p[0] < 0.0, x[0], 2.0 * x[1])})
    BOOST_TEST(is_affine_in_x(y), y);
  for (const Expr& y : {x[0] * x[1], p[0] / x[0], sin(x[1]), abs(x[0]), sign(x[0]), pow(x[0], 2),
                        select(x[0] < 0.0, p[0], p[1]), select(x[0], p[0], p[1]), min(x[0], p[0]),
                        p[0] + x[1] * exp(x[0])})
    BOOST_TEST(!is_affine_in_x(y), y);
}

BOOST_AUTO_TEST_CASE(substitution_replaces_all_at_once) {
  Graph graph, other;
  const ExprVector x = graph.variables("x", 2), u = other.variables("u", 2);
  const Expr f = x[0] / x[1] + pow(x[0], 3);
  ExprVector swapped(2);
  swapped << x[1], x[0];
  BOOST_CHECK(substitute(f, x, swapped) == x[1] / x[0] + pow(x[1], 3));
  BOOST_CHECK(substitute(f, x, x) == f);
  BOOST_CHECK(substitute(f, x, u) == u[0] / u[1] + pow(u[0], 3));  // into another graph
  BOOST_TEST(substitute(f, x, constants(operands({2.0, 4.0}))).value() == 8.5);
  BOOST_CHECK(substitute(Expr(3.0), x, u) == Expr(3.0));
  BOOST_CHECK_THROW(substitute(f, x.head(1), u.head(1)),
                    std::invalid_argument);  // x[1] would stay behind
}

BOOST_AUTO_TEST_CASE(wrong_arguments_are_refused) {
  Graph graph, other;
  const ExprVector x = graph.variables("x", 2), u = other.variables("u", 1);
  const Expr f = x[0] * x[1];
  BOOST_CHECK_THROW(gradient(f, ExprVector::Constant(1, x[0] + 1.0)), std::invalid_argument);
  BOOST_CHECK_THROW(gradient(f, ExprVector::Constant(1, Expr(1.0))), std::invalid_argument);
  BOOST_CHECK_THROW(gradient(f, ExprVector::Constant(2, x[0])), std::invalid_argument);
  BOOST_CHECK_THROW(tangent(x, x, x.head(1)), std::invalid_argument);
  BOOST_CHECK_THROW(pull_back(x, x, x.head(1)), std::invalid_argument);
  BOOST_CHECK_THROW(substitute(f, x, x.head(1)), std::invalid_argument);
  BOOST_CHECK(gradient(f, u)[0] == Expr(0.0));
  BOOST_CHECK(gradient(Expr(2.0), x)[1] == Expr(0.0));
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
