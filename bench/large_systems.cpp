// Steps of Method 1 (midpoint rule) of a chain of masses and of an LC line with 10³, 10⁴ and 10⁵ states, next to what a step
// needs in any case: the matrix of its equations, factorised by KLU with ordering and pivots kept, and one
// solution with these factors.
//
// All of them are in one process: steps of the library, interpreted and as native code; factors and solution of the
// same matrix, and the solution alone; and steps by hand, with Thomas' algorithm for half of the states.
#include <benchmark/benchmark.h>
#include <klu.h>
#include <sys/resource.h>

#include <Eigen/SparseCore>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "courant/core/solve/equation_system.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/step/step_formulas.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant {
namespace {

constexpr double kStep = 0.05;
constexpr int kWarmUp = 50;  // steps, after which extrapolations and factors are there

// Where states start: at rest, with displacements of the size 1 that differ from place to place.
double displacement(Index i) {
  return std::sin(1.7 * static_cast<double>(i) * static_cast<double>(i));
}

struct Problem {
  std::shared_ptr<const Integrator> method;
  State start;
};

// Masses between springs, of which the last is cubic.
Problem chain(Index states, Backend backend) {
  const Index n = states / 2;
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(n));
  const auto H = std::make_shared<Hamiltonian>(M, [n](const ExprVector& x, const Expr&) {
    Expr sum = square(x[0]) + square(square(x[n - 1])) / 2.0;
    for (Index i = 0; i < n; ++i) sum += square(x[n + i]);
    for (Index i = 0; i + 1 < n; ++i) sum += square(x[i + 1] - x[i]);
    return sum / 2.0;
  });
  const auto system = std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M), H);
  Problem result{
      .method = std::make_shared<DiscretizeFirst>(system, std::make_shared<Theta>(M),
                                                  DiscretizeFirst::Options{.backend = backend}),
      .start = {.x = VectorXd::Zero(states)}};
  for (Index i = 0; i < n; ++i) result.start.x[i] = displacement(i);
  return result;
}

// Inductors in series and capacitors to ground, from an experiment: one state more.
Problem line(Index states, Backend backend) {
  const std::string N = std::to_string(states / 2);
  std::string text = R"json({
    "system": {
      "type": "network",
      "nodes": ["0", {"repeat": {"i": [0, N]}, "name": "n{i}"}],
      "elements": [
        {"repeat": {"i": [0, N]}, "type": "capacitor", "name": "C{i}", "from": "n{i}", "to": "0", "value": 1},
        {"repeat": {"i": [1, N]}, "type": "inductor", "name": "L{i}", "from": "n{i-1}", "to": "n{i}", "value": 1}
      ]
    },
    "initial": {"q_C{i}": {"repeat": {"i": [0, N]}, "value": "sin(1.7*{i}*{i})"}},
    "method": {"type": "discretize-first", "discretization": "midpoint"},
    "time": {"step": 0.05, "end": 5}
  })json";
  boost::replace_all(text, "N", N);
  const Experiment experiment = read_experiment(text);
  const ConstraintLadder ladder = consistent_start(experiment);
  const PreparedMethod method =
      experiment.method->prepare({.system = experiment.model.system,
                                  .ladder = ladder,
                                  .initial = ladder.point,
                                  .step = kStep,
                                  .backend = backend,
                                  .vocabulary = &experiment.model.vocabulary});
  return {.method = method.integrator, .start = method.initial};
}

using Maker = Problem (*)(Index, Backend);

// Made once for all benches of a system.
const Problem& problem(Maker make, Index states, bool is_native) {
  static std::map<std::tuple<Maker, Index, bool>, Problem> made;
  const auto key = std::make_tuple(make, states, is_native);
  const auto found = made.find(key);
  return found != made.end()
             ? found->second
             : made.emplace(key, make(states, is_native ? Backend::native : Backend::interpreter))
                   .first->second;
}

// Time for a state and a step.
void count(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * state.range(0));
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["GB"] = static_cast<double>(usage.ru_maxrss) / (1 << 20);
}

void step(benchmark::State& state, Maker make, bool is_native) {
  const Problem& of = problem(make, state.range(0), is_native);
  const auto stepper = of.method->stepper();
  State at = of.start;
  for (int k = 0; k < kWarmUp; ++k) stepper->step(at, kStep);
  double t = at.t;
  const SolverStatistics before = stepper->statistics();
  for (auto _ : state) {
    stepper->go_on(kStep, t += kStep);  // as runs do
    benchmark::DoNotOptimize(stepper->ended().after.x.data());
  }
  const SolverStatistics& after = stepper->statistics();
  const auto steps = static_cast<double>(after.steps - before.steps);
  state.counters["iterations"] = static_cast<double>(after.iterations - before.iterations) / steps;
  state.counters["factorizations"] =
      static_cast<double>(after.factorizations - before.factorizations) / steps;
  count(state);
}

// The matrix of a step with its factors, by KLU alone.
class Factors {
 public:
  explicit Factors(Eigen::SparseMatrix<double> A)
      : A_(std::move(A)), b_(VectorXd::Ones(A_.rows())) {
    klu_defaults(&common_);
    symbolic_ = klu_analyze(size(), A_.outerIndexPtr(), A_.innerIndexPtr(), &common_);
    numeric_ =
        klu_factor(A_.outerIndexPtr(), A_.innerIndexPtr(), A_.valuePtr(), symbolic_, &common_);
    if (numeric_ == nullptr) throw std::runtime_error("bench_large_systems: a singular matrix.");
  }
  ~Factors() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  void factorize() {
    klu_refactor(A_.outerIndexPtr(), A_.innerIndexPtr(), A_.valuePtr(), symbolic_, numeric_,
                 &common_);
  }
  void solve() {
    b_.setOnes();
    klu_solve(symbolic_, numeric_, size(), 1, b_.data(), &common_);
    benchmark::DoNotOptimize(b_.data());
  }

 private:
  int size() const { return static_cast<int>(A_.rows()); }

  Eigen::SparseMatrix<double> A_;
  VectorXd b_;
  klu_common common_;
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

// Of the equations that elimination leaves.
Eigen::SparseMatrix<double> matrix(const Problem& of) {
  const StepFormulas formulas = of.method->formulas().front();
  const Function equations = formulas.compile(Backend::interpreter).left();
  std::vector<VectorXd> in;
  for (Index g = 0; g < equations.input_count(); ++g) {
    in.push_back(VectorXd::Zero(equations.input_size(g)));
    const std::string& name = formulas.inputs[static_cast<std::size_t>(g)].name;
    if (name == "h") in.back().setConstant(kStep);
    if (in.back().size() == of.start.x.size() && g > 0) in.back() = of.start.x;
  }
  return equations.sparse_jacobian(in);
}

void bare(benchmark::State& state, Maker make, bool factorizes) {
  Factors factors(matrix(problem(make, state.range(0), false)));
  for (auto _ : state) {
    if (factorizes) factors.factorize();
    factors.solve();
  }
  count(state);
}

// Displacements d in q₁ = q₀ + d of a step by hand: d = h r + h²/2 f(q₀ + d/2), where q' = r, r' = f. Momenta of the
// chain are r; what a node of the line gains of the currents is too. The ends are free, or as those of chain().
class ByHand {
 public:
  ByHand(Index n, bool is_chain)
      : is_chain_(is_chain), q_(n), r_(VectorXd::Zero(n)), d_(r_), residual_(r_), diagonal_(r_) {
    for (Index i = 0; i < n; ++i) q_[i] = displacement(i);
  }

  void step() {
    const Index n = q_.size();
    constexpr double c = 0.5 * kStep * kStep, beside = -0.5 * c;
    for (int iteration = 0; iteration < 50; ++iteration) {
      for (Index i = 0; i < n; ++i) {
        const double at = middle(i);
        double force = 0.0, slope = 0.0;
        if (i > 0 || is_chain_) {
          force += (i > 0 ? middle(i - 1) : 0.0) - at;
          slope -= 1.0;
        }
        if (i + 1 < n) {
          force += middle(i + 1) - at;
          slope -= 1.0;
        } else if (is_chain_) {
          force -= at * at * at;
          slope -= 3.0 * at * at;
        }
        residual_[i] = d_[i] - kStep * r_[i] - c * force;
        diagonal_[i] = 1.0 - 0.5 * c * slope;
      }
      for (Index i = 1; i < n; ++i) {
        const double factor = beside / diagonal_[i - 1];
        diagonal_[i] -= factor * beside;
        residual_[i] -= factor * residual_[i - 1];
      }
      double change = 0.0, above = 0.0;
      for (Index i = n; i-- > 0;) {
        above = (residual_[i] - (i + 1 < n ? beside * above : 0.0)) / diagonal_[i];
        d_[i] -= above;
        change = std::max(change, std::fabs(above));
      }
      if (change < 1e-13) break;
    }
    q_ += d_;
    r_ = (2.0 / kStep) * d_ - r_;
  }

 private:
  double middle(Index i) const { return q_[i] + 0.5 * d_[i]; }

  bool is_chain_;
  VectorXd q_, r_, d_, residual_, diagonal_;
};

void by_hand(benchmark::State& state, bool is_chain) {
  ByHand system(state.range(0) / 2, is_chain);
  for (int k = 0; k < kWarmUp; ++k) system.step();
  for (auto _ : state) {
    system.step();
    benchmark::DoNotOptimize(system);
  }
  count(state);
}

void add(const std::string& name, Maker make) {
  constexpr Index most = 100000;
  const auto of = [&](const char* what, auto run, auto... arguments) {
    return benchmark::RegisterBenchmark((name + "/" + what).c_str(), run, arguments...)
        ->RangeMultiplier(10)
        ->Unit(benchmark::kMicrosecond);
  };
  of("interpreter", step, make, false)->Range(1000, most);
  of("native", step, make, true)->Arg(1000);
  of("factors_and_solution", bare, make, true)->Range(1000, most);
  of("solution", bare, make, false)->Range(1000, most);
  of("by_hand", by_hand, make == chain)->Range(1000, most);
}

}  // namespace
}  // namespace courant

int main(int argc, char** argv) {
  courant::add("chain", courant::chain);
  courant::add("line", courant::line);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
