// The double pendulum of experiments/double_pendulum.json, in angles.
#pragma once

#include "problem.hpp"
#include "reference.hpp"

namespace work_precision {

// q = (a, b). The motion is chaotic: a longer one has no digit in common with its reference.
struct DoublePendulum {
  static constexpr const char* name = "double pendulum";
  static constexpr int n = 2, m = 0;
  static constexpr bool separable = false;
  static constexpr std::array horizons{5.0};  // seconds

  // M_aa, M_ab/cos(a - b), M_bb; the weights of cos a, cos b in the potential.
  static constexpr double m0 = 1.3, m1 = 0.8, l0 = 0.9, l1 = 0.7, gravity = 9.81;
  static constexpr double A = (m0 + m1) * l0 * l0, E = m1 * l0 * l1, B = m1 * l1 * l1;
  static constexpr double wa = (m0 + m1) * gravity * l0, wb = m1 * gravity * l1;

  template <class T>
  static std::array<T, 4> start() {
    return {T(2.1), T(1.4), T(0), T(0)};
  }
  static double period() { return 1.0; }
  static StateOf<DoublePendulum> exact(double periods) {
    const auto y = flow<DoublePendulum>(start<long double>(), periods, 40000);
    StateOf<DoublePendulum> rounded{};
    for (std::size_t i = 0; i < y.size(); ++i) rounded[i] = static_cast<double>(y[i]);
    return rounded;
  }

  template <class T>
  static void field(const T* y, T* dy, T* /*lambda*/) {
    const T s = E * std::sin(y[0] - y[1]), c = E * std::cos(y[0] - y[1]);
    const T fa = -s * y[3] * y[3] - wa * std::sin(y[0]), fb = s * y[2] * y[2] - wb * std::sin(y[1]);
    const T determinant = A * B - c * c;
    dy[0] = y[2];
    dy[1] = y[3];
    dy[2] = (B * fa - c * fb) / determinant;
    dy[3] = (A * fb - c * fa) / determinant;
  }
  static double energy(const double* y) {
    return 0.5 * (A * y[2] * y[2] + B * y[3] * y[3]) + E * std::cos(y[0] - y[1]) * y[2] * y[3] -
           wa * std::cos(y[0]) - wb * std::cos(y[1]);
  }

  static std::string file() { return "double_pendulum.json"; }
  static void change(Json&) {}
  static double time_scale() { return 1.0; }
  static void of_state(const courant::VectorXd& x, double* y) {
    const double c = E * std::cos(x[0] - x[1]), determinant = A * B - c * c;
    y[0] = x[0];
    y[1] = x[1];
    y[2] = (B * x[2] - c * x[3]) / determinant;
    y[3] = (A * x[3] - c * x[2]) / determinant;
  }
  static std::vector<Choice> choices() {
    return {{"Method 1", {{"type", "discretize-first"}}, 1000},
            {"Method 1, order 4", {{"type", "discretize-first"}, {"order", 4}}, 100},
            {"Method 1, order 6", {{"type", "discretize-first"}, {"order", 6}}, 40},
            {"Method 1, order 8", {{"type", "discretize-first"}, {"order", 8}}, 20}};
  }
};

}  // namespace work_precision
