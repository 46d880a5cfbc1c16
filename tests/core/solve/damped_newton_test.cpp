#include "courant/core/solve/damped_newton.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

// Mistakes that these cases have to notice:
//  * steps are not damped
//  * all blocks are measured alike
BOOST_AUTO_TEST_SUITE(damped_newton_method)

using namespace courant;

namespace {

// f(y) = 0 for one unknown.
template <class F, class Slope>
DampedEquations scalar(const F& f, const Slope& slope, double& kept) {
  return {
      .linearize = [&kept, slope](const VectorXd& y) { return std::isfinite(kept = slope(y[0])); },
      .correct =
          [&kept, f](const VectorXd& y, VectorXd& correction) {
            correction = VectorXd::Constant(1, f(y[0]) / kept);
            return correction.allFinite();
          },
      .groups = {1},
      .scales = VectorXd::Zero(1)};
}

}  // namespace

// Full steps diverge from |y| > 1.392.
BOOST_AUTO_TEST_CASE(an_arctangent_is_found_from_far_away) {
  double kept = 0.0;
  const auto equations = scalar([](double y) { return std::atan(y); },
                                [](double y) { return 1.0 / (1.0 + y * y); }, kept);
  for (const double start : {0.5, 2.0, -30.0, 1e4}) {
    VectorXd y = VectorXd::Constant(1, start);
    BOOST_TEST(damped_newton(equations, y));
    BOOST_TEST(std::fabs(y[0]) < 0.5);
  }
}

// A full step leads to where the exponential overflows.
BOOST_AUTO_TEST_CASE(what_is_not_finite_is_not_gone_to) {
  double kept = 0.0;
  const auto equations =
      scalar([](double y) { return 1e-9 * std::expm1(y / 0.025) + 1e-5 * y - 0.1; },
             [](double y) { return 1e-9 / 0.025 * std::exp(y / 0.025) + 1e-5; }, kept);
  VectorXd y = VectorXd::Zero(1);
  BOOST_TEST(damped_newton(equations, y));
  BOOST_TEST(std::fabs(y[0] - 0.025 * std::log(1e8)) < 0.02);
}

BOOST_AUTO_TEST_CASE(no_zero_is_no_success) {
  double kept = 0.0;
  const auto equations =
      scalar([](double y) { return 1.0 + y * y; }, [](double y) { return 2.0 * y; }, kept);
  VectorXd y = VectorXd::Constant(1, 3.0);
  BOOST_TEST(!damped_newton(equations, y));
  const auto undefined =
      scalar([](double y) { return std::log(y); }, [](double y) { return 1.0 / y; }, kept);
  y[0] = -1.0;
  BOOST_TEST(!damped_newton(undefined, y));
}

// The second block is small and has its own scale: it decides where full steps contract.
BOOST_AUTO_TEST_CASE(every_block_is_measured_by_its_own_scale) {
  VectorXd J(2);
  const auto F = [](const VectorXd& y) {
    return Eigen::Vector2d(y[0] - 1e6, std::atan(1e6 * y[1]));
  };
  const DampedEquations equations{.linearize =
                                      [&](const VectorXd& y) {
                                        J << 1.0, 1e6 / (1.0 + 1e12 * y[1] * y[1]);
                                        return J.allFinite();
                                      },
                                  .correct =
                                      [&](const VectorXd& y, VectorXd& correction) {
                                        correction = F(y).cwiseQuotient(J);
                                        return correction.allFinite();
                                      },
                                  .groups = {1, 1},
                                  .scales = Eigen::Vector2d(1e6, 0.0)};
  VectorXd y = Eigen::Vector2d(0.0, 3e-5);
  BOOST_TEST(damped_newton(equations, y));
  BOOST_TEST(std::fabs(y[1]) < 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
