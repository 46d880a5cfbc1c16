// A pendulum in Cartesian coordinates, released at rest at 2 rad.
#pragma once

#include <boost/math/special_functions/ellint_1.hpp>

#include "problem.hpp"

namespace work_precision {

// q = (x, y), g = (x² + y² - 1)/2, H = |v|²/2 + y.
struct Pendulum {
  static constexpr const char* name = "Cartesian pendulum";
  static constexpr int n = 2, m = 1;
  static constexpr bool separable = false;
  static constexpr std::array horizons{1000.0, 10000.0};

  template <class T>
  static std::array<T, 4> start() {
    return {std::sin(T(2)), -std::cos(T(2)), T(0), T(0)};
  }
  static double period() { return 4.0 * boost::math::ellint_1(std::sin(1.0)); }
  static StateOf<Pendulum> exact(double /*periods*/) { return start<double>(); }

  template <class T>
  static void field(const T* y, T* dy, T* lambda) {
    lambda[0] = (y[1] - y[2] * y[2] - y[3] * y[3]) / (y[0] * y[0] + y[1] * y[1]);
    dy[0] = y[2];
    dy[1] = y[3];
    dy[2] = lambda[0] * y[0];
    dy[3] = lambda[0] * y[1] - 1;
  }
  static double energy(const double* y) { return 0.5 * (y[2] * y[2] + y[3] * y[3]) + y[1]; }
  static double violation(const double* y) {
    return std::max(std::fabs(0.5 * (y[0] * y[0] + y[1] * y[1] - 1.0)),
                    std::fabs(y[0] * y[2] + y[1] * y[3]));
  }
  template <class T>
  static void residual(const T* y, const T* dy, T* r) {
    const T &mu = y[4], &lambda = y[5];
    r[0] = dy[0] - y[2] - mu * y[0];
    r[1] = dy[1] - y[3] - mu * y[1];
    r[2] = dy[2] - lambda * y[0];
    r[3] = dy[3] - lambda * y[1] + 1.0;
    r[4] = 0.5 * (y[0] * y[0] + y[1] * y[1] - 1.0);
    r[5] = y[0] * y[2] + y[1] * y[3];
  }

  // RATTLE: the multiplier of the position from a quadratic equation, that of the velocity from a
  // linear one.
  static void rattle(double* y, double h) {
    const double x = y[0] + h * y[2], z = y[1] + h * (y[3] - 0.5 * h);
    const double a = y[0] * y[0] + y[1] * y[1], b = x * y[0] + z * y[1], c = x * x + z * z - 1.0;
    const double mu = c / (b + std::sqrt(b * b - a * c));
    const double x1 = x - mu * y[0], z1 = z - mu * y[1];
    const double v = (x1 - y[0]) / h, w = (z1 - y[1]) / h - 0.5 * h;
    const double nu = (x1 * v + z1 * w) / (x1 * x1 + z1 * z1);
    y[0] = x1;
    y[1] = z1;
    y[2] = v - nu * x1;
    y[3] = w - nu * z1;
  }

  static std::string file() { return "pendulum_holonomic.json"; }
  static void change(Json& document) {
    document["system"]["parameters"] = {{"m", 1}, {"l", 1}, {"g", 1}};
    document["initial"] = {{"x", "sin(2)"}, {"y", "-cos(2)"}, {"x'", 0}, {"y'", 0}};
  }
  static double time_scale() { return 1.0; }
  static void of_state(const courant::VectorXd& x, double* y) { std::copy_n(x.data(), 4, y); }
  static std::vector<Choice> choices() {
    return with_verlet({{"Method 2", {{"type", "constrain-first"}}, 500},
                        {"Method 2, order 4", {{"type", "constrain-first"}, {"order", 4}}, 64},
                        {"Method 2, order 6", {{"type", "constrain-first"}, {"order", 6}}, 40},
                        {"Method 2, order 8", {{"type", "constrain-first"}, {"order", 8}}, 32}},
                       "constrain-first", "RATTLE");
  }
};

}  // namespace work_precision
