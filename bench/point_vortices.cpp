// Four point vortices, implicit midpoint, h = 1: generic steps against hand-written ones in the same
// process. By hand is what a careful programmer would write for this one system in its regular form on
// R⁸, q' = f(q), three times: fixed-size Eigen, gradient and Hessian of H by hand, convergence relative
// to the scale of the state.
//
//   Newton             a factorisation in every iteration, from the last increment
//   simplified Newton  the inverse of an earlier matrix as long as it contracts, from an extrapolation
//   fixed point        no matrix at all, from an extrapolation
//
// Generic are the regular form (R⁸, a bivector) and the singular Lagrangian on T*R⁸ by Methods 1 and 2.
#include "courant/systems/point_vortices.hpp"

#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"

namespace {

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

constexpr double kStrength[4] = {1, 1, -1, -1};
constexpr double kStep = 1.0;
// One trajectory segment a benchmark iteration, as in bench/manifold_step.cpp. What a method prepares at its start, some
// 45 to 140 µs, is a hundredth of it.
constexpr int kSteps = 10'000;
// What ways to the same point differ by after it.
constexpr double kSamePoint = 1e-6;

Vector8 initial() {
  Vector8 q;
  q << -1, 1, -1, 1, 2, 2, -2, -2;
  return q;
}

// Velocity f(q) of equation (6): each pair once.
void velocity(const Vector8& q, Vector8& f) {
  f.setZero();
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const double dx = q[i] - q[j];
      const double dy = q[4 + i] - q[4 + j];
      const double c = 1.0 / (2.0 * std::numbers::pi * (dx * dx + dy * dy));
      f[i] -= kStrength[j] * c * dy;
      f[j] += kStrength[i] * c * dy;
      f[4 + i] += kStrength[j] * c * dx;
      f[4 + j] -= kStrength[i] * c * dx;
    }
  }
}

// The same and its Jacobian.
void velocity(const Vector8& q, Vector8& f, Matrix8& J) {
  f.setZero();
  J.setZero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (i == j) continue;
      const double dx = q[i] - q[j];
      const double dy = q[4 + i] - q[4 + j];
      const double r2 = dx * dx + dy * dy;
      const double c = kStrength[j] / (2.0 * std::numbers::pi * r2);
      f[i] -= c * dy;
      f[4 + i] += c * dx;
      const double cross = 2.0 * c * dx * dy / r2;
      const double straight = c * (dx * dx - dy * dy) / r2;
      J(i, i) += cross;
      J(i, j) -= cross;
      J(i, 4 + i) -= straight;
      J(i, 4 + j) += straight;
      J(4 + i, i) -= straight;
      J(4 + i, j) += straight;
      J(4 + i, 4 + i) -= cross;
      J(4 + i, 4 + j) += cross;
    }
  }
}

// The increments of the last steps, extrapolated by a polynomial of degree 4.
struct Extrapolation {
  std::array<Vector8, 5> last;  // the newest first
  int known = 0;

  Vector8 next() const {
    static constexpr double weights[6][5] = {
        {}, {1}, {2, -1}, {3, -3, 1}, {4, -6, 4, -1}, {5, -10, 10, -5, 1}};
    Vector8 result = Vector8::Zero();
    for (int i = 0; i < known; ++i) result += weights[known][i] * last[i];
    return result;
  }
  void add(const Vector8& increment) {
    for (int i = 4; i > 0; --i) last[i] = last[i - 1];
    last[0] = increment;
    if (known < 5) ++known;
  }
};

struct Vortices {
  Vector8 q = initial(), increment = Vector8::Zero();
  Extrapolation extrapolation = {};
  Matrix8 inverse = {};
  bool has_inverse = false;
};

// d = h f(q + d/2) by full Newton.
void newton_step(Vortices& vortices) {
  auto& [q, increment, extrapolation, inverse, has_inverse] = vortices;
  Vector8 f;
  Matrix8 J;
  const double scale = q.lpNorm<Eigen::Infinity>();
  for (int iteration = 0; iteration < 50; ++iteration) {
    velocity(q + 0.5 * increment, f, J);
    const Matrix8 A = Matrix8::Identity() - 0.5 * kStep * J;
    const Vector8 change = A.partialPivLu().solve(kStep * f - increment);
    increment += change;
    if (change.lpNorm<Eigen::Infinity>() < 1e-13 * scale) break;
  }
  q += increment;
}

// Iterates that move by less than this, or no longer become shorter when they are as short as round-off,
// are at the solution.
struct Convergence {
  double scale, before = 0.0;
  bool operator()(const Vector8& change) {
    const double moved = change.lpNorm<Eigen::Infinity>() / scale;
    const bool ends = moved * moved / before < 1e-17 || (moved < 1e-14 && moved >= 0.5 * before);
    before = moved;
    return ends;
  }
};

void simplified_newton_step(Vortices& vortices) {
  auto& [q, increment, extrapolation, inverse, has_inverse] = vortices;
  Vector8 f;
  increment = extrapolation.next();
  for (bool fresh = false;; fresh = true) {
    if (!has_inverse || fresh) {
      Matrix8 J;
      velocity(q + 0.5 * increment, f, J);
      inverse = (Matrix8::Identity() - 0.5 * kStep * J).inverse();
      has_inverse = true;
    }
    Convergence converged{q.lpNorm<Eigen::Infinity>()};
    int iteration = 0;
    for (; iteration < 10; ++iteration) {
      velocity(q + 0.5 * increment, f);
      const Vector8 change = inverse * (kStep * f - increment);
      increment += change;
      if (converged(change)) break;
    }
    if (iteration < 10) break;
  }
  extrapolation.add(increment);
  q += increment;
}

void fixed_point_step(Vortices& vortices) {
  auto& [q, increment, extrapolation, inverse, has_inverse] = vortices;
  Vector8 f;
  increment = extrapolation.next();
  Convergence converged{q.lpNorm<Eigen::Infinity>()};
  for (int iteration = 0; iteration < 50; ++iteration) {
    velocity(q + 0.5 * increment, f);
    const Vector8 change = kStep * f - increment;
    increment += change;
    if (converged(change)) break;
  }
  extrapolation.add(increment);
  q += increment;
}

template <void step(Vortices&)>
Vector8 end_by_hand() {
  Vortices vortices;
  for (int k = 0; k < kSteps; ++k) step(vortices);
  return vortices.q;
}

template <void step(Vortices&)>
void by_hand(benchmark::State& state) {
  for (auto _ : state) {
    const Vector8 end = end_by_hand<step>();
    benchmark::DoNotOptimize(end.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

courant::PointVortices vortices() {
  return courant::PointVortices(
      Eigen::Vector4d(kStrength[0], kStrength[1], kStrength[2], kStrength[3]));
}

using Method = std::shared_ptr<const courant::Integrator>;

Method bivector(courant::Backend backend) {
  using namespace courant;
  const auto system = vortices().hamiltonian_form();
  return std::make_shared<DiscretizeFirst>(system, std::make_shared<Theta>(system->manifold()),
                                           DiscretizeFirst::Options{.backend = backend});
}

std::shared_ptr<const courant::CotangentBundle> phase_space(const courant::ImplicitSystem& system) {
  return std::dynamic_pointer_cast<const courant::CotangentBundle>(system.manifold());
}

std::shared_ptr<const courant::DiscretizationMap> lifted(const courant::ImplicitSystem& system) {
  using namespace courant;
  const auto bundle = phase_space(system);
  return std::make_shared<CotangentLift>(bundle, std::make_shared<Theta>(bundle->base()));
}

Eigen::VectorXd on_constraint() {
  const Vector8 q = initial();
  Eigen::VectorXd x(16);
  for (int i = 0; i < 4; ++i) {
    x[8 + i] = -0.5 * kStrength[i] * q[4 + i];
    x[12 + i] = 0.5 * kStrength[i] * q[i];
  }
  x.head(8) = q;
  return x;
}

Method method_1(courant::Backend backend) {
  using namespace courant;
  const auto system = vortices().lagrangian_form();
  return std::make_shared<DiscretizeFirst>(system, lifted(*system),
                                           DiscretizeFirst::Options{.backend = backend});
}

Method method_2(courant::Backend backend) {
  using namespace courant;
  const auto system = vortices().lagrangian_form();
  return std::make_shared<ConstrainFirst>(
      system, ConstraintAlgorithm().run(system, {.x = on_constraint()}), lifted(*system),
      std::make_shared<MomentumProjector>(phase_space(*system)),
      ConstrainFirst::Options{.backend = backend});
}

Eigen::VectorXd start_on(const courant::Integrator& method) {
  if (method.system()->manifold()->dimension() == 8) return initial();
  return on_constraint();
}

void generic(benchmark::State& state, Method make(courant::Backend), courant::Backend backend) {
  const Method method = make(backend);
  for (auto _ : state) {
    const courant::State end = method->advance({.x = start_on(*method)}, kStep, kSteps);
    benchmark::DoNotOptimize(end.x.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

BENCHMARK(by_hand<newton_step>)->Name("newton_by_hand");
BENCHMARK(by_hand<simplified_newton_step>)->Name("simplified_newton_by_hand");
BENCHMARK(by_hand<fixed_point_step>)->Name("fixed_point_by_hand");
BENCHMARK_CAPTURE(generic, bivector_native, bivector, courant::Backend::native);
BENCHMARK_CAPTURE(generic, bivector_interpreter, bivector, courant::Backend::interpreter);
BENCHMARK_CAPTURE(generic, method_1_native, method_1, courant::Backend::native);
BENCHMARK_CAPTURE(generic, method_2_native, method_2, courant::Backend::native);

// The schemes are the same: all routes but Method 1, which keeps other momenta, end in the same place.
bool agree() {
  const Vector8 q = end_by_hand<newton_step>();
  const auto is_same = [&](const Vector8& other) { return (other - q).norm() < kSamePoint; };
  const auto end = [&](Method make(courant::Backend)) {
    const Method method = make(courant::Backend::interpreter);
    return Vector8(method->advance({.x = start_on(*method)}, kStep, kSteps).x.head(8));
  };
  return is_same(end_by_hand<simplified_newton_step>()) &&
         is_same(end_by_hand<fixed_point_step>()) && is_same(end(bivector)) &&
         is_same(end(method_2));
}

}  // namespace

int main(int argc, char** argv) {
  if (!agree()) {
    std::fputs("bench_point_vortices: the routes do not take the same steps.\n", stderr);
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
