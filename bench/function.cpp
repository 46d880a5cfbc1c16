// Gradient and Hessian of the Hamiltonian of N point vortices: derived by hand, and traced,
// differentiated and compiled.
//
//   H(x, y) = c Σ_{j<k} Γ_j Γ_k log l²_jk,   l²_jk = (x_j - x_k)² + (y_j - y_k)²
#include "courant/core/expressions/function.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "courant/core/expressions/derivative.hpp"

namespace courant {
namespace {

constexpr double kScale = -1.0 / (4.0 * std::numbers::pi);

double strength(int j) { return j % 4 < 2 ? 1.0 + 0.1 * j : -1.0 - 0.1 * j; }

VectorXd point(int vortices) {
  VectorXd x(2 * vortices);
  for (int j = 0; j < vortices; ++j) {
    x[j] = std::cos(2.4 * j) * (1.0 + 0.3 * j);
    x[vortices + j] = std::sin(2.4 * j) * (1.0 + 0.3 * j);
  }
  return x;
}

// The entries of the Hessian in the order of Function: by row, all of them.
template <int N>
void by_hand(const double* x, const double* strengths, double* gradient, double* hessian) {
  constexpr int n = 2 * N;
  const double* y = x + N;
  std::fill(gradient, gradient + n, 0.0);
  std::fill(hessian, hessian + n * n, 0.0);
  const auto h = [hessian](int i, int j) -> double& { return hessian[i * n + j]; };
  for (int j = 0; j < N; ++j) {
    for (int k = j + 1; k < N; ++k) {
      const double dx = x[j] - x[k], dy = y[j] - y[k];
      const double inverse = 1.0 / (dx * dx + dy * dy);
      const double g = 2.0 * kScale * strengths[j] * strengths[k] * inverse;
      const double gx = g * dx, gy = g * dy;
      gradient[j] += gx;
      gradient[k] -= gx;
      gradient[N + j] += gy;
      gradient[N + k] -= gy;
      const double xx = g - 2.0 * gx * dx * inverse, yy = -xx, xy = -2.0 * gx * dy * inverse;
      for (const auto& [a, b, sign] :
           {std::tuple{j, j, 1.0}, {k, k, 1.0}, {j, k, -1.0}, {k, j, -1.0}}) {
        h(a, b) += sign * xx;
        h(N + a, N + b) += sign * yy;
        h(a, N + b) += sign * xy;
        h(N + a, b) += sign * xy;
      }
    }
  }
}

Function traced(int vortices, Backend backend) {
  Graph graph;
  const ExprVector x = graph.variables("x", 2 * vortices);
  Expr hamiltonian = 0.0;
  for (int j = 0; j < vortices; ++j)
    for (int k = j + 1; k < vortices; ++k)
      hamiltonian += kScale * strength(j) * strength(k) *
                     log(square(x[j] - x[k]) + square(x[vortices + j] - x[vortices + k]));
  return Function("gradient", {{"x", x}}, gradient(hamiltonian, x),
                  {.differentiate = {"x"}, .backend = backend});
}

template <int N>
void hand_written(benchmark::State& state) {
  const VectorXd x = point(N);
  const VectorXd strengths =
      VectorXd::NullaryExpr(N, [](Index j) { return strength(static_cast<int>(j)); });
  VectorXd out(2 * N + 4 * N * N);
  for (auto _ : state) {
    by_hand<N>(x.data(), strengths.data(), out.data(), out.data() + 2 * N);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
}

template <int N, Backend::Kind backend>
void compiled(benchmark::State& state) {
  const VectorXd x = point(N);
  const VectorXd strengths =
      VectorXd::NullaryExpr(N, [](Index j) { return strength(static_cast<int>(j)); });
  const Function function = traced(N, backend);
  VectorXd out(2 * N + function.nonzeros()), expected(2 * N + 4 * N * N);
  const double* const in[] = {x.data()};
  function.value_and_jacobian(in, out.data());
  by_hand<N>(x.data(), strengths.data(), expected.data(), expected.data() + 2 * N);
  if (out.size() != expected.size() || !out.isApprox(expected, 1e-12))
    state.SkipWithError("wrong result");
  for (auto _ : state) {
    function.value_and_jacobian(in, out.data());
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
}

double least(const std::vector<double>& times) {
  return *std::min_element(times.begin(), times.end());
}

void repeated(benchmark::internal::Benchmark* b) {
  b->Repetitions(10)->ComputeStatistics("least", least)->ReportAggregatesOnly();
}

BENCHMARK(hand_written<4>)->Apply(repeated);
BENCHMARK(compiled<4, Backend::Kind::native>)->Apply(repeated);
BENCHMARK(compiled<4, Backend::Kind::interpreter>)->Apply(repeated);
BENCHMARK(hand_written<16>)->Apply(repeated);
BENCHMARK(compiled<16, Backend::Kind::native>)->Apply(repeated);
BENCHMARK(compiled<16, Backend::Kind::interpreter>)->Apply(repeated);

// Building a large graph: operations made a second.
void large_graph(benchmark::State& state) {
  std::uint32_t size = 0;
  for (auto _ : state) {
    Graph graph;
    const ExprVector x = graph.variables("x", 64);
    Expr f = x[0];
    for (int i = 0; graph.size() < static_cast<std::uint32_t>(state.range(0)); ++i)
      f = sin(f) * x[i % 64] + x[(7 * i) % 64] * static_cast<double>(i % 1000);
    size = graph.size();
  }
  state.counters["nodes/s"] =
      benchmark::Counter(size, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(large_graph)->Arg(10'000'000)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace courant

BENCHMARK_MAIN();
