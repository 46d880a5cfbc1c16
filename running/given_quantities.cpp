#include "courant/running/given_quantities.hpp"

#include <cmath>
#include <limits>
#include <tuple>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr int kMostCorrections = 50;
// A part of a value that is round-off.
constexpr double kSameValue = 1e-9;

// The equations of a system with those of its manifold, and those of given quantities, as one map of (x, v, z).
struct Equations {
  Graph graph;
  Index N, n, m;
  ExprVector all, residual, quantities;

  explicit Equations(const Experiment& experiment) {
    const ImplicitSystem& system = *experiment.model.system;
    const Manifold& M = *system.manifold();
    N = M.ambient_dimension();
    n = M.tangent_dimension();
    m = system.auxiliary_size();
    const ExprVector x = graph.variables("x", N), v = graph.variables("v", n),
                     z = graph.variables("z", m);
    const Expr t = experiment.start();
    all.resize(N + n + m);
    all << x, v, z;
    residual = joined(system.residual(x, v, z, t), M.constraint(x));
    const SymbolTable symbols = experiment.model.symbols(x, v, z, t);
    const auto& given = experiment.initial.quantities;
    quantities.resize(std::ssize(given));
    for (Index i = 0; i < quantities.size(); ++i)
      quantities[i] = evaluate(given[static_cast<std::size_t>(i)].formula, symbols);
  }
};

VectorXd stacked(const State& at) {
  VectorXd y(at.x.size() + at.v.size() + at.z.size());
  y << at.x, at.v, at.z;
  return y;
}

VectorXd given_values(const Experiment& experiment) {
  const auto& given = experiment.initial.quantities;
  VectorXd values(std::ssize(given));
  for (Index i = 0; i < values.size(); ++i) values[i] = given[static_cast<std::size_t>(i)].value;
  return values;
}

}  // namespace

InitialValues with_quantities(const Experiment& experiment) {
  InitialValues initial = experiment.initial;
  if (initial.quantities.empty()) return initial;
  const Equations equations(experiment);
  const auto [N, n, m] = std::tuple(equations.N, equations.n, equations.m);
  const Index r = equations.residual.size(), q = equations.quantities.size();
  ExprVector both(r + q);
  both << equations.residual, equations.quantities;
  const Function map("given quantities", {{"y", equations.all}}, both, {.differentiate = {"y"}});
  // Where neither is given, coordinates move as little as they can, and velocities and unknowns as they like.
  constexpr double free = 1e3;
  VectorXd y = VectorXd::Zero(N + n + m), width = VectorXd::Constant(y.size(), free);
  y.head(N) = initial.x.values;
  y.tail(m) = experiment.model.system->auxiliary_guess(initial.x.values, VectorXd());
  for (Index i = 0; i < initial.z.given.size(); ++i)
    if (initial.z.given[i]) {
      y[N + n + i] = initial.z.values[i];
      width[N + n + i] = 0.0;
    }
  for (Index i = 0; i < N; ++i)
    if (initial.x.given[i]) width[i] = 0.0;
  for (Index i = 0; i < N; ++i)
    if (!initial.x.given[i]) width[i] = 1.0;
  VectorXd target = VectorXd::Zero(r + q);
  target.tail(q) = given_values(experiment);
  const auto refuse = [&](const std::string& what) {
    throw ExperimentError(initial.quantities.front().formula.pointer, what);
  };
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostCorrections; ++step) {
    const VectorXd rest = map({y}) - target;
    MatrixXd J = map.jacobian({y}) * width.asDiagonal();
    if (!rest.allFinite() || !J.allFinite())
      refuse("is given, but the equations have no value where a state with it is looked for");
    const VectorXd size =
        J.rowwise().lpNorm<Eigen::Infinity>().cwiseMax(std::numeric_limits<double>::min());
    const VectorXd scaled = rest.cwiseQuotient(size);
    J = size.cwiseInverse().asDiagonal() * J;
    const VectorXd change = width.cwiseProduct(CompleteOrthogonalDecomposition(J).solve(scaled));
    y -= change;
    const double now = scaled.lpNorm<Eigen::Infinity>();
    if (now <= 1e-14 * y.lpNorm<Eigen::Infinity>() || now == 0.0 || (step > 3 && now >= before))
      break;
    before = now;
  }
  for (Index i = 0; i < N; ++i) {
    if (initial.x.given[i] || y[i] == initial.x.values[i]) continue;
    initial.x.values[i] = y[i];
    initial.x.given[i] = true;
    for (const GivenQuantity& quantity : initial.quantities)
      initial.x.held[i] = initial.x.held[i] || quantity.held;
  }
  return initial;
}

std::vector<Movement> moved_quantities(const Experiment& experiment, const State& point) {
  const auto& given = experiment.initial.quantities;
  std::vector<Movement> moves;
  if (given.empty()) return moves;
  const Equations equations(experiment);
  const VectorXd values =
      Function("given quantities", {{"y", equations.all}}, equations.quantities)({stacked(point)});
  for (Index i = 0; i < values.size(); ++i) {
    const GivenQuantity& quantity = given[static_cast<std::size_t>(i)];
    const double size = std::fabs(values[i]) + std::fabs(quantity.value);
    if (std::fabs(values[i] - quantity.value) <= kSameValue * size) continue;
    if (quantity.held)
      throw ExperimentError("/hold",
                            quantity.formula.text + " is held at " + number_text(quantity.value) +
                                ", which contradicts the constraints: at the nearest state it is " +
                                number_text(values[i]));
    moves.push_back({quantity.formula.text, quantity.value, values[i]});
  }
  return moves;
}

}  // namespace courant
