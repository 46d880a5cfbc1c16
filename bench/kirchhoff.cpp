// The Dirac structure of currents and voltages of large graphs: building it from the graph
// (spanning tree, loops, cut-sets, all four representations) and verifying it.
#include "courant/structures/kirchhoff.hpp"

#include <benchmark/benchmark.h>

#include <random>

#include "courant/structures/kirchhoff_laws.hpp"

namespace courant {
namespace {

// rows × columns nodes, an element between neighbours.
CircuitGraph grid(Index rows, Index columns) {
  CircuitGraph graph(static_cast<std::size_t>(rows * columns));
  const auto node = [&](Index i, Index j) { return static_cast<std::size_t>(i * columns + j); };
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j) {
      if (j + 1 < columns) add_edge(node(i, j), node(i, j + 1), graph);
      if (i + 1 < rows) add_edge(node(i, j), node(i + 1, j), graph);
    }
  return graph;
}

// A random graph.
CircuitGraph random(Index nodes, Index elements) {
  CircuitGraph graph(static_cast<std::size_t>(nodes));
  std::mt19937 generator(1);
  std::uniform_int_distribution<std::size_t> node(0, static_cast<std::size_t>(nodes - 1));
  for (Index k = 0; k < elements; ++k) {
    const std::size_t source = node(generator), target = node(generator);
    add_edge(source, target, graph);
  }
  return graph;
}

void build(benchmark::State& state, const CircuitGraph& graph) {
  for (auto _ : state) {
    const Kirchhoff structure(graph);
    benchmark::DoNotOptimize(structure.kernel_representation());
    benchmark::DoNotOptimize(structure.image_representation());
    benchmark::DoNotOptimize(structure.constrained_representation());
    benchmark::DoNotOptimize(structure.hybrid_representation());
    state.counters["elements"] = static_cast<double>(structure.element_count());
    state.counters["loop entries"] = static_cast<double>(structure.loops().nonZeros());
  }
}

void verify(benchmark::State& state, const CircuitGraph& graph) {
  for (auto _ : state)
    if (!all_passed(check_kirchhoff(Kirchhoff(graph)))) state.SkipWithError("a law failed");
}

void build_grid(benchmark::State& state) { build(state, grid(state.range(0), state.range(0))); }
void verify_grid(benchmark::State& state) { verify(state, grid(state.range(0), state.range(0))); }
// 10⁵ elements.
void build_random(benchmark::State& state) { build(state, random(state.range(0), 100000)); }
void verify_random(benchmark::State& state) { verify(state, random(state.range(0), 100000)); }

BENCHMARK(build_grid)->Arg(100)->Arg(224)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(verify_grid)->Arg(100)->Arg(224)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(build_random)->Arg(90000)->Arg(50000)->Unit(benchmark::kMillisecond);
BENCHMARK(verify_random)->Arg(90000)->Arg(50000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace courant

BENCHMARK_MAIN();
