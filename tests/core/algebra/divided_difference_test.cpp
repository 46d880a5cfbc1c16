#include "courant/core/algebra/divided_difference.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../numbers/operation_catalogue.hpp"
#include "courant/core/expressions/derivative.hpp"

// Mistakes that these cases have to notice:
//  * of a product one factor is taken at the start alone
//  * plain differences where they cancel
BOOST_AUTO_TEST_SUITE(divided_difference_test)

using namespace courant;

namespace {

// The difference, the value and the first three derivatives of one operation along a direction.
struct Along {
  Along(const OperationSample& sample, const VectorXd& point, const VectorXd& direction, double s) {
    Graph graph;
    const ExprVector x = graph.variables("x", point.size());
    const Expr step = graph.variable("s");
    ExprVector all(5);
    all[0] = sample.apply(x);
    for (Index k = 1; k < 4; ++k)
      all[k] = tangent(all.segment(k - 1, 1), x, constants(direction))[0];
    all[4] = divided_difference(all.head(1), x, constants(direction), step)[0];
    ExprVector from(point.size() + 1), to(point.size() + 1);
    from << x, step;
    to << constants(point), Expr(s);
    found = values(substitute(all, from, to));
    ExprVector moved(point.size() + 1);
    moved << constants(VectorXd(point + s * direction)), Expr(s);
    change = values(substitute(ExprVector(all.head(1)), from, moved))[0] - found[0];
  }
  VectorXd found;
  double change;
};

// Conditions stay what they are.
VectorXd direction(Index size) {
  return size == 1   ? VectorXd{{0.8}}
         : size == 2 ? VectorXd{{0.8, -0.35}}
                     : VectorXd{{0.0, 0.8, -0.35}};
}

}  // namespace

// Small steps: the Taylor series, whose terms are known without cancellation; s = 0: the derivative.
BOOST_AUTO_TEST_CASE(small_differences_of_every_operation) {
  for (const OperationSample& sample : operation_catalogue())
    for (const VectorXd& point : sample.points)
      for (const double part : {0.0, 1e-12, 1e-8, -1e-9}) {
        const double length = point.lpNorm<Eigen::Infinity>();
        const double s = part * (length > 0.0 ? std::min(length, 1.0) : 1.0);
        const Along along(sample, point, direction(point.size()), s);
        const VectorXd& d = along.found;
        const double series = d[1] + s / 2.0 * d[2] + s * s / 6.0 * d[3];
        const double size = std::abs(d[1]) + std::abs(d[2] * s) + 1e-3 * std::abs(d[0]);
        BOOST_TEST(std::abs(d[4] - series) <= 2e-14 * size + std::abs(s * s * s),
                   sample.name << " at " << point.transpose() << ", s = " << s << ": " << d[4]
                               << ", expected " << series);
      }
}

// Large steps: the plain difference, at both sides of where one formula takes over from another.
BOOST_AUTO_TEST_CASE(large_differences_of_every_operation) {
  for (const OperationSample& sample : operation_catalogue())
    for (const VectorXd& point : sample.points)
      for (const double s : {0.03, 0.4, -0.3, 1.7, 3.1, -40.0}) {
        const Along along(sample, point, direction(point.size()), s);
        if (!std::isfinite(along.change)) continue;
        const double size = std::abs(along.change) + std::abs(along.found[0]);
        BOOST_TEST(std::abs(s * along.found[4] - along.change) <= 2e-13 * size,
                   sample.name << " at " << point.transpose() << ", s = " << s << ": "
                               << s * along.found[4] << ", expected " << along.change);
      }
}

// Of a formula made of many: next to the sum of its terms, however small the step.
BOOST_AUTO_TEST_CASE(formulas) {
  Graph graph;
  const ExprVector x = graph.variables("x", 3), d = graph.variables("d", 3);
  const Expr f = exp(x[0] * x[1]) / (1.0 + square(x[2])) + sqrt(2.0 + sin(x[0])) * log(3.0 + x[1]) -
                 pow(x[2], 5) + atan2(x[0], 1.0 + x[1]);
  const ExprVector change = divided_difference(ExprVector::Constant(1, f), x, d, 1.0);
  ExprVector all(6);
  all << x, d;
  const VectorXd at{{0.3, -0.7, 0.9}}, along{{0.2, 0.5, -0.4}};
  const auto value = [&](const VectorXd& point) {
    return values(substitute(ExprVector::Constant(1, f), x, constants(point)))[0];
  };
  const VectorXd slope = values(substitute(gradient(f, x), x, constants(at)));
  for (const double size : {1.0, 0.1, 1e-5, 1e-10, 1e-15, 1e-100, 0.0}) {
    VectorXd both(6);
    both << at, size * along;
    const double found = values(substitute(change, all, constants(both)))[0];
    if (size >= 0.1)
      BOOST_TEST(std::abs(found - (value(at + size * along) - value(at))) < 1e-14);
    else if (size <= 1e-10)
      BOOST_TEST(std::abs(found - size * slope.dot(along)) <= 1e-9 * size);
    // Back from the other end it is the opposite, to the last digits.
    VectorXd back(6);
    back << at + size * along, -size * along;
    BOOST_TEST(std::abs(found + values(substitute(change, all, constants(back)))[0]) <=
               1e-14 * size);
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_move_has_none) {
  Graph graph;
  const ExprVector x = graph.variables("x", 2), other = graph.variables("other", 1);
  ExprVector y(3);
  y << sin(other[0]), Expr(3.0), x[1];
  const ExprVector change = divided_difference(y, x, constants(VectorXd{{1.0, 0.0}}), 0.5);
  for (Index i = 0; i < 3; ++i) BOOST_TEST(change[i].is_constant(0.0));
  BOOST_CHECK_THROW(divided_difference(y, x, ExprVector(1), 1.0), std::invalid_argument);
  ExprVector twice(2);
  twice << x[1], x[1];
  BOOST_CHECK_THROW(divided_difference(y, twice, x, 1.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
