#include "courant/running/given_quantities.hpp"

#include <cmath>
#include <limits>
#include <tuple>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr int kMostCorrections = 50;
// A part of a value that is round-off.
constexpr double kSameValue = 1e-9;

// The equations of a system with those of its manifold, time derivatives of those of coordinates alone, and those of given
// quantities, as one map of (x, v, z).
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
    const Expr start = experiment.start(), t = graph.variable("t");
    all.resize(N + n + m);
    all << x, v, z;
    const ExprVector equations = system.residual(x, v, z, t);
    residual = joined(equations, M.constraint(x), rates(equations, M.frame(x) * v, x, v, z, t));
    residual = substitute(residual, ExprVector::Constant(1, t), ExprVector::Constant(1, start));
    const SymbolTable symbols = experiment.model.symbols(x, v, z, start);
    const auto& given = experiment.initial.quantities;
    quantities.resize(std::ssize(given));
    for (Index i = 0; i < quantities.size(); ++i)
      quantities[i] = evaluate(given[static_cast<std::size_t>(i)].formula, symbols);
  }

 private:
  // Of the equations without v and z: of velocities that are given only those are consistent that meet these too.
  static ExprVector rates(const ExprVector& equations, const ExprVector& velocity,
                          const ExprVector& x, const ExprVector& v, const ExprVector& z,
                          const Expr& t) {
    const std::vector<bool> others = each_depends(equations, joined(v, z));
    std::vector<Expr> places;
    for (Index i = 0; i < equations.size(); ++i)
      if (!others[static_cast<std::size_t>(i)]) places.push_back(equations[i]);
    const ExprVector of_place = Eigen::Map<const ExprVector>(places.data(), std::ssize(places));
    ExprVector at(x.size() + 1), motion(x.size() + 1);
    at << x, t;
    motion << velocity, Expr(1.0);
    return tangent(of_place, at, motion);
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

// The solution of J (dx, dy) = b with the least dx (N), whatever dy is: by the rows that no dy reaches.
VectorXd least_change(const MatrixXd& J, Index N, const VectorXd& b) {
  const MatrixXd of_x = J.leftCols(N);
  MatrixXd of_y = J.rightCols(J.cols() - N);
  VectorXd size = of_y.colwise().lpNorm<Eigen::Infinity>();
  size = (size.array() > 0.0).select(size, 1.0);
  of_y = of_y * size.cwiseInverse().asDiagonal();
  const FundamentalSubspaces spaces(of_y);
  const MatrixXd beside = spaces.left_kernel().transpose();
  VectorXd change(J.cols());
  change.head(N) = CompleteOrthogonalDecomposition(beside * of_x).solve(beside * b);
  const VectorXd rest = b - of_x * change.head(N);
  change.tail(size.size()) = spaces.pseudo_solve(rest).cwiseQuotient(size);
  return change;
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
  // What is given stays; velocities and other unknowns move as they like, and coordinates as little as they can.
  VectorXd y = VectorXd::Zero(N + n + m), moves = VectorXd::Ones(y.size());
  y.head(N) = initial.x.values;
  y.tail(m) = experiment.model.system->auxiliary_guess(initial.x.values, VectorXd());
  for (Index i = 0; i < initial.z.given.size(); ++i)
    if (initial.z.given[i]) {
      y[N + n + i] = initial.z.values[i];
      moves[N + n + i] = 0.0;
    }
  for (Index i = 0; i < N; ++i)
    if (initial.x.given[i]) moves[i] = 0.0;
  VectorXd target = VectorXd::Zero(r + q);
  target.tail(q) = given_values(experiment);
  const auto refuse = [&](const std::string& what) {
    throw ExperimentError(initial.quantities.front().formula.pointer, what);
  };
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostCorrections; ++step) {
    const VectorXd rest = map({y}) - target;
    MatrixXd J = map.jacobian({y}) * moves.asDiagonal();
    if (!rest.allFinite() || !J.allFinite())
      refuse("is given, but the equations have no value where a state with it is looked for");
    const VectorXd size =
        J.rowwise().lpNorm<Eigen::Infinity>().cwiseMax(std::numeric_limits<double>::min());
    const VectorXd scaled = rest.cwiseQuotient(size);
    J = size.cwiseInverse().asDiagonal() * J;
    y -= moves.cwiseProduct(least_change(J, N, scaled));
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
