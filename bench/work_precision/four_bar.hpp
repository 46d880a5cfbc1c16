// The four-bar linkage of experiments/four_bar.json, released at rest.
#pragma once

#include "problem.hpp"
#include "reference.hpp"

namespace work_precision {

// q = (a, b, c), the angles of crank, coupler and rocker.
struct FourBar {
  static constexpr const char* name = "four-bar linkage";
  static constexpr int n = 3, m = 2;
  static constexpr bool separable = false;
  static constexpr std::array horizons{1000.0, 10000.0};

  // Lengths; M_aa, M_ab/cos(a - b), M_bb, M_cc; the weights of sin a, sin b, sin c in the potential.
  static constexpr double l0 = 0.2, l1 = 0.5, l2 = 0.4, l3 = 0.55;
  static constexpr double m0 = 0.8, m1 = 2.0, m2 = 1.6, gravity = 9.81;
  static constexpr double A = (m0 / 3 + m1) * l0 * l0, E = m1 * l0 * l1 / 2, B = m1 * l1 * l1 / 3,
                          C = m2 * l2 * l2 / 3;
  static constexpr double wa = gravity * (m0 / 2 + m1) * l0, wb = gravity * m1 * l1 / 2,
                          wc = gravity * m2 * l2 / 2;

  // Sines and cosines of the angles, and what is made of them.
  template <class T>
  struct Geometry {
    explicit Geometry(const T* q) {
      using std::cos;
      using std::sin;
      sa = sin(q[0]), ca = cos(q[0]), sb = sin(q[1]), cb = cos(q[1]), sc = sin(q[2]),
      cc = cos(q[2]);
      s = E * (sa * cb - ca * sb);
      c = E * (ca * cb + sa * sb);
      gx[0] = -l0 * sa, gx[1] = -l1 * sb, gx[2] = l2 * sc;
      gy[0] = l0 * ca, gy[1] = l1 * cb, gy[2] = -l2 * cc;
    }
    T sa, ca, sb, cb, sc, cc;
    T s, c;  // E sin(a - b), E cos(a - b)
    // The rows of G.
    T gx[3];
    T gy[3];
    void forces(const T* v, T* f) const {
      f[0] = -s * v[1] * v[1] - wa * ca;
      f[1] = s * v[0] * v[0] - wb * cb;
      f[2] = -wc * cc;
    }
    // M⁻¹ f
    void solve(const T* f, T* a) const {
      const T determinant = A * B - c * c;
      a[0] = (B * f[0] - c * f[1]) / determinant;
      a[1] = (A * f[1] - c * f[0]) / determinant;
      a[2] = f[2] / C;
    }
  };

  // a = 1; b and c close the loop.
  template <class T>
  static std::array<T, 6> start() {
    T q[3] = {T(1), T(0.4L), T(1.2L)};
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Geometry<T> at(q);
      const T x = l0 * at.ca + l1 * at.cb - l2 * at.cc - l3,
              y = l0 * at.sa + l1 * at.sb - l2 * at.sc;
      const T determinant = at.gx[1] * at.gy[2] - at.gx[2] * at.gy[1];
      q[1] -= (at.gy[2] * x - at.gx[2] * y) / determinant;
      q[2] -= (at.gx[1] * y - at.gy[1] * x) / determinant;
    }
    return {q[0], q[1], q[2], T(0), T(0), T(0)};
  }
  static double period() {
    static const double found = static_cast<double>(period_from_rest<FourBar>(1e-3L));
    return found;
  }
  static StateOf<FourBar> exact(double /*periods*/) { return start<double>(); }

  template <class T>
  static void field(const T* y, T* dy, T* lambda) {
    const Geometry<T> at(y);
    const T* v = y + 3;
    T f[3], a[3], px[3], py[3];
    at.forces(v, f);
    at.solve(f, a);
    at.solve(at.gx, px);
    at.solve(at.gy, py);
    const T v0 = v[0] * v[0], v1 = v[1] * v[1], v2 = v[2] * v[2];
    T rx = l0 * at.ca * v0 + l1 * at.cb * v1 - l2 * at.cc * v2;
    T ry = l0 * at.sa * v0 + l1 * at.sb * v1 - l2 * at.sc * v2;
    T xx = 0, xy = 0, yy = 0;
    for (int i = 0; i < 3; ++i) {
      rx -= at.gx[i] * a[i];
      ry -= at.gy[i] * a[i];
      xx += at.gx[i] * px[i];
      xy += at.gx[i] * py[i];
      yy += at.gy[i] * py[i];
    }
    const T determinant = xx * yy - xy * xy;
    lambda[0] = (yy * rx - xy * ry) / determinant;
    lambda[1] = (xx * ry - xy * rx) / determinant;
    for (int i = 0; i < 3; ++i) {
      dy[i] = v[i];
      dy[3 + i] = a[i] + px[i] * lambda[0] + py[i] * lambda[1];
    }
  }
  static double energy(const double* y) {
    const Geometry<double> at(y);
    const double* v = y + 3;
    return 0.5 * (A * v[0] * v[0] + B * v[1] * v[1] + C * v[2] * v[2]) + at.c * v[0] * v[1] +
           wa * at.sa + wb * at.sb + wc * at.sc;
  }
  static double violation(const double* y) {
    double r[4];
    constraints(Geometry<double>(y), y + 3, r);
    return std::max({std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2]), std::fabs(r[3])});
  }
  template <class T>
  static void residual(const T* y, const T* dy, T* r) {
    const Geometry<T> at(y);
    const T *v = y + 3, *mu = y + 6, *lambda = y + 8, *dv = dy + 3;
    T f[3];
    at.forces(v, f);
    const T inertia[3] = {A * dv[0] + at.c * dv[1], at.c * dv[0] + B * dv[1], C * dv[2]};
    for (int i = 0; i < 3; ++i) {
      r[i] = dy[i] - v[i] - at.gx[i] * mu[0] - at.gy[i] * mu[1];
      r[3 + i] = inertia[i] - f[i] - at.gx[i] * lambda[0] - at.gy[i] * lambda[1];
    }
    constraints(at, v, r + 6);
  }

  static std::string file() { return "four_bar.json"; }
  static void change(Json&) {}
  static double time_scale() { return 1.0; }
  static void of_state(const courant::VectorXd& x, double* y) {
    std::copy_n(x.data(), 3, y);
    Geometry<double>(y).solve(x.data() + 3, y + 3);
  }
  static std::vector<Choice> choices() {
    return {{"Method 2", {{"type", "constrain-first"}}, 500},
            {"Method 2, order 4", {{"type", "constrain-first"}, {"order", 4}}, 256},
            {"Method 2, order 6", {{"type", "constrain-first"}, {"order", 6}}, 192},
            {"Method 2, order 8", {{"type", "constrain-first"}, {"order", 8}}, 192}};
  }

 private:
  // g and G v
  template <class T>
  static void constraints(const Geometry<T>& at, const T* v, T* r) {
    r[0] = l0 * at.ca + l1 * at.cb - l2 * at.cc - l3;
    r[1] = l0 * at.sa + l1 * at.sb - l2 * at.sc;
    r[2] = at.gx[0] * v[0] + at.gx[1] * v[1] + at.gx[2] * v[2];
    r[3] = at.gy[0] * v[0] + at.gy[1] * v[1] + at.gy[2] * v[2];
  }
};

}  // namespace work_precision
