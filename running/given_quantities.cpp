#include "courant/running/given_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"

namespace courant {
namespace {

constexpr int kMostCorrections = 50;
// A part of a value that is round-off.
constexpr double kSameValue = 1e-9;
// A part of the terms of a quantity that is.
constexpr double kRoundOff = 1e-13;
// Likewise of the derivatives in a row.
constexpr double kNoDerivative = 1e-12;

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
    const SymbolTable symbols = experiment.model.symbols_with_energy(x, v, z, start);
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

// Some of the quantities, by their places.
using Chosen = std::vector<Index>;

const GivenQuantity& quantity_at(const InitialValues& initial, Index place) {
  return initial.quantities[static_cast<std::size_t>(place)];
}

VectorXd given_values(const InitialValues& initial, const Chosen& chosen) {
  VectorXd values(std::ssize(chosen));
  for (Index i = 0; i < values.size(); ++i)
    values[i] = quantity_at(initial, chosen[static_cast<std::size_t>(i)]).value;
  return values;
}

// Those that depend on one of the variables, or those that do not.
Chosen depending(const ExprVector& quantities, const ExprVector& variables, bool depends) {
  const std::vector<bool> does = each_depends(quantities, variables);
  Chosen chosen;
  for (Index i = 0; i < quantities.size(); ++i)
    if (does[static_cast<std::size_t>(i)] == depends) chosen.push_back(i);
  return chosen;
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

// Where a search for a zero ended, and its last step.
struct Ended {
  VectorXd y;
  double last_step = 0.0;

  bool is_settled() const { return last_step <= kSameValue * y.norm(); }
};

// A zero of map - target from y, of whose entries some move: the first N as little as they can, others as they like. An
// equation that none of these changes, as that of a loop whose angles are all given, says nothing of them. Nothing where
// the map is not finite.
std::optional<Ended> zero_near(const Function& map, const VectorXd& target, VectorXd y,
                               const VectorXd& moves, Index N) {
  double before = std::numeric_limits<double>::infinity(), last_step = 0.0;
  for (int step = 0; step < kMostCorrections; ++step) {
    const VectorXd rest = map({y}) - target;
    MatrixXd J = map.jacobian({y});
    const VectorXd whole = J.rowwise().lpNorm<Eigen::Infinity>();
    J = (J * moves.asDiagonal()).eval();
    if (!rest.allFinite() || !J.allFinite()) return std::nullopt;
    const VectorXd size = J.rowwise().lpNorm<Eigen::Infinity>();
    const Flags says_something = size.array() > kNoDerivative * whole.array();
    const VectorXd unit = says_something.select(size.cwiseInverse(), 0.0);
    const VectorXd scaled = unit.cwiseProduct(rest);
    J = unit.asDiagonal() * J;
    const VectorXd change = moves.cwiseProduct(least_change(J, N, scaled));
    y -= change;
    last_step = change.norm();
    const double now = scaled.lpNorm<Eigen::Infinity>();
    if (now <= 1e-14 * y.lpNorm<Eigen::Infinity>() || now == 0.0 || (step > 3 && now >= before))
      break;
    before = now;
  }
  return Ended{std::move(y), last_step};
}

// Which of the columns have the same entry in all solutions d of J d = b.
Flags determined(const MatrixXd& J) {
  constexpr double negligible = 1e-6;
  const VectorXd largest = J.rowwise().lpNorm<Eigen::Infinity>();
  const VectorXd unit = (largest.array() > 0.0).select(largest.cwiseInverse(), 0.0);
  const MatrixXd rows = unit.asDiagonal() * J;
  const VectorXd size = rows.colwise().lpNorm<Eigen::Infinity>();
  std::vector<Index> touched;
  for (Index j = 0; j < size.size(); ++j)
    if (size[j] > 0.0) touched.push_back(j);
  const MatrixXd scaled = rows(Eigen::all, touched) * size(touched).cwiseInverse().asDiagonal();
  Flags result = Flags::Constant(J.cols(), false);
  if (touched.empty()) return result;
  const MatrixXd open = kernel(scaled, {.data_error = 1e-9});
  for (std::size_t k = 0; k < touched.size(); ++k)
    result[touched[k]] = open.row(static_cast<Index>(k)).norm() <= negligible;
  return result;
}

// Which coordinates that are not given each quantity contains.
std::vector<std::vector<Index>> open_coordinates(const Equations& equations,
                                                 const InitialValues& initial) {
  std::vector<std::vector<Index>> open(static_cast<std::size_t>(equations.quantities.size()));
  const SparseExprMatrix of_x = jacobian(equations.quantities, equations.all.head(equations.N));
  for (std::size_t k = 0; k < of_x.col.size(); ++k)
    if (!initial.x.given[of_x.col[k]])
      open[static_cast<std::size_t>(of_x.row[k])].push_back(of_x.col[k]);
  return open;
}

// Coordinates where some quantities have their values, and which of them these determine.
struct Determination {
  VectorXd x;
  Flags is_given;
};

// By these quantities, functions of coordinates alone.
std::optional<Determination> determination(const Equations& equations, const Chosen& chosen,
                                           const InitialValues& initial) {
  const Index N = equations.N;
  const Function map("definitions", {{"x", equations.all.head(N)}}, equations.quantities(chosen),
                     {.differentiate = {"x"}});
  const VectorXd moves = (!initial.x.given).cast<double>();
  const auto found = zero_near(map, given_values(initial, chosen), initial.x.values, moves, N);
  if (!found || !found->is_settled()) return std::nullopt;
  const MatrixXd J = map.jacobian({found->y}) * moves.asDiagonal();
  if (!J.allFinite()) return std::nullopt;
  return Determination{found->y, determined(J)};
}

// Gives the coordinates that the chosen quantities determine by their own definitions, as the voltage of a capacitor does
// its charge: those of quantities that are as many as the coordinates in them. What the system says of these comes
// later: where it contradicts them, an impulse begins at them. They are held where such a quantity is.
void give_coordinates(const Equations& equations, Chosen chosen, InitialValues& initial) {
  const auto open = open_coordinates(equations, initial);
  while (!chosen.empty()) {
    const auto found = determination(equations, chosen, initial);
    if (!found) return;
    const auto is_open = [&](Index quantity) {
      return !std::ranges::all_of(open[static_cast<std::size_t>(quantity)],
                                  [&](Index i) { return found->is_given[i]; });
    };
    if (std::erase_if(chosen, is_open) > 0) continue;
    for (const Index quantity : chosen)
      for (const Index i : open[static_cast<std::size_t>(quantity)]) {
        initial.x.values[i] = found->x[i];
        initial.x.given[i] = true;
        if (quantity_at(initial, quantity).held) initial.x.held[i] = true;
      }
    return;
  }
}

// Of what is held first: it is kept whatever else is given.
void give_coordinates(const Equations& equations, InitialValues& initial) {
  const ExprVector others = equations.all.tail(equations.n + equations.m);
  const Chosen of_place = depending(equations.quantities, others, false);
  Chosen held;
  for (const Index i : of_place)
    if (quantity_at(initial, i).held) held.push_back(i);
  give_coordinates(equations, held, initial);
  give_coordinates(equations, of_place, initial);
}

// Quantities that depend on more than the coordinates that are given.
Chosen left_open(const Equations& equations, const InitialValues& initial) {
  std::vector<Expr> open;
  for (Index i = 0; i < equations.all.size(); ++i)
    if (i >= equations.N || !initial.x.given[i]) open.push_back(equations.all[i]);
  const ExprVector variables = Eigen::Map<const ExprVector>(open.data(), std::ssize(open));
  return depending(equations.quantities, variables, true);
}

// Which numbers differ by more than the round-off of the units that the equations at y measure them by: momenta that could
// stay come out of a search with 10⁻³³.
Flags moved(const VectorXd& y, const VectorXd& from, const MatrixXd& jacobian) {
  constexpr double round_off = 1e-14, vanishing = 1e-10;
  const NaturalScaling units({VectorXd::Zero(jacobian.rows()), jacobian.sparseView()}, y.cwiseAbs(),
                             round_off, vanishing);
  return (y - from).array().abs() > round_off * units.column_scale.array();
}

// A quantity that has another value and no derivative, as a kinetic energy at rest, tells no way to a state that has it: the
// first such one, by its row, else none. `rest` and J of the equations and the quantities, which come last.
std::optional<std::size_t> without_way(const InitialValues& initial, const Chosen& open,
                                       const VectorXd& rest, const MatrixXd& J) {
  for (std::size_t k = 0; k < open.size(); ++k) {
    const Index row = rest.size() - std::ssize(open) + static_cast<Index>(k);
    const double given = quantity_at(initial, open[k]).value;
    const double size = std::fabs(given) + std::fabs(given + rest[row]);
    if (J.row(row).isZero(0.0) && std::fabs(rest[row]) > kSameValue * size) return k;
  }
  return std::nullopt;
}

void check_way(const InitialValues& initial, const Chosen& open, const VectorXd& rest,
               const MatrixXd& J) {
  const auto found = without_way(initial, open, rest, J);
  if (!found) return;
  const GivenQuantity& quantity = quantity_at(initial, open[*found]);
  const double here =
      quantity.value + rest[rest.size() - std::ssize(open) + static_cast<Index>(*found)];
  throw ExperimentError(quantity.formula.pointer,
                        "is given as " + number_text(quantity.value) + " and is " +
                            number_text(here) +
                            " at the initial values, where it does not change to first order with "
                            "anything that is not given; expected coordinates or velocities that "
                            "have it");
}

// Which columns the rows of J determine and the first r of them do not: those that quantities tell, a velocity of 0 too.
Flags told(const MatrixXd& J, Index r) { return determined(J) && !determined(J.topRows(r)); }

}  // namespace

InitialValues with_quantities(const Experiment& experiment) {
  InitialValues initial = experiment.initial;
  if (initial.quantities.empty()) return initial;
  const Equations equations(experiment);
  give_coordinates(equations, initial);
  const Chosen open = left_open(equations, initial);
  if (open.empty()) return initial;
  const auto [N, n, m] = std::tuple(equations.N, equations.n, equations.m);
  const Index r = equations.residual.size(), q = std::ssize(open);
  const ExprVector both = joined(equations.residual, ExprVector(equations.quantities(open)));
  const Function map("given quantities", {{"y", equations.all}}, both, {.differentiate = {"y"}});
  // What is given stays; velocities, from those that are given, and other unknowns move as they like, and coordinates as
  // little as they can.
  VectorXd y = VectorXd::Zero(N + n + m), moves = VectorXd::Ones(y.size());
  y.head(N) = initial.x.values;
  y.segment(N, n) =
      experiment.model.system->manifold()->coframe(initial.x.values) * initial.velocity.values;
  y.tail(m) = experiment.model.system->auxiliary_guess(initial.x.values, VectorXd());
  for (Index i = 0; i < initial.z.given.size(); ++i)
    if (initial.z.given[i]) {
      y[N + n + i] = initial.z.values[i];
      moves[N + n + i] = 0.0;
    }
  moves.head(N) = (!initial.x.given).cast<double>();
  VectorXd target = VectorXd::Zero(r + q);
  target.tail(q) = given_values(initial, open);
  // Of momenta that nobody gave an energy says nothing until they follow from the velocities that were given.
  if (without_way(initial, open, map({y}) - target, map.jacobian({y}) * moves.asDiagonal())) {
    const Function of_equations("equations", {{"y", equations.all}}, equations.residual,
                                {.differentiate = {"y"}});
    VectorXd beside = moves;
    beside.segment(N, n).setZero();
    if (const auto follows = zero_near(of_equations, VectorXd::Zero(r), y, beside, N))
      y = follows->y;
    check_way(initial, open, map({y}) - target, map.jacobian({y}) * moves.asDiagonal());
  }
  const auto found = zero_near(map, target, y, moves, N);
  if (!found)
    throw ExperimentError(quantity_at(initial, open.front()).formula.pointer,
                          "is given, but the equations have no value where a state with it is "
                          "looked for");
  const bool held =
      std::ranges::any_of(open, [&](Index i) { return quantity_at(initial, i).held; });
  const MatrixXd J = map.jacobian({found->y});
  const Flags is_moved = moved(found->y, y, J), is_told = told(J * moves.asDiagonal(), r);
  // What did not move stays what it was, where quantities are no farther off with it.
  const VectorXd stays = is_moved.select(found->y, y);
  const auto missed = [&](const VectorXd& at) {
    return (map({at}) - target).tail(q).cwiseAbs().eval();
  };
  const VectorXd& point =
      (missed(stays).array() <= missed(found->y).array()).all() ? stays : found->y;
  for (Index i = 0; i < N; ++i) {
    if (initial.x.given[i] || !(is_moved[i] || is_told[i])) continue;
    initial.x.values[i] = point[i];
    initial.x.given[i] = true;
    initial.x.held[i] = initial.x.held[i] || held;
  }
  return initial;
}

std::vector<Movement> moved_quantities(const Experiment& experiment, const State& point) {
  const auto& given = experiment.initial.quantities;
  std::vector<Movement> moves;
  if (given.empty()) return moves;
  const Equations equations(experiment);
  const Function map("given quantities", {{"y", equations.all}}, equations.quantities,
                     {.differentiate = {"y"}});
  const VectorXd y = stacked(point), values = map({y});
  // What rounding of the point makes of a quantity that is 0.
  const VectorXd round_off = kRoundOff * (map.jacobian({y}).cwiseAbs() * y.cwiseAbs());
  for (Index i = 0; i < values.size(); ++i) {
    const GivenQuantity& quantity = given[static_cast<std::size_t>(i)];
    const double size = std::fabs(values[i]) + std::fabs(quantity.value);
    if (std::fabs(values[i] - quantity.value) <= std::max(kSameValue * size, round_off[i]))
      continue;
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
