// Kepler's problem, eccentricity 0.6, from the perihelion.
#pragma once

#include <numbers>

#include "problem.hpp"

namespace work_precision {

// H = |v|²/2 - 1/|q|.
struct Kepler {
  static constexpr const char* name = "Kepler's problem, e = 0.6";
  static constexpr int n = 2, m = 0;
  static constexpr bool separable = true;
  static constexpr std::array horizons{1000.0};

  template <class T>
  static std::array<T, 4> start() {
    return {T(0.4), T(0), T(0), T(2)};
  }
  static double period() { return 2.0 * std::numbers::pi; }
  static StateOf<Kepler> exact(double /*periods*/) { return start<double>(); }

  template <class T>
  static void force(const T* q, T* f) {
    const T square = q[0] * q[0] + q[1] * q[1], cube = square * std::sqrt(square);
    f[0] = -q[0] / cube;
    f[1] = -q[1] / cube;
  }
  template <class T>
  static void field(const T* y, T* dy, T* /*lambda*/) {
    dy[0] = y[2];
    dy[1] = y[3];
    force(y, dy + 2);
  }
  static double energy(const double* y) {
    return 0.5 * (y[2] * y[2] + y[3] * y[3]) - 1.0 / std::hypot(y[0], y[1]);
  }

  static std::string file() { return "kepler_order_8.json"; }
  static void change(Json& experiment) {
    for (const char* name : {"m", "k", "a"}) experiment["system"]["parameters"][name] = 1;
  }
  static double time_scale() { return 1.0; }
  static void of_state(const courant::VectorXd& x, double* y) { std::copy_n(x.data(), 4, y); }
  static std::vector<Choice> choices() {
    return with_verlet({{"Method 1", {{"type", "discretize-first"}}, 1000},
                        {"Method 1, order 4", {{"type", "discretize-first"}, {"order", 4}}, 100},
                        {"Method 1, order 6", {{"type", "discretize-first"}, {"order", 6}}, 50},
                        {"Method 1, order 8", {{"type", "discretize-first"}, {"order", 8}}, 25}},
                       "discretize-first", "Verlet");
  }
};

}  // namespace work_precision
