// The energy of nonholonomic systems over many steps, by three methods: the figures of
// docs/nonholonomic-energy.md. The number of steps may be given; few of them show that it works.
//
//   L = ½ q'ᵀ M q' - V(q),   μ(q) q' = 0
//
// Method 1 discretizes the closed port-Hamiltonian system by the midpoint rule, (36) to (38) of the
// paper. Method 2 is (39) to (43), with the momentum projector in the metric M, also composed to
// order 4. The third is the discrete Lagrange–d'Alembert method of Cortés and Martínez, with the
// midpoint Lagrangian and the reaction at the node:
//
//   M (q₂ - 2 q₁ + q₀)/h² = -½ (∇V(q̄₀₁) + ∇V(q̄₁₂)) + μ(q₁)ᵀ λ,   μ(q̄₁₂) (q₂ - q₁) = 0
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/solve/newton.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/step/kinetic_metric.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/lagrangian_system.hpp"

using namespace courant;

namespace {

struct Nonholonomic {
  std::string name;
  VectorXd masses;
  std::function<Expr(const ExprVector& q)> potential;
  std::function<ExprMatrix(const ExprVector& q)> forms;  // μ, a row a constraint
  VectorXd q, v;                                         // at the start
  double h = 0.1;
};

ExprMatrix row(std::initializer_list<Expr> entries) {
  ExprMatrix matrix(1, static_cast<Index>(entries.size()));
  Index i = 0;
  for (const Expr& entry : entries) matrix(0, i++) = entry;
  return matrix;
}

std::vector<Nonholonomic> systems() {
  const auto V = [](std::initializer_list<double> entries) {
    VectorXd v(static_cast<Index>(entries.size()));
    Index i = 0;
    for (const double entry : entries) v[i++] = entry;
    return v;
  };
  return {{"particle, z' = y x', isotropic oscillator", V({1, 1, 1}),
           [](const ExprVector& q) { return 0.5 * q.squaredNorm(); },
           [](const ExprVector& q) {
             return row({-q[1], 0.0, 1.0});
           },
           V({0.4, 0.7, 0.2}), V({0.5, -0.3, 0.35})},
          {"the same in a potential without symmetry", V({1, 1, 1}),
           [](const ExprVector& q) {
             return 0.5 * (q[0] * q[0] + 1.7 * q[1] * q[1] + 2.3 * q[2] * q[2]) +
                    0.4 * q[0] * q[0] * q[1] - 0.3 * q[1] * q[2] * q[2] +
                    0.25 * q.squaredNorm() * q.squaredNorm();
           },
           [](const ExprVector& q) {
             return row({-q[1], 0.0, 1.0});
           },
           V({0.9, 0.7, 0.2}), V({0.8, -0.6, 0.56})},
          {"contact oscillators in R⁵", V({1, 1, 1, 1, 1}),
           [](const ExprVector& q) { return 0.5 * q.squaredNorm(); },
           [](const ExprVector& q) {
             return row({-q[2], -q[3], 0.0, 0.0, 1.0});
           },
           V({0.6, -0.3, 0.4, 0.8, 0.2}), V({0.1, 0.5, -0.4, 0.2, 0.44})},
          {"knife edge on a spring", V({1.2, 1.2, 0.4}),
           [](const ExprVector& q) { return 0.9 * q[0] * q[0] + 0.9 * q[1] * q[1]; },
           [](const ExprVector& q) {
             return row({sin(q[2]), -cos(q[2]), 0.0});
           },
           V({0.5, -0.3, 0.4}), V({0.8 * std::cos(0.4), 0.8 * std::sin(0.4), 1.1})},
          {"Chaplygin's sleigh on a spring", V({3.0, 3.0, 0.5}),
           [](const ExprVector& q) { return 2.0 * q[0] * q[0] + 2.6 * q[1] * q[1]; },
           [](const ExprVector& q) {
             return row({sin(q[2]), -cos(q[2]), 0.2});
           },
           V({0.5, -0.3, 0.4}),
           V({0.6 * std::cos(0.4) - 0.14 * std::sin(0.4),
              0.6 * std::sin(0.4) + 0.14 * std::cos(0.4), 0.7})},
          {"vertical rolling disk with a heavy side, on a spring", V({1.0, 1.0, 0.3, 0.6}),
           [](const ExprVector& q) {
             return 0.7 * q[0] * q[0] + 1.1 * q[1] * q[1] - 0.4 * cos(q[3]) + 0.2 * cos(q[2]);
           },
           [](const ExprVector& q) {
             ExprMatrix forms(2, 4);
             forms << 1.0, 0.0, 0.0, -0.5 * cos(q[2]), 0.0, 1.0, 0.0, -0.5 * sin(q[2]);
             return forms;
           },
           V({0.3, -0.2, 0.4, 0.5}), V({0.45 * std::cos(0.4), 0.45 * std::sin(0.4), 0.6, 0.9})},
          {"two knife edges and a spring between them", V({1.0, 1.0, 0.3, 1.4, 1.4, 0.2}),
           [](const ExprVector& q) {
             const Expr dx = q[3] - q[0], dy = q[4] - q[1];
             return 0.8 * (dx * dx + dy * dy) + 0.3 * (q[0] * q[0] + q[1] * q[1]) -
                    0.2 * cos(q[2] - q[5]);
           },
           [](const ExprVector& q) {
             ExprMatrix forms = ExprMatrix::Constant(2, 6, Expr(0.0));
             forms(0, 0) = sin(q[2]);
             forms(0, 1) = -cos(q[2]);
             forms(1, 3) = sin(q[5]);
             forms(1, 4) = -cos(q[5]);
             return forms;
           },
           V({0.5, -0.3, 0.4, -0.4, 0.2, 1.3}),
           V({0.5 * std::cos(0.4), 0.5 * std::sin(0.4), 0.8, 0.3 * std::cos(1.3),
              0.3 * std::sin(1.3), -0.6})}};
}

// H(q, p), and the size of μ(q) M⁻¹ p.
struct Measures {
  explicit Measures(const Nonholonomic& system) {
    Graph graph;
    const Index n = system.masses.size();
    const ExprVector q = graph.variables("q", n), p = graph.variables("p", n);
    const ExprVector v = constants(system.masses.cwiseInverse().eval()).cwiseProduct(p);
    const ExprVector violation = system.forms(q) * v;
    ExprVector both(1 + violation.size());
    both << 0.5 * p.dot(v) + system.potential(q), violation;
    function = Function("measures", {{"q", q}, {"p", p}}, both);
  }
  Function function;
};

// What is seen of a run: the greatest |H - H(0)| of its first and of its last tenth, the
// least-squares slope of H, and the greatest violation at the nodes.
class Record {
 public:
  explicit Record(const Nonholonomic& system, long steps) : measures_(system), steps_(steps) {}
  void add(long k, double t, const VectorXd& q, const VectorXd& p) {
    const VectorXd now = measures_.function({q, p});
    if (k == 0) first_ = now[0];
    const double drift = now[0] - first_;
    if (10 * k <= steps_) early_ = std::max(early_, std::fabs(drift));
    if (10 * k >= 9 * steps_) late_ = std::max(late_, std::fabs(drift));
    for (Index i = 1; i < now.size(); ++i) violation_ = std::max(violation_, std::fabs(now[i]));
    ++count_;
    const double before = t - mean_t_;
    mean_t_ += before / static_cast<double>(count_);
    mean_ += (drift - mean_) / static_cast<double>(count_);
    tt_ += before * (t - mean_t_);
    th_ += before * (drift - mean_);
  }
  void print(const std::string& system, const char* method) const {
    std::printf("| %s | %s | %.1e | %.1e | %+.0e | %.0e |\n", system.c_str(), method, early_, late_,
                th_ / tt_, violation_);
    std::fflush(stdout);
  }

 private:
  Measures measures_;
  long steps_;
  double first_ = 0.0, early_ = 0.0, late_ = 0.0, violation_ = 0.0;
  double mean_t_ = 0.0, mean_ = 0.0, tt_ = 0.0, th_ = 0.0;
  long count_ = 0;
};

void run(const Integrator& method, const State& start, const Nonholonomic& system, long steps,
         const char* name) {
  const Index n = system.masses.size();
  const auto stepper = method.stepper();
  State state = start;
  Record record(system, steps);
  stepper->prepare(state, system.h);
  record.add(0, 0.0, state.x.head(n), state.x.tail(n));
  try {
    for (long k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) * system.h;
      stepper->step(state, system.h, t);
      record.add(k, t, state.x.head(n), state.x.tail(n));
    }
  } catch (const SolveError& error) {
    std::printf("| %s | %s | %s |\n", system.name.c_str(), name, error.what());
    return;
  }
  record.print(system.name, name);
}

void lagrange_d_alembert(const Nonholonomic& system, const State& start, long steps) {
  const Index n = system.masses.size();
  Graph graph;
  const ExprVector step = graph.variables("Δ", n);  // q₂ - q₁
  const ExprVector q = graph.variables("q", n), p = graph.variables("p", n);
  const ExprMatrix here = system.forms(q);
  const Index m = here.rows();
  const ExprVector lambda = graph.variables("lambda", m);
  const ExprVector mass = constants(system.masses);
  const Expr h = system.h;
  const ExprVector middle = q + 0.5 * step;
  const ExprVector at = graph.variables("at", n);
  const ExprVector slope = substitute(gradient(system.potential(at), at), at, middle);
  // p is -∂L_d/∂q₁ without the reaction at q₁; after the step it is ∂L_d/∂q₂.
  ExprVector equations(n + m);
  equations << mass.cwiseProduct(step) / h + 0.5 * h * slope - p -
                   h * (here.transpose() * lambda).eval(),
      system.forms(middle) * step / h;
  ExprVector y(n + m);
  y << step, lambda;
  Newton newton(Function("Lagrange–d'Alembert", {{"y", y}, {"q", q}, {"p", p}}, equations,
                         {.differentiate = {"y"}}),
                {n, m}, {});
  const Function after("after", {{"y", y}, {"q", q}, {"p", p}},
                       mass.cwiseProduct(step) / h - 0.5 * h * slope);

  // The momentum of a node has half of its reaction: the mean of that before and that after.
  VectorXd position = start.x.head(n), momentum = start.x.tail(n);
  VectorXd unknown = VectorXd::Zero(n + m);
  unknown.head(n) = system.h * start.v.head(n);
  Record record(system, steps);
  record.add(0, 0.0, position, momentum);
  const Function forms("forms", {{"q", q}}, here.reshaped());
  for (long k = 1; k <= steps; ++k) {
    const Inputs in(unknown.data(), {position.data(), momentum.data()});
    const double scales[] = {1.0, 1e7};
    if (newton.solve(in, scales).status != Newton::Status::converged) {
      std::printf("| %s | Lagrange–d'Alembert | did not converge |\n", system.name.c_str());
      return;
    }
    if (k > 1) {
      const MatrixXd mu = forms({position}).reshaped(m, n);
      record.add(k - 1, static_cast<double>(k - 1) * system.h, position,
                 momentum + 0.5 * system.h * mu.transpose() * unknown.tail(m));
    }
    const VectorXd next = after({unknown, position, momentum});
    position += unknown.head(n);
    momentum = next;
  }
  record.print(system.name, "Lagrange–d'Alembert");
}

}  // namespace

int main(int count, char** words) {
  const long steps = count > 1 ? std::atol(words[1]) : 1000;
  const int only = count > 2 ? std::atoi(words[2]) : -1;
  std::printf("| system | method | first tenth | last tenth | slope of H | constraints |\n");
  std::printf("|---|---|---|---|---|---|\n");
  int number = 0;
  for (const Nonholonomic& system : systems()) {
    if (only >= 0 && number++ != only) continue;
    const Index n = system.masses.size();
    const auto Q = std::make_shared<Euclidean>(n);
    const auto M = std::make_shared<CotangentBundle>(Q);
    Graph sizes;
    Mechanics mechanics;
    const Index m = system.forms(sizes.variables("q", n)).rows();
    for (Index i = 0; i < m; ++i)
      mechanics.nonholonomic.names.push_back("constraint " + std::to_string(i));
    mechanics.nonholonomic.formula = [&](const ExprVector& x, const ExprVector& w, const Expr&) {
      return ExprVector(system.forms(x.head(n)) * w);
    };
    std::vector<std::string> names;
    for (const char* letter : {"q", "p"})
      for (Index i = 0; i < n; ++i) names.push_back(letter + std::to_string(i));
    const auto equations = lagrangian_system(
        M,
        [&](const ExprVector& q, const ExprVector& w, const Expr&) -> Expr {
          return 0.5 * w.dot(constants(system.masses).cwiseProduct(w)) - system.potential(q);
        },
        names, mechanics);
    VectorXd x(2 * n);
    x << system.q, system.masses.cwiseProduct(system.v);
    const ConstraintLadder ladder = ConstraintAlgorithm().run(equations, {.x = x});
    const auto map = std::make_shared<CotangentLift>(M, std::make_shared<Theta>(Q));
    const auto momenta = MomentumProjector::momenta_of(*M);
    const auto projector = std::make_shared<MomentumProjector>(
        M, kinetic_metric(equations, momenta, ladder.point.x).value().lower);
    const auto second = std::make_shared<ConstrainFirst>(equations, ladder, map, projector);
    run(DiscretizeFirst(equations, map), ladder.point, system, steps, "Method 1");
    run(*second, ladder.point, system, steps, "Method 2");
    run(Composition(second, 4), ladder.point, system, steps, "Method 2, order 4");
    lagrange_d_alembert(system, ladder.point, steps);
  }
}
