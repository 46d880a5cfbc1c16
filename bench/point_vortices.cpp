// Four point vortices in the regular form, implicit midpoint, h = 1: the generic step against a
// hand-written one in the same process.
//
// The competitor is what a careful programmer would write for this one system: fixed-size Eigen,
// the gradient and Hessian of H by hand, full Newton from the last increment, convergence relative
// to the scale of the state.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <numbers>

#include "courant/integrators/discretize_first.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/poisson.hpp"

namespace {

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

constexpr double kStrength[4] = {1, 1, -1, -1};
constexpr double kStep = 1.0;
// One trajectory segment a benchmark iteration; it starts over so that the vortices stay where the
// paper's experiment has them.
constexpr int kSteps = 300;

Vector8 initial() {
  Vector8 q;
  q << -1, 1, -1, 1, 2, 2, -2, -2;
  return q;
}

// Velocity f(q) of equation (6) and its Jacobian.
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

// Solves d = h f(q + d/2) by full Newton; returns the number of iterations.
int newton_step(Vector8& q, Vector8& increment) {
  Vector8 f;
  Matrix8 J;
  const double scale = q.lpNorm<Eigen::Infinity>();
  for (int iteration = 1; iteration <= 50; ++iteration) {
    velocity(q + 0.5 * increment, f, J);
    const Matrix8 A = Matrix8::Identity() - 0.5 * kStep * J;
    const Vector8 change = A.partialPivLu().solve(kStep * f - increment);
    increment += change;
    if (change.lpNorm<Eigen::Infinity>() < 1e-13 * scale) {
      q += increment;
      return iteration;
    }
  }
  return 50;
}

void hand_written_newton(benchmark::State& state) {
  for (auto _ : state) {
    Vector8 q = initial();
    Vector8 increment = Vector8::Zero();
    for (int k = 0; k < kSteps; ++k) newton_step(q, increment);
    benchmark::DoNotOptimize(q);
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

std::unique_ptr<courant::DiscretizeFirst> generic(courant::Backend backend) {
  using namespace courant;
  const auto M = std::make_shared<Euclidean>(8);
  const auto D = std::make_shared<Poisson>(M, [](const ExprVector&) {
    ExprMatrix bivector = ExprMatrix::Zero(8, 8);
    for (Index i = 0; i < 4; ++i) {
      bivector(i, 4 + i) = -1.0 / kStrength[i];
      bivector(4 + i, i) = 1.0 / kStrength[i];
    }
    return bivector;
  });
  const auto E = std::make_shared<Hamiltonian>(M, [](const ExprVector& q, const Expr&) {
    Expr sum = 0;
    for (Index j = 0; j < 4; ++j)
      for (Index k = j + 1; k < 4; ++k)
        sum += kStrength[j] * kStrength[k] * log(square(q[j] - q[k]) + square(q[4 + j] - q[4 + k]));
    return sum / (4.0 * std::numbers::pi);
  });
  return std::make_unique<DiscretizeFirst>(std::make_shared<DiracSystem>(D, E),
                                           std::make_shared<Theta>(M),
                                           DiscretizeFirst::Options{.backend = backend});
}

void courant_step(benchmark::State& state, courant::Backend backend) {
  const auto method = generic(backend);
  for (auto _ : state) {
    const courant::State end = method->advance({.x = initial()}, kStep, kSteps);
    benchmark::DoNotOptimize(end.x.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

BENCHMARK(hand_written_newton);
BENCHMARK_CAPTURE(courant_step, native, courant::Backend::native);
BENCHMARK_CAPTURE(courant_step, interpreter, courant::Backend::interpreter);

}  // namespace

BENCHMARK_MAIN();
