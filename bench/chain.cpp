// A chain of masses between springs of which the last is cubic, implicit midpoint, h = 0.05: a step of
// n masses against a hand-written one in the same process.
//
// The competitor eliminates momenta by hand, and solves the tridiagonal system that is left for the
// positions by Thomas' algorithm in each iteration of Newton's method, from the last increment.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>

#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kStep = 0.05;
constexpr int kSteps = 50;

class HandWritten {
 public:
  explicit HandWritten(Index n)
      : q_(VectorXd::Zero(n)),
        p_(q_),
        increment_(q_),
        residual_(q_),
        diagonal_(q_),
        rate_(VectorXd::Zero(n)) {
    q_[0] = 1.0;
  }

  // q₁ = q₀ + d with d = h p₀ + h²/2 f(q₀ + d/2).
  void step() {
    const Index n = q_.size();
    constexpr double c = 0.5 * kStep * kStep;
    for (int iteration = 0; iteration < 50; ++iteration) {
      for (Index i = 0; i < n; ++i) {
        const double at = middle(i);
        double force = i == 0 ? -at : middle(i - 1) - at;
        double slope = -1.0;
        if (i + 1 < n) {
          force += middle(i + 1) - at;
          slope -= 1.0;
        } else {
          force -= at * at * at;
          slope -= 3.0 * at * at;
        }
        rate_[i] = force;
        residual_[i] = increment_[i] - kStep * p_[i] - c * force;
        diagonal_[i] = 1.0 - 0.5 * c * slope;
      }
      constexpr double beside = -0.5 * c;
      for (Index i = 1; i < n; ++i) {
        const double factor = beside / diagonal_[i - 1];
        diagonal_[i] -= factor * beside;
        residual_[i] -= factor * residual_[i - 1];
      }
      double change = 0.0, above = 0.0;
      for (Index i = n; i-- > 0;) {
        above = (residual_[i] - (i + 1 < n ? beside * above : 0.0)) / diagonal_[i];
        increment_[i] -= above;
        change = std::max(change, std::fabs(above));
      }
      if (change < 1e-13) break;
    }
    q_ += increment_;
    p_ += (2.0 / kStep) * increment_ - 2.0 * p_;
  }

 private:
  double middle(Index i) const { return q_[i] + 0.5 * increment_[i]; }

  VectorXd q_, p_, increment_, residual_, diagonal_, rate_;
};

void by_hand(benchmark::State& state) {
  for (auto _ : state) {
    HandWritten chain(state.range(0));
    for (int k = 0; k < kSteps; ++k) chain.step();
    benchmark::DoNotOptimize(chain);
  }
  state.SetItemsProcessed(state.iterations() * kSteps * 2 * state.range(0));
}

std::unique_ptr<courant::DiscretizeFirst> chain(courant::Index n, courant::Backend backend) {
  using namespace courant;
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(n));
  const auto H = std::make_shared<Hamiltonian>(M, [n](const ExprVector& x, const Expr&) {
    Expr sum = square(x[0]) + square(square(x[n - 1])) / 2.0;
    for (Index i = 0; i < n; ++i) sum += square(x[n + i]);
    for (Index i = 0; i + 1 < n; ++i) sum += square(x[i + 1] - x[i]);
    return sum / 2.0;
  });
  const auto system = std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M), H);
  return std::make_unique<DiscretizeFirst>(system, std::make_shared<Theta>(M),
                                           DiscretizeFirst::Options{.backend = backend});
}

void generic(benchmark::State& state) {
  const Index n = state.range(0);
  const auto method = chain(n, courant::Backend::interpreter);
  const auto stepper = method->stepper();
  for (auto _ : state) {
    stepper->forget();
    courant::State at{.x = VectorXd::Unit(2 * n, 0)};
    for (int k = 0; k < kSteps; ++k) stepper->step(at, kStep);
    benchmark::DoNotOptimize(at);
  }
  state.SetItemsProcessed(state.iterations() * kSteps * 2 * n);
}

}  // namespace

BENCHMARK(by_hand)->RangeMultiplier(10)->Range(10, 10000)->Unit(benchmark::kMillisecond);
BENCHMARK(generic)->RangeMultiplier(10)->Range(10, 10000)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
