// Explicit symplectic steps, of order 2 and composed to order 8, next to loops written by hand in the same process:
//
//   Kepler     H = |p|²/2 - 1/|q|, e = 0.6, 1/200 of the period
//   LC         H = (q²/C + φ²/L)/2, 1/16 of the period
//   pendulum   H = |p|²/2 + y on a rod of length 1: RATTLE, 1/64 of the period
//
// By hand is the best that one writes for the one problem: forces are evaluated once a substep and handed on, the
// multiplier of the position comes from a quadratic equation, that of the velocity from a linear one.
#include "courant/integrators/methods/verlet.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <span>
#include <string>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"
#include "work_precision/pendulum.hpp"

namespace {

using namespace courant;

constexpr int kSteps = 5000;

// A step of p' = f(q), q' = p/m with the force at its beginning, which it replaces by that at its end.
template <class P>
void verlet(double* y, double* force, double h) {
  for (int i = 0; i < P::n; ++i) y[P::n + i] += 0.5 * h * force[i];
  for (int i = 0; i < P::n; ++i) y[i] += h * P::inverse_mass * y[P::n + i];
  P::force(y, force);
  for (int i = 0; i < P::n; ++i) y[P::n + i] += 0.5 * h * force[i];
}

struct KeplerProblem {
  static constexpr int n = 2;
  static constexpr double inverse_mass = 1.0, h = 2.0 * std::numbers::pi / 200;
  static constexpr std::array<double, 4> start = {0.4, 0.0, 0.0, 2.0};
  static void force(const double* q, double* f) {
    const double square = q[0] * q[0] + q[1] * q[1], of_cube = -1.0 / (square * std::sqrt(square));
    f[0] = q[0] * of_cube;
    f[1] = q[1] * of_cube;
  }
  static void step(double* y, double* f, double part) { verlet<KeplerProblem>(y, f, part); }
  static Expr energy(const ExprVector& x) {
    return 0.5 * (square(x[2]) + square(x[3])) - 1.0 / sqrt(square(x[0]) + square(x[1]));
  }
};

struct Circuit {
  static constexpr int n = 1;
  static constexpr double capacitance = 0.5, inductance = 2.0;  // with ω = 1
  static constexpr double inverse_mass = 1.0 / inductance, h = 2.0 * std::numbers::pi / 16;
  static constexpr std::array<double, 2> start = {0.5, 0.0};
  static void force(const double* q, double* f) { f[0] = -q[0] * (1.0 / capacitance); }
  static void step(double* y, double* f, double part) { verlet<Circuit>(y, f, part); }
  static Expr energy(const ExprVector& x) {
    return square(x[0]) / (2.0 * capacitance) + square(x[1]) / (2.0 * inductance);
  }
};

struct Pendulum {
  static constexpr int n = 2;
  static constexpr double h = 8.349 / 64;
  static constexpr std::array<double, 4> start = {0.9092974268256817, 0.4161468365471424, 0.0, 0.0};
  static void force(const double*, double*) {}
  static void step(double* y, double*, double part) { work_precision::Pendulum::rattle(y, part); }
  static Expr energy(const ExprVector& x) { return 0.5 * (square(x[2]) + square(x[3])) + x[1]; }
  static ExprVector constraint(const ExprVector& x) {
    return ExprVector::Constant(1, 0.5 * (square(x[0]) + square(x[1]) - 1.0));
  }
};

std::span<const double> parts_of(int order) {
  static constexpr double whole[] = {1.0};
  return order == 2 ? std::span<const double>(whole) : Composition::coefficients(order);
}

template <class P>
VectorXd steps_by_hand(int order) {
  const std::span<const double> parts = parts_of(order);
  std::array<double, 2 * P::n> y = P::start;
  std::array<double, P::n> force{};
  P::force(y.data(), force.data());
  for (int k = 0; k < kSteps; ++k)
    for (const double part : parts) P::step(y.data(), force.data(), part * P::h);
  return Eigen::Map<const VectorXd>(y.data(), std::ssize(y));
}

template <class P>
std::shared_ptr<const Integrator> method(int order, Backend backend) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(P::n));
  const auto energy = std::make_shared<Hamiltonian>(
      M, [](const ExprVector& x, const Expr&) { return P::energy(x); });
  std::shared_ptr<const GeneratingFamily> family = energy;
  if constexpr (requires(const ExprVector& x) { P::constraint(x); })
    family = std::make_shared<ConstrainedFamily>(
        energy,
        [](const ExprVector& x, const ExprVector&, const Expr&) { return P::constraint(x); }, 1);
  const auto system =
      std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M), family);
  const VectorXd start = Eigen::Map<const VectorXd>(P::start.data(), std::ssize(P::start));
  const auto steps = std::make_shared<Verlet>(
      system, ConstraintAlgorithm().run(system, {.x = start}),
      std::make_shared<CotangentLift>(M, std::make_shared<Theta>(M->base(), 0.0)),
      Verlet::Options{.backend = backend});
  if (order == 2) return steps;
  return std::make_shared<Composition>(steps, order);
}

template <class P>
VectorXd steps_of(const Integrator& method) {
  const VectorXd start = Eigen::Map<const VectorXd>(P::start.data(), std::ssize(P::start));
  return method.advance({.x = start}, P::h, kSteps).x;
}

template <class P>
void by_hand(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(steps_by_hand<P>(static_cast<int>(state.range(0))));
  state.SetItemsProcessed(state.iterations() * kSteps);
}

template <class P>
void generic(benchmark::State& state, Backend backend) {
  const auto steps = method<P>(static_cast<int>(state.range(0)), backend);
  for (auto _ : state) benchmark::DoNotOptimize(steps_of<P>(*steps));
  state.SetItemsProcessed(state.iterations() * kSteps);
}

// The schemes are the same: both routes end in the same place.
template <class P>
bool agree() {
  for (const int order : {2, 8}) {
    const double distance =
        (steps_of<P>(*method<P>(order, Backend::native)) - steps_by_hand<P>(order)).norm();
    if (distance < 1e-8) continue;
    std::fprintf(stderr, "bench_verlet: the two routes of order %d end %g apart.\n", order,
                 distance);
    return false;
  }
  return true;
}

template <class P>
void with(const std::string& name) {
  const auto add = [](benchmark::internal::Benchmark* one) { one->Arg(2)->Arg(8); };
  benchmark::RegisterBenchmark((name + "/by_hand").c_str(), by_hand<P>)->Apply(add);
  benchmark::RegisterBenchmark((name + "/native").c_str(), [](benchmark::State& state) {
    generic<P>(state, Backend::native);
  })->Apply(add);
  benchmark::RegisterBenchmark((name + "/interpreter").c_str(), [](benchmark::State& state) {
    generic<P>(state, Backend::interpreter);
  })->Apply(add);
}

}  // namespace

int main(int argc, char** argv) {
  if (!agree<KeplerProblem>() || !agree<Circuit>() || !agree<Pendulum>()) return 1;
  with<KeplerProblem>("kepler");
  with<Circuit>("circuit");
  with<Pendulum>("pendulum");
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
