// One step on S² and on T*SO(3) next to the same scheme written by hand: the reduced free rigid
// body with the chordal map (equation of Example 5.6), and the free rigid body with the cotangent
// lift of the Cayley midpoint. By hand means Newton's method on three unknowns with matrices and
// vectors of fixed size, derivatives by hand and a factorisation in every iteration.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <cmath>

#include "courant/integrators/maps/cayley_midpoint.hpp"
#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/rotation.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/poisson.hpp"

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSteps = 10000;
constexpr double kStep = 0.05;
constexpr double kTolerance = 1e-15;

const Vector3d kInverse(1.0, 1.0 / 2.0, 1.0 / 3.0);  // I⁻¹
const Vector3d kStart(std::cos(1.1), 0.0, std::sin(1.1));

Matrix3d hat(const Vector3d& v) {
  Matrix3d result;
  result << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
  return result;
}

// x₁ - x₀ = h s/2 × I⁻¹ s/‖s‖, s = x₀ + x₁, solved for s from `sum`.
void sphere_step(Vector3d& x, Vector3d& sum) {
  for (int iteration = 0; iteration < 20; ++iteration) {
    const double length = sum.norm();
    const Vector3d turn = kInverse.cwiseProduct(sum);
    const Vector3d rate = sum.cross(turn);
    const Vector3d residual = sum - 2.0 * x - 0.5 * kStep / length * rate;
    Matrix3d J = Matrix3d::Identity();
    J -=
        0.5 * kStep / length *
        (hat(sum) * kInverse.asDiagonal() - hat(turn) - rate * sum.transpose() / (length * length));
    const Vector3d change = J.inverse() * residual;
    sum -= change;
    if (change.lpNorm<Eigen::Infinity>() < kTolerance) break;
  }
  x = sum - x;
}

void sphere_by_hand(benchmark::State& state) {
  for (auto _ : state) {
    Vector3d x = kStart, before = kStart, sum = 2.0 * kStart;
    for (int k = 0; k < kSteps; ++k) {
      const Vector3d here = x;
      sum += 2.0 * (x - before);  // as far as in the last step
      sphere_step(x, sum);
      before = here;
    }
    benchmark::DoNotOptimize(x);
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

// Rotation and momentum in the body.
struct Body {
  Matrix3d R;
  Vector3d p;
};

// v = h I⁻¹ p, p = ((p₀ + p₁)/2 + ξ × (p₁ - p₀)/4)/(1 + ‖ξ‖²/4), p₁ = (cay ξ)⁻² p₀, ξ = v/2; then
// R₁ = R₀ (cay ξ)².
void rotation_step(Body& body, Vector3d& v) {
  Matrix3d twice;
  Vector3d p1;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Vector3d xi = 0.5 * v;
    const double scale = 1.0 / (1.0 + 0.25 * xi.squaredNorm());
    const Matrix3d a = hat(xi);
    const Matrix3d cayley = Matrix3d::Identity() + scale * (a + 0.5 * a * a);
    twice = cayley * cayley;
    p1 = twice.transpose() * body.p;
    const Vector3d sum = 0.5 * (body.p + p1), difference = 0.25 * (p1 - body.p);
    const Vector3d p = scale * (sum + xi.cross(difference));
    const Vector3d residual = v - kStep * kInverse.cwiseProduct(p);
    // By ξ: (cay ξ)⁻¹ δ(cay ξ) = T δξ with T = (1 - ξ̂/2) scale, so δp₁ = p₁ × (1 + (cay ξ)⁻¹) T δξ.
    const Matrix3d T = scale * (Matrix3d::Identity() - 0.5 * a);
    const Matrix3d d_p1 = hat(p1) * (T + cayley.transpose() * T);
    const Matrix3d d_p =
        scale * (0.5 * d_p1 + 0.25 * a * d_p1 - hat(difference)) - 0.5 * scale * p * xi.transpose();
    const Matrix3d J = Matrix3d::Identity() - 0.5 * kStep * (kInverse.asDiagonal() * d_p).eval();
    const Vector3d change = J.inverse() * residual;
    v -= change;
    if (change.lpNorm<Eigen::Infinity>() < kTolerance) break;
  }
  body.R = (body.R * twice).eval();
  body.p = p1;
}

void rotations_by_hand(benchmark::State& state) {
  for (auto _ : state) {
    Body body{Matrix3d::Identity(), kStart};
    Vector3d v = kStep * kInverse.cwiseProduct(kStart);
    for (int k = 0; k < kSteps; ++k) rotation_step(body, v);
    benchmark::DoNotOptimize(body.R.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

courant::Expr energy(const courant::ExprVector& momentum) {
  using courant::square;
  return 0.5 * (kInverse[0] * square(momentum[0]) + kInverse[1] * square(momentum[1]) +
                kInverse[2] * square(momentum[2]));
}

void run(benchmark::State& state, const courant::Integrator& method, const Eigen::VectorXd& start) {
  for (auto _ : state) {
    const courant::State end = method.advance({.x = start}, kStep, kSteps);
    benchmark::DoNotOptimize(end.x.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

courant::DiscretizeFirst sphere_method(courant::Backend backend) {
  using namespace courant;
  const auto sphere = std::make_shared<Sphere>(2);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<Poisson>(sphere, [](const ExprVector& x) { return courant::hat(x); }),
      std::make_shared<Hamiltonian>(sphere,
                                    [](const ExprVector& x, const Expr&) { return energy(x); }));
  return DiscretizeFirst(system, std::make_shared<Chordal>(sphere), {.backend = backend});
}

courant::DiscretizeFirst rotation_method(courant::Backend backend) {
  using namespace courant;
  const auto rotations = std::make_shared<SpecialOrthogonal3>(SpecialOrthogonal3::cayley());
  const auto phase_space = std::make_shared<CotangentBundle>(rotations);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(phase_space),
      std::make_shared<Hamiltonian>(
          phase_space, [](const ExprVector& x, const Expr&) { return energy(x.tail(3)); }));
  return DiscretizeFirst(
      system,
      std::make_shared<CotangentLift>(phase_space, std::make_shared<CayleyMidpoint>(rotations)),
      {.backend = backend});
}

Eigen::VectorXd body_at_rest() {
  Eigen::VectorXd x(12);
  x << Eigen::VectorXd(Matrix3d::Identity().reshaped()), kStart;
  return x;
}

void sphere(benchmark::State& state, courant::Backend backend) {
  run(state, sphere_method(backend), kStart);
}

void rotations(benchmark::State& state, courant::Backend backend) {
  run(state, rotation_method(backend), body_at_rest());
}

BENCHMARK(sphere_by_hand);
BENCHMARK_CAPTURE(sphere, native, courant::Backend::native);
BENCHMARK_CAPTURE(sphere, interpreter, courant::Backend::interpreter);
BENCHMARK(rotations_by_hand);
BENCHMARK_CAPTURE(rotations, native, courant::Backend::native);
BENCHMARK_CAPTURE(rotations, interpreter, courant::Backend::interpreter);

// The schemes are the same: both routes end in the same place.
bool agree() {
  Vector3d x = kStart, sum = 2.0 * kStart;
  Body body{Matrix3d::Identity(), kStart};
  Vector3d v = kStep * kInverse.cwiseProduct(kStart);
  const auto on_sphere = sphere_method(courant::Backend::interpreter);
  const auto on_rotations = rotation_method(courant::Backend::interpreter);
  for (int k = 0; k < 100; ++k) {
    sphere_step(x, sum);
    rotation_step(body, v);
  }
  const Eigen::VectorXd first = on_sphere.advance({.x = kStart}, kStep, 100).x;
  const Eigen::VectorXd second = on_rotations.advance({.x = body_at_rest()}, kStep, 100).x;
  const Matrix3d R = second.head(9).reshaped<Eigen::RowMajor>(3, 3);
  return (first - x).norm() < 1e-12 && (R - body.R).norm() < 1e-12 &&
         (second.tail(3) - body.p).norm() < 1e-12;
}

}  // namespace

int main(int argc, char** argv) {
  if (!agree()) {
    std::fputs("bench_manifold_step: the two routes do not take the same steps.\n", stderr);
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
