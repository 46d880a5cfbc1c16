// Constrained mechanics by Method 2, implicit midpoint and orthogonal projector: generic steps, which know of
// the equations and find what they imply, against hand-written ones in the same process. Two systems:
//
//   pendulum    in Cartesian coordinates (x, y, v, w): R⁴, a multiplier
//   heavy top   as a matrix R with momenta P = R' J and RᵀR = 1: R¹⁸, six multipliers
//
// By hand is what a careful programmer would write: the hidden constraints and the multipliers worked out on
// paper, fixed-size Eigen, derivatives by hand, full Newton from the last increment, convergence
// relative to the scale of the state. One step is
//
//   x̄ - h/2 f(x̄) = x₀ + W(x₀) μ,   g(x̄) = 0,       x̄ + h/2 f(x̄) = x₁ + W(x₁) ν,   g(x₁) = 0,
//
// where the columns of W are the gradients of g, which are all the constraints.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/manifolds/euclidean.hpp"

namespace {

constexpr int kSteps = 300;

// (x, y, v, w), of length and mass 1: T = (v² + w² - y) / (x² + y²).
struct Pendulum {
  static constexpr int n = 4, d = 2;
  static constexpr double h = 0.01;
  using Point = Eigen::Matrix<double, n, 1>;
  using Matrix = Eigen::Matrix<double, n, n>;
  using Directions = Eigen::Matrix<double, n, d>;
  using Multipliers = Eigen::Matrix<double, d, 1>;

  static Point start() { return {std::sin(2.0), -std::cos(2.0), 0.0, 0.0}; }

  static void velocity(const Point& at, Point& f, Matrix& J) {
    const double x = at[0], y = at[1], v = at[2], w = at[3];
    const double r2 = x * x + y * y, T = (v * v + w * w - y) / r2;
    f << v, w, -T * x, -T * y - 1.0;
    const double of_T[4] = {-2.0 * x * T / r2, -(1.0 + 2.0 * y * T) / r2, 2.0 * v / r2,
                            2.0 * w / r2};
    J.setZero();
    J(0, 2) = J(1, 3) = 1.0;
    for (int j = 0; j < 4; ++j) {
      J(2, j) = -x * of_T[j];
      J(3, j) = -y * of_T[j];
    }
    J(2, 0) -= T;
    J(3, 1) -= T;
  }

  // g = ((x² + y² - 1)/2, x v + y w)
  static Multipliers constraint(const Point& x) {
    return {0.5 * (x[0] * x[0] + x[1] * x[1] - 1.0), x[0] * x[2] + x[1] * x[3]};
  }
  static Directions gradients(const Point& x) {
    Directions W;
    W << x[0], x[2], x[1], x[3], 0.0, x[0], 0.0, x[1];
    return W;
  }
  // The derivative of W(x) ν by x.
  static Matrix turned(const Multipliers& nu) {
    Matrix result = Matrix::Zero();
    result.diagonal() << nu[0], nu[0], 0.0, 0.0;
    result(0, 2) = result(1, 3) = result(2, 0) = result(3, 1) = nu[1];
    return result;
  }
};

// (R, P), row by row, with V = P J⁻¹ for the velocity of R, under the potential w·(Rᵀe₃):
//
//   V' J = -R S - e₃ wᵀ,   G S J⁻¹ + J⁻¹ S G = 2 VᵀV - r wᵀJ⁻¹ - J⁻¹ w rᵀ,   G = RᵀR,  r = Rᵀe₃
//
// with the stresses S = Sᵀ.
struct HeavyTop {
  static constexpr int n = 18, d = 12;
  static constexpr double h = 0.0025;
  using Point = Eigen::Matrix<double, n, 1>;
  using Matrix = Eigen::Matrix<double, n, n>;
  using Directions = Eigen::Matrix<double, n, d>;
  using Multipliers = Eigen::Matrix<double, d, 1>;
  using Three = Eigen::Matrix3d;
  using Six = Eigen::Matrix<double, 6, 1>;
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

  static constexpr double J[3] = {0.4, 0.2, 0.8};  // of moments of inertia 1, 1.2 and 0.6
  static constexpr double w[3] = {0.1, 0.2, 1.0};
  static constexpr int place[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};

  static Three inverse_J() { return Eigen::Vector3d(1 / J[0], 1 / J[1], 1 / J[2]).asDiagonal(); }
  static Rows R_of(const Point& x) { return Eigen::Map<const Rows>(x.data()); }
  static Rows P_of(const Point& x) { return Eigen::Map<const Rows>(x.data() + 9); }

  static Point start() {
    const double a = 0.4, b = 0.7, c = 0.3;
    Three z, x, zz;
    z << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
    x << 1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b);
    zz << std::cos(c), -std::sin(c), 0, std::sin(c), std::cos(c), 0, 0, 0, 1;
    const Rows R = z * x * zz;
    Three turn;  // the angular velocity (0.3, -0.2 / 1.2, 2 / 0.6) in the body
    turn << 0, -2 / 0.6, -0.2 / 1.2, 2 / 0.6, 0, -0.3, 0.2 / 1.2, 0.3, 0;
    const Rows P = R * turn * inverse_J().inverse();
    Point result;
    result << Eigen::Map<const Eigen::Matrix<double, 9, 1>>(R.data()),
        Eigen::Map<const Eigen::Matrix<double, 9, 1>>(P.data());
    return result;
  }

  static Six entries(const Three& symmetric) {
    Six result;
    for (int k = 0; k < 6; ++k) result[k] = symmetric(place[k][0], place[k][1]);
    return result;
  }
  static Three symmetric(const Six& entries) {
    Three result;
    for (int k = 0; k < 6; ++k)
      result(place[k][0], place[k][1]) = result(place[k][1], place[k][0]) = entries[k];
    return result;
  }

  static void velocity(const Point& x, Point& f, Matrix& by_x) {
    const Three K = inverse_J(), R = R_of(x), V = P_of(x) * K, G = R.transpose() * R;
    const Eigen::Vector3d r = R.row(2), Kw(w[0] / J[0], w[1] / J[1], w[2] / J[2]);
    const auto weighed = [&](const Three& g, const Three& s) -> Three {
      const Three half = g * s * K;
      return half + half.transpose();
    };
    const auto right = [&](const Three& v, const Three& dv, const Eigen::Vector3d& of_r) -> Three {
      const Three twice = v.transpose() * dv, bent = of_r * Kw.transpose();
      return twice + twice.transpose() - bent - bent.transpose();
    };
    Eigen::Matrix<double, 6, 6> A;
    for (int k = 0; k < 6; ++k) A.col(k) = entries(weighed(G, symmetric(Six::Unit(k))));
    const Eigen::PartialPivLU<Eigen::Matrix<double, 6, 6>> lu(A);
    const Three S = symmetric(lu.solve(entries(right(V, V, r))));
    const auto put = [](const Three& velocity, const Three& force, auto&& column) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          column[3 * i + j] = velocity(i, j);
          column[9 + 3 * i + j] = force(i, j);
        }
    };
    Three force = -R * S;
    force.row(2) -= Eigen::Map<const Eigen::RowVector3d>(w);
    put(V, force, f);
    Eigen::Matrix<double, 6, 18> rates;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const Three unit = Eigen::Vector3d::Unit(i) * Eigen::RowVector3d::Unit(j);
        const Three dG = unit.transpose() * R;
        const Eigen::Vector3d dr = (i == 2 ? 1.0 : 0.0) * Eigen::Vector3d::Unit(j);
        rates.col(3 * i + j) =
            entries(right(V, Three::Zero(), dr) - weighed(dG + dG.transpose(), S));
        rates.col(9 + 3 * i + j) = entries(2.0 * right(V, unit * K, Eigen::Vector3d::Zero()));
      }
    const Eigen::Matrix<double, 6, 18> of_S = lu.solve(rates);
    for (int k = 0; k < 18; ++k) {
      Three dR = Three::Zero(), dP = Three::Zero();
      (k < 9 ? dR : dP)((k % 9) / 3, k % 3) = 1.0;
      put(dP * K, -dR * S - R * symmetric(of_S.col(k)), by_x.col(k));
    }
  }

  // g = ½ (RᵀR - 1)_ij and ½ (RᵀV + VᵀR)_ij for i ≤ j.
  static Multipliers constraint(const Point& x) {
    const Three R = R_of(x), V = P_of(x) * inverse_J(), RV = R.transpose() * V;
    Multipliers g;
    g << entries(0.5 * (R.transpose() * R - Three::Identity())),
        entries(0.5 * (RV + RV.transpose()));
    return g;
  }
  static Three symmetrized(int k) {
    Three N = Three::Zero();
    N(place[k][0], place[k][1]) += 0.5;
    N(place[k][1], place[k][0]) += 0.5;
    return N;
  }
  // ½ ⟨N, RᵀR⟩ has the gradient R N, ⟨N, RᵀV⟩ the gradients V N by R and R N J⁻¹ by P.
  static Directions gradients(const Point& x) {
    const Three K = inverse_J(), R = R_of(x), V = P_of(x) * K;
    Directions W;
    W.setZero();
    for (int k = 0; k < 6; ++k) {
      const Three N = symmetrized(k), RN = R * N, VN = V * N, RNK = RN * K;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          W(3 * i + j, k) = RN(i, j);
          W(3 * i + j, 6 + k) = VN(i, j);
          W(9 + 3 * i + j, 6 + k) = RNK(i, j);
        }
    }
    return W;
  }
  static Matrix turned(const Multipliers& nu) {
    Three first = Three::Zero(), second = first;
    for (int k = 0; k < 6; ++k) {
      first += nu[k] * symmetrized(k);
      second += nu[6 + k] * symmetrized(k);
    }
    const Three K = inverse_J();
    Matrix result = Matrix::Zero();
    for (int i = 0; i < 3; ++i) {
      result.block<3, 3>(3 * i, 3 * i) = first;
      result.block<3, 3>(3 * i, 9 + 3 * i) = second * K;
      result.block<3, 3>(9 + 3 * i, 3 * i) = K * second;
    }
    return result;
  }
};

template <class System>
struct Motion {
  typename System::Point x = System::start(), increment = System::Point::Zero(),
                         correction = System::Point::Zero();
  typename System::Multipliers mu = System::Multipliers::Zero(), nu = System::Multipliers::Zero();
};

template <class System>
void step_by_hand(Motion<System>& motion) {
  constexpr int n = System::n, d = System::d;
  constexpr double h = System::h;
  using Unknowns = Eigen::Matrix<double, n + d, 1>;
  auto& [x, increment, correction, mu, nu] = motion;
  typename System::Point f;
  typename System::Matrix J;
  Eigen::Matrix<double, n + d, n + d> A;
  A.setZero();
  Unknowns residual;
  const auto is_converged = [](const Unknowns& change) {
    return change.template lpNorm<Eigen::Infinity>() < 1e-13;
  };
  const auto W = System::gradients(x);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const typename System::Point middle = x + increment;
    System::velocity(middle, f, J);
    residual << increment - 0.5 * h * f - W * mu, System::constraint(middle);
    A.template topLeftCorner<n, n>() = System::Matrix::Identity() - 0.5 * h * J;
    A.template topRightCorner<n, d>() = -W;
    A.template bottomLeftCorner<d, n>() = System::gradients(middle).transpose();
    const Unknowns change = A.partialPivLu().solve(residual);
    increment -= change.template head<n>();
    mu -= change.template tail<d>();
    if (is_converged(change)) break;
  }
  System::velocity(x + increment, f, J);
  const typename System::Point near = x + increment + 0.5 * h * f;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const typename System::Point end = near + correction;
    const auto V = System::gradients(end);
    residual << correction + V * nu, System::constraint(end);
    A.template topLeftCorner<n, n>() = System::Matrix::Identity() + System::turned(nu);
    A.template topRightCorner<n, d>() = V;
    A.template bottomLeftCorner<d, n>() = V.transpose();
    const Unknowns change = A.partialPivLu().solve(residual);
    correction -= change.template head<n>();
    nu -= change.template tail<d>();
    if (is_converged(change)) break;
  }
  x = near + correction;
}

template <class System>
void by_hand(benchmark::State& state) {
  for (auto _ : state) {
    Motion<System> motion;
    for (int k = 0; k < kSteps; ++k) step_by_hand(motion);
    benchmark::DoNotOptimize(motion.x.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

// What the generic method is told.
class CartesianPendulum final : public courant::ImplicitSystem {
 public:
  CartesianPendulum() : ImplicitSystem(std::make_shared<courant::Euclidean>(4), 1, 5, {}) {}

 private:
  courant::ExprVector do_residual(const courant::ExprVector& x, const courant::ExprVector& v,
                                  const courant::ExprVector& z,
                                  const courant::Expr&) const override {
    using courant::square;
    courant::ExprVector F(5);
    F << v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 1.0,
        square(x[0]) + square(x[1]) - 1.0;
    return F;
  }
};

class ConstrainedTop final : public courant::ImplicitSystem {
 public:
  ConstrainedTop() : ImplicitSystem(std::make_shared<courant::Euclidean>(18), 6, 24, {}) {}

 private:
  courant::ExprVector do_residual(const courant::ExprVector& x, const courant::ExprVector& v,
                                  const courant::ExprVector& z,
                                  const courant::Expr&) const override {
    using courant::Expr;
    constexpr int entry[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    courant::ExprVector F(24);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        F[3 * i + j] = v[3 * i + j] - x[9 + 3 * i + j] / Expr(HeavyTop::J[j]);
        Expr force = v[9 + 3 * i + j];
        if (i == 2) force += HeavyTop::w[j];
        for (int k = 0; k < 3; ++k) force += x[3 * i + k] * z[entry[k][j]];
        F[9 + 3 * i + j] = force;
      }
    for (int k = 0; k < 6; ++k) {
      const auto [a, b] = std::array{HeavyTop::place[k][0], HeavyTop::place[k][1]};
      Expr product = x[a] * x[b] + x[3 + a] * x[3 + b] + x[6 + a] * x[6 + b];
      F[18 + k] = a == b ? product - 1.0 : product;
    }
    return F;
  }
};

template <class System, class ByHand>
courant::ConstrainFirst method(courant::Backend backend) {
  using namespace courant;
  const auto system = std::make_shared<System>();
  return ConstrainFirst(system, ConstraintAlgorithm().run(system, {.x = VectorXd(ByHand::start())}),
                        std::make_shared<Theta>(system->manifold()),
                        std::make_shared<OrthogonalProjector>(), {.backend = backend});
}

template <class System, class ByHand>
void generic(benchmark::State& state, courant::Backend backend) {
  const courant::ConstrainFirst steps = method<System, ByHand>(backend);
  for (auto _ : state) {
    const courant::State end =
        steps.advance({.x = Eigen::VectorXd(ByHand::start())}, ByHand::h, kSteps);
    benchmark::DoNotOptimize(end.x.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

void pendulum(benchmark::State& state, courant::Backend backend) {
  generic<CartesianPendulum, Pendulum>(state, backend);
}
void heavy_top(benchmark::State& state, courant::Backend backend) {
  generic<ConstrainedTop, HeavyTop>(state, backend);
}

BENCHMARK(by_hand<Pendulum>)->Name("pendulum_by_hand");
BENCHMARK_CAPTURE(pendulum, native, courant::Backend::native);
BENCHMARK_CAPTURE(pendulum, interpreter, courant::Backend::interpreter);
BENCHMARK(by_hand<HeavyTop>)->Name("heavy_top_by_hand");
BENCHMARK_CAPTURE(heavy_top, native, courant::Backend::native);
BENCHMARK_CAPTURE(heavy_top, interpreter, courant::Backend::interpreter);

// The schemes are the same: both routes end in the same place.
template <class System, class ByHand>
bool agree() {
  Motion<ByHand> motion;
  for (int k = 0; k < kSteps; ++k) step_by_hand(motion);
  const Eigen::VectorXd x = method<System, ByHand>(courant::Backend::interpreter)
                                .advance({.x = Eigen::VectorXd(ByHand::start())}, ByHand::h, kSteps)
                                .x;
  const double distance = (x - motion.x).norm();
  if (distance < 1e-10) return true;
  std::fprintf(stderr, "bench_constrained: the two routes end %g apart.\n", distance);
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (!agree<CartesianPendulum, Pendulum>() || !agree<ConstrainedTop, HeavyTop>()) return 1;
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
