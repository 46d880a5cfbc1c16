// The ladder of large systems, by sparse rank decisions.
#include "courant/integrators/certificate/constraint_algorithm.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <string>

#include "courant/manifolds/euclidean.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"

namespace {

using namespace courant;

class FormulaSystem final : public ImplicitSystem {
 public:
  using Formula =
      std::function<ExprVector(const ExprVector&, const ExprVector&, const ExprVector&)>;
  FormulaSystem(Index n, Index m, Index r, Formula formula)
      : ImplicitSystem(std::make_shared<Euclidean>(n), m, r, {}), formula_(std::move(formula)) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr&) const override {
    return formula_(x, v, z);
  }
  Formula formula_;
};

// A ladder of unit squares in the plane, hanging from its first two joints: `joints` joints, so
// 2·joints coordinates and as many momenta; bars along both rails and on every rung, and a diagonal
// in every third square, which makes it stiff there. As many multipliers as bars.
struct Truss {
  std::shared_ptr<const ImplicitSystem> system;
  InitialGuess guess;
};

Truss truss(Index joints) {
  std::vector<std::pair<Index, Index>> bars;
  for (Index i = 0; i + 2 < joints; ++i) bars.emplace_back(i, i + 2);
  for (Index i = 2; i + 1 < joints; i += 2) bars.emplace_back(i, i + 1);
  for (Index i = 0; i + 3 < joints; i += 6) bars.emplace_back(i, i + 3);
  const auto count = static_cast<Index>(bars.size());
  const Index q = 2 * joints;
  VectorXd x = VectorXd::Zero(2 * q);
  for (Index i = 0; i < joints; ++i) {
    x[2 * i] = static_cast<double>(i % 2);
    x[2 * i + 1] = -static_cast<double>(i / 2) + 0.0;
  }
  std::vector<double> squared;
  for (const auto& [a, b] : bars)
    squared.push_back((x.segment(2 * a, 2) - x.segment(2 * b, 2)).squaredNorm());
  const VectorXd held = x.head(4);
  auto system = std::make_shared<FormulaSystem>(
      2 * q, count + 4, 2 * q + count + 4,
      [=](const ExprVector& y, const ExprVector& v, const ExprVector& z) {
        ExprVector F(2 * q + count + 4);
        F.head(q) = v.head(q) - y.tail(q);
        F.segment(q, q) = v.tail(q);
        for (Index i = 0; i < joints; ++i) F[q + 2 * i + 1] += 9.81;
        for (Index b = 0; b < count; ++b) {
          const auto [i, j] = bars[static_cast<std::size_t>(b)];
          const ExprVector d = y.segment(2 * i, 2) - y.segment(2 * j, 2);
          F[2 * q + b] = d.squaredNorm() - squared[static_cast<std::size_t>(b)];
          F.segment(q + 2 * i, 2) += z[b] * d;
          F.segment(q + 2 * j, 2) -= z[b] * d;
        }
        for (Index c = 0; c < 4; ++c) {
          F[2 * q + count + c] = y[c] - held[c];
          F[q + c] += z[count + c];
        }
        return F;
      });
  return {system, {.x = x}};
}

// A line of LC cells with node potentials and branch currents as states (modified nodal analysis):
// in each cell a capacitor to ground, an inductor to the next node, and, every tenth cell, two
// inductors in series (a cut-set) whose middle potential is determined by a derivative. Five
// unknowns a cell.
Truss circuit(Index cells) {
  const Index n = 5 * cells;  // u, i, i_1, i_2, e
  auto system = std::make_shared<FormulaSystem>(
      n, 0, n, [=](const ExprVector& x, const ExprVector& v, const ExprVector&) {
        ExprVector F(n);
        for (Index c = 0; c < cells; ++c) {
          const Index o = 5 * c;
          const Expr before = c > 0 ? x[o - 4] : Expr(0.0);
          const Expr next = c + 1 < cells ? x[o + 5] : Expr(0.0);
          F[o] = 2e-6 * v[o] + x[o + 1] + x[o + 2] - before;  // charge at the node
          F[o + 1] = 1e-3 * v[o + 1] - x[o] + next;           // inductor to the next node
          F[o + 2] = 1e-3 * v[o + 2] - x[o] + x[o + 4];       // two inductors to ground
          F[o + 3] = 2e-3 * v[o + 3] - x[o + 4];
          F[o + 4] = x[o + 2] - x[o + 3];  // cut-set
        }
        return F;
      });
  return {system, {.x = VectorXd::Constant(n, 0.1)}};
}

// The same without cut-sets as an experiment with a network, from its text to its consistent start.
std::string line(Index cells) {
  std::string nodes = "\"0\", \"n0\"", elements, initial = "\"q_C0\": 1";
  const auto element = [&](const char* type, const std::string& name, Index from,
                           const std::string& to) {
    elements += std::string(elements.empty() ? "" : ", ") + "{\"type\": \"" + type +
                "\", \"name\": \"" + name + "\", \"from\": \"n" + std::to_string(from) +
                "\", \"to\": \"" + to + "\", \"value\": 1}";
  };
  element("capacitor", "C0", 0, "0");
  for (Index c = 1; c <= cells; ++c) {
    const std::string number = std::to_string(c);
    nodes += ", \"n" + number + "\"";
    element("inductor", "L" + number, c - 1, "n" + number);
    element("capacitor", "C" + number, c, "0");
    initial += ", \"q_C" + number + "\": 0, \"phi_L" + number + "\": 0";
  }
  return "{\"system\": {\"type\": \"network\", \"nodes\": [" + nodes + "], \"elements\": [" +
         elements + "]}, \"initial\": {" + initial + "}}";
}

void report(benchmark::State& state, const ConstraintLadder& ladder) {
  state.counters["n"] = static_cast<double>(ladder.point.x.size());
  state.counters["index"] = static_cast<double>(ladder.index);
  state.counters["dof"] = static_cast<double>(ladder.degrees_of_freedom);
  state.counters["ambiguous"] = ladder.is_ambiguous() ? 1.0 : 0.0;
  state.SetLabel(to_string(ladder.verdict));
}

void holonomic(benchmark::State& state) {
  const Truss problem = truss(state.range(0));
  ConstraintLadder ladder;
  for (auto _ : state) ladder = ConstraintAlgorithm().run(problem.system, problem.guess);
  report(state, ladder);
}

void network(benchmark::State& state) {
  const Truss problem = circuit(state.range(0));
  ConstraintLadder ladder;
  for (auto _ : state) ladder = ConstraintAlgorithm().run(problem.system, problem.guess);
  report(state, ladder);
}

void experiment(benchmark::State& state) {
  const std::string text = line(state.range(0));
  ConstraintLadder ladder;
  for (auto _ : state) ladder = consistent_start(read_experiment(text));
  report(state, ladder);
}

BENCHMARK(holonomic)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK(network)->Arg(10)->Arg(100)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(experiment)->Arg(500)->Arg(5000)->Arg(50000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
