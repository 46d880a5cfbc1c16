#include "courant/running/varied_start.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/numbers/central_difference.hpp"
#include "courant/core/words/message.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant {
namespace {

using Variable = Sensitivities::Variable;
using VariableKind = Variable::Kind;

// Steps of differences: this part of the size of what is typed.
constexpr double kDifference = 2e-3;
// A value that the start kept differs by no more from what was typed.
constexpr double kKept = 1e-10;
// What is left of conditions that can be met.
constexpr double kMet = 1e-9;
// So far from T M_f the measured derivative of a start that is one does not lie.
constexpr double kAlong = 1e-5;

[[noreturn]] void refuse_start(const Variable& variable, const std::string& why) {
  throw ExperimentError(variable.pointer, variable.name + " cannot be varied: " + why);
}

// The experiment with another number in the place of the variable, if it is one.
Experiment other_experiment(const Experiment& experiment, const Variable& variable, double value) {
  try {
    return with_number(experiment, variable, value);
  } catch (const ExperimentError& error) {
    refuse_start(variable, "the experiment is none with " + number_text(value) + " in its place (" +
                               error.problems().front().where + " " +
                               error.problems().front().what + ")");
  }
}

// The values that are typed, which of them the start kept, and how they change along directions.
class GivenValues {
 public:
  GivenValues(const Experiment& experiment, const VariedSystem& system, const State& start,
              const MatrixXd& D)
      : experiment_(experiment) {
    const InitialValues& initial = experiment.initial;
    const Index N = initial.x.values.size();
    const auto rates = system.rates(system.extended(start), D);
    const VectorXd velocity = experiment.model.system->manifold()->frame(start.x) * start.v;
    add(VariableKind::coordinate, initial.x, start.x, D.topRows(N));
    add(VariableKind::velocity, initial.velocity, velocity, rates.changes.rate.topRows(N));
    if (initial.z.values.size() == start.z.size())
      add(VariableKind::unknown, initial.z, start.z, rates.changes.z);
    add_quantities(system, start, D, rates.changes);
    gradients_.conservativeResize(std::ssize(places_), D.cols());
  }

  // Of all of them, or of those that are held.
  std::vector<Index> rows(bool held_alone) const {
    std::vector<Index> found;
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (!held_alone || is_held(places_[i].first, places_[i].second))
        found.push_back(static_cast<Index>(i));
    return found;
  }
  const MatrixXd& gradients() const { return gradients_; }
  // What is typed, by this number.
  VectorXd by(const Variable& variable) const {
    VectorXd slopes = VectorXd::Zero(std::ssize(places_));
    if (variable.kind == VariableKind::parameter) return by_parameter(variable);
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (places_[i] == std::pair(variable.kind, variable.index))
        slopes[static_cast<Index>(i)] = 1.0;
    return slopes;
  }
  bool has(const Variable& variable) const {
    return std::ranges::find(places_, std::pair(variable.kind, variable.index)) != places_.end();
  }
  bool is_held(VariableKind kind, Index i) const {
    const InitialValues& initial = experiment_.initial;
    switch (kind) {
      case VariableKind::coordinate:
        return initial.x.held[i];
      case VariableKind::velocity:
        return initial.velocity.held[i];
      case VariableKind::unknown:
        return initial.z.held[i];
      case VariableKind::quantity:
        return initial.quantities[static_cast<std::size_t>(i)].held;
      default:
        return false;
    }
  }

 private:
  static bool is_kept(double typed, double started) {
    return std::fabs(started - typed) <= kKept * (1.0 + std::fabs(typed));
  }
  void add_row(VariableKind kind, Index i, const Eigen::RowVectorXd& row) {
    const Index count = std::ssize(places_);
    gradients_.conservativeResize(count + 1, row.size());
    gradients_.row(count) = row;
    places_.emplace_back(kind, i);
  }
  void add(VariableKind kind, const PartialVector& values, const VectorXd& started,
           const MatrixXd& rows) {
    for (Index i = 0; i < values.given.size(); ++i)
      if (values.given[i] && is_kept(values.values[i], started[i])) add_row(kind, i, rows.row(i));
  }
  void add_quantities(const VariedSystem& system, const State& start, const MatrixXd& D,
                      const VectorFieldDifferential::Images& changes) {
    const auto& quantities = experiment_.initial.quantities;
    if (quantities.empty()) return;
    const Model& model = experiment_.model;
    std::vector<std::string> names;
    for (const Parameter& parameter : experiment_.sensitivities->parameters())
      names.push_back(parameter.name);
    Graph graph;
    const ExprVector theta = add_parameters(graph, names);
    const ExprVector x = graph.variables("x", start.x.size()),
                     v = graph.variables("v", start.v.size()),
                     z = graph.variables("z", start.z.size());
    const SymbolTable symbols = model.symbols(x, v, z, Expr(experiment_.start()));
    ExprVector formulas(std::ssize(quantities));
    for (Index i = 0; i < formulas.size(); ++i)
      formulas[i] = evaluate(quantities[static_cast<std::size_t>(i)].formula, symbols);
    const Function of("given", {{"x", joined(x, theta)}, {"v", v}, {"z", z}}, formulas,
                      {.differentiate = {"x", "v", "z"}});
    const State all = system.extended(start);
    const VectorXd values = of({all.x, start.v, start.z});
    const MatrixXd J = of.jacobian({all.x, start.v, start.z});
    const Index N = all.x.size(), n = start.v.size();
    const MatrixXd rows = J.leftCols(N) * D + J.middleCols(N, n) * changes.v.topRows(n) +
                          J.rightCols(start.z.size()) * changes.z;
    for (Index i = 0; i < formulas.size(); ++i)
      if (is_kept(quantities[static_cast<std::size_t>(i)].value, values[i]))
        add_row(VariableKind::quantity, i, rows.row(i));
  }

  double typed(const Experiment& experiment, const std::pair<VariableKind, Index>& place) const {
    const InitialValues& initial = experiment.initial;
    switch (place.first) {
      case VariableKind::coordinate:
        return initial.x.values[place.second];
      case VariableKind::velocity:
        return initial.velocity.values[place.second];
      case VariableKind::unknown:
        return initial.z.values[place.second];
      default:
        return initial.quantities[static_cast<std::size_t>(place.second)].value;
    }
  }
  // Formulas of what is typed, most of them linear in the parameter: their differences of order 8 are right to round-off.
  VectorXd by_parameter(const Variable& variable) const {
    VectorXd slopes = VectorXd::Zero(std::ssize(places_));
    const double step = kDifference * (variable.value == 0.0 ? 1.0 : std::fabs(variable.value));
    const auto all_typed = [&](double along) {
      const Experiment there = other_experiment(experiment_, variable, variable.value + along);
      VectorXd numbers(slopes.size());
      for (std::size_t i = 0; i < places_.size(); ++i)
        numbers[static_cast<Index>(i)] = typed(there, places_[i]);
      return numbers;
    };
    add_central_difference(all_typed, step, slopes);
    return slopes;
  }

  const Experiment& experiment_;
  std::vector<std::pair<VariableKind, Index>> places_;
  MatrixXd gradients_;  // a row for each that the start kept, by the directions
};

// The derivative of the start's x by the number that is typed, by differences.
VectorXd measured_start(const Experiment& experiment, const Variable& variable,
                        const State& start) {
  const double size = variable.value != 0.0 ? std::fabs(variable.value)
                                            : std::max(1e-3, start.x.lpNorm<Eigen::Infinity>());
  const double step = kDifference * size;
  VectorXd slope = VectorXd::Zero(start.x.size());
  const auto started = [&](double along) {
    try {
      const Experiment changed = with_number(experiment, variable, variable.value + along);
      const ConsistentStart there = consistent_start(changed);
      if (there.verdict != Verdict::regular)
        refuse_start(variable, "nearby the system is " + to_string(there.verdict));
      return there.point.x;
    } catch (const ExperimentError& error) {
      refuse_start(variable, "with " + number_text(variable.value + along) +
                                 " in its place the run has no start (" +
                                 error.problems().front().where + " " +
                                 error.problems().front().what + ")");
    }
  };
  add_central_difference(started, step, slope);
  return slope;
}

// What is asked of the coordinates c of a direction D c: A c is given.
struct Conditions {
  Conditions(const MatrixXd& D, Index p, const GivenValues& given, bool held_alone)
      : rows(given.rows(held_alone)), A(p + std::ssize(rows), D.cols()) {
    A << D.bottomRows(p), given.gradients()(rows, Eigen::all);
    open =
        A.rows() == 0 ? MatrixXd::Identity(D.cols(), D.cols()) : kernel(A, {.data_error = kRank});
  }
  // The least c, if there is one.
  std::optional<VectorXd> solved(const VectorXd& theta, const VectorXd& slopes) const {
    VectorXd right(A.rows());
    right << theta, slopes(rows);
    if (A.rows() == 0) return VectorXd::Zero(A.cols());
    const VectorXd c = CompleteOrthogonalDecomposition(A, kRank).solve(right);
    if ((A * c - right).norm() > kMet * (1.0 + right.norm())) return std::nullopt;
    return c;
  }

  static constexpr double kRank = 1e-10;
  std::vector<Index> rows;
  MatrixXd A, open;  // open: a basis of its kernel
};

}  // namespace

MatrixXd varied_start(const Experiment& experiment, const VariedSystem& system,
                      const State& start) {
  const std::vector<Variable>& by = experiment.sensitivities->by;
  const State all = system.extended(start);
  const MatrixXd D = system.directions(all);
  const Index N = start.x.size(), p = system.count();
  const GivenValues given(experiment, system, start, D);
  const Conditions whole(D, p, given, false), held(D, p, given, true);
  MatrixXd columns(N + p, std::ssize(by));
  Index parameter = 0;
  for (std::size_t j = 0; j < by.size(); ++j) {
    const Variable& variable = by[j];
    const bool is_parameter = variable.kind == VariableKind::parameter;
    VectorXd theta = VectorXd::Zero(p);
    if (is_parameter) theta[parameter++] = 1.0;
    const VectorXd slopes = given.by(variable);
    // Where a value that is given cannot be kept beside the others, those that are held are.
    const Conditions* kept = &whole;
    std::optional<VectorXd> c;
    if (is_parameter || given.has(variable)) c = whole.solved(theta, slopes);
    if (!c) {
      kept = &held;
      c = held.solved(theta, slopes);
    }
    if (!c)
      refuse_start(variable, "what is held beside it and the constraints leave it no other value");
    if (kept->open.cols() > 0) {
      VectorXd target(N + p);
      target << measured_start(experiment, variable, start), theta;
      const MatrixXd free = D * kept->open;
      const VectorXd rest = target - D * *c;
      const VectorXd y = CompleteOrthogonalDecomposition(free).solve(rest);
      if ((free * y - rest).norm() > kAlong * (1.0 + target.norm()))
        refuse_start(variable, "the start is no smooth function of it");
      *c += kept->open * y;
    }
    columns.col(static_cast<Index>(j)) = D * *c;
    columns.col(static_cast<Index>(j)).tail(p) = theta;
  }
  return columns;
}

}  // namespace courant
