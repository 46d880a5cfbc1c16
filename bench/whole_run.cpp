// Whole runs of 10⁶ steps with `every: 1000`, files and preparation included, next to bare loops of the
// same steps: what is observed and recorded of steps that are not written. Compare the times of the clock: a run uses
// two cores where there are two.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/runner.hpp"

namespace {

using courant::Experiment;

constexpr auto kMethod1 = R"json({
  "system": {"type": "point-vortices", "strengths": [1, 1, -1, -1]},
  "initial": {"x": [-1, 1, -1, 1], "y": [2, 2, -2, -2]},
  "method": {"type": "discretize-first", "discretization": "midpoint"},
  "time": {"step": 1.0, "end": 1e6},
  "output": {"every": 1000}
})json";

constexpr auto kMethod2 = R"json({
  "system": {"type": "point-vortices", "strengths": [1, 1, -1, -1]},
  "initial": {"x": [-1, 1, -1, 1], "y": [2, 2, -2, -2]},
  "method": {"type": "constrain-first", "discretization": "midpoint", "projector": "momentum"},
  "time": {"step": 1.0, "end": 1e6},
  "output": {"every": 1000}
})json";

constexpr auto kBody = R"json({
  "system": {
    "type": "hamiltonian",
    "parameters": {"I": [1, 2, 3]},
    "manifold": "sphere",
    "structure": {
      "type": "bivector",
      "matrix": [[0, "-xi[2]", "xi[1]"], ["xi[2]", 0, "-xi[0]"], ["-xi[1]", "xi[0]", 0]]
    },
    "coordinates": ["xi[3]"],
    "hamiltonian": "(xi[0]^2/I[0] + xi[1]^2/I[1] + xi[2]^2/I[2])/2"
  },
  "initial": {"xi": ["cos(1.1)", 0, "sin(1.1)"]},
  "method": {"type": "discretize-first", "discretization": "chordal"},
  "time": {"step": 0.0625, "end": 62500.0},
  "output": {"every": 1000}
})json";

courant::RunOptions into_folder() {
  courant::RunOptions options;
  options.folder = std::filesystem::temp_directory_path() /
                   ("courant_bench_whole_run_" + std::to_string(::getpid()));
  options.backend = courant::Backend::native;
  options.existing = courant::ExistingRun::replace;
  return options;
}

void bare_loop(benchmark::State& state, std::string_view text) {
  const Experiment experiment = courant::read_experiment(text);
  const courant::ConstraintLadder ladder = courant::consistent_start(experiment);
  const courant::PreparedMethod method =
      experiment.method->prepare({.system = experiment.model.system,
                                  .ladder = ladder,
                                  .initial = ladder.point,
                                  .step = experiment.time->step,
                                  .backend = courant::Backend::native,
                                  .vocabulary = &experiment.model.vocabulary});
  for (auto _ : state) {
    courant::State at = method.initial;
    const auto stepper = method.integrator->stepper();
    for (long k = 1; k <= experiment.time->steps; ++k)
      stepper->step(at, experiment.time->step, experiment.time->time(k));
    benchmark::DoNotOptimize(at.x.data());
  }
  state.SetItemsProcessed(state.iterations() * experiment.time->steps);
}

void run(benchmark::State& state, std::string_view text) {
  const Experiment experiment = courant::read_experiment(text);
  const courant::RunOptions options = into_folder();
  for (auto _ : state)
    if (courant::run(experiment, options).status != courant::RunStatus::completed)
      throw std::runtime_error("bench_whole_run: a run is not completed.");
  std::filesystem::remove_all(options.folder);
  state.SetItemsProcessed(state.iterations() * experiment.time->steps);
}

void add(const std::string& name, std::string_view text) {
  benchmark::RegisterBenchmark(("bare_loop/" + name).c_str(), bare_loop, text)
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("run/" + name).c_str(), run, text)->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  add("method_1", kMethod1);
  add("method_2", kMethod2);
  add("body", kBody);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
