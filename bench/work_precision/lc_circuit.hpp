// An LC circuit: 1 nF charged to 1 V and 1 µH.
#pragma once

#include <numbers>

#include "problem.hpp"

namespace work_precision {

// For the competitors q is the voltage in V, v the current times √(L/C), t is in units of √(LC):
// q' = v, v' = -q. Courant gets the network in SI units.
struct LcCircuit {
  static constexpr const char* name = "LC circuit";
  static constexpr int n = 1, m = 0;
  static constexpr bool separable = true;
  static constexpr std::array horizons{1000.0};
  static constexpr double capacitance = 1e-9, inductance = 1e-6;

  template <class T>
  static std::array<T, 2> start() {
    return {T(1), T(0)};
  }
  static double period() { return 2.0 * std::numbers::pi; }
  static StateOf<LcCircuit> exact(double /*periods*/) { return start<double>(); }

  template <class T>
  static void force(const T* q, T* f) {
    f[0] = -q[0];
  }
  template <class T>
  static void field(const T* y, T* dy, T* /*lambda*/) {
    dy[0] = y[1];
    dy[1] = -y[0];
  }
  static double energy(const double* y) { return 0.5 * (y[0] * y[0] + y[1] * y[1]); }

  static std::string file() { return "network_rlc.json"; }
  static void change(Json& document) {
    document["system"] = {
        {"type", "network"},
        {"nodes", {"0", "a"}},
        {"elements",
         {{{"type", "inductor"}, {"name", "L1"}, {"from", "a"}, {"to", "0"}, {"value", inductance}},
          {{"type", "capacitor"},
           {"name", "C1"},
           {"from", "a"},
           {"to", "0"},
           {"value", capacitance}}}}};
    document["initial"] = {{"q_C1", capacitance}, {"phi_L1", 0}};
  }
  static double time_scale() { return std::sqrt(inductance * capacitance); }
  static void of_state(const courant::VectorXd& x, double* y) {
    // Elements in the order of the document; the sign of the flux is that of its direction.
    y[0] = x[1] / capacitance;
    y[1] = -x[0] / std::sqrt(inductance * capacitance);
  }
  static std::vector<Choice> choices() {
    return with_verlet({{"Method 1", {{"type", "discretize-first"}}, 250},
                        {"Method 1, order 4", {{"type", "discretize-first"}, {"order", 4}}, 16},
                        {"Method 1, order 6", {{"type", "discretize-first"}, {"order", 6}}, 8},
                        {"Method 1, order 8", {{"type", "discretize-first"}, {"order", 8}}, 6},
                        {"discrete gradient", {{"type", "discrete-gradient"}}, 250}},
                       "discretize-first", "Verlet");
  }
};

}  // namespace work_precision
