#include "courant/core/algebra/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>

#include "courant/core/algebra/collected_terms.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/linear/equilibration.hpp"
#include "courant/core/numbers/quadruple.hpp"

namespace courant {
namespace {

// A pivot is at least that part of the largest coefficient of its equation, in comparable units.
constexpr double kThreshold = 0.1;

// Sums below that part of their terms may be zero.
constexpr double kCancelled = 1e-10;

// As long as no more unknowns than that are left, fill does not matter: their matrix is dense anyway.
constexpr std::size_t kDense = 64;

// The variables that expressions are made of.
ExprVector variables_of(const ExprVector& expressions) {
  const Subgraph subgraph(expressions);
  std::vector<Expr> found;
  for (const std::uint32_t node : subgraph.nodes())
    if (subgraph.graph().node(node).op == Op::variable)
      found.push_back(subgraph.graph().expression(node));
  return Eigen::Map<const ExprVector>(found.data(), static_cast<Index>(found.size()));
}

// What is never zero, being a step size, may be of these sizes, next to the natural one.
constexpr double kSteps[] = {1e-2, 1e-6, 1e-11};
using Sizes = Eigen::Array3d;

// The entries of a Jacobian at a generic point, for different step sizes.
class GenericEntries {
 public:
  GenericEntries(const SparseExprMatrix& J, const ExprVector& never_zero) : J_(J) {
    const ExprVector variables = variables_of(J.values);
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    point_ = VectorXd::NullaryExpr(variables.size(), [&] { return uniform(generator); });
    is_step_ = VectorXd::Zero(variables.size());
    for (Index i = 0; i < variables.size(); ++i)
      if (std::find(never_zero.begin(), never_zero.end(), variables[i]) != never_zero.end())
        is_step_[i] = 1.0;
    entries_ = Function("entries", {{"p", variables}}, J.values);
  }

  VectorXd at(double step) const {
    const VectorXd point = (is_step_.array() > 0.0).select(step * point_, point_);
    return entries_({point});
  }

  // The same in comparable units.
  VectorXd in_units(double step) const {
    VectorXd entries = at(step);
    std::vector<Eigen::Triplet<double>> finite;
    for (Index k = 0; k < entries.size(); ++k)
      if (std::isfinite(entries[k]) && entries[k] != 0.0)
        finite.emplace_back(static_cast<int>(row(k)), static_cast<int>(column(k)), entries[k]);
    SparseMatrixXd A(J_.rows, J_.cols);
    A.setFromTriplets(finite.begin(), finite.end());
    const Equilibration<SparseMatrixXd> units = equilibrate(A, 0.0);
    for (Index k = 0; k < entries.size(); ++k)
      entries[k] *= units.row_scale[row(k)] * units.column_scale[column(k)];
    return entries;
  }

  // The step h for which units r, c make entries as equal as can be, to a power of a thousand: with
  // |a_ij| = l_ij h^k_ij around the last guess, the least of
  //
  //   Σ (log l_ij + k_ij log h + log r_i + log c_j)².
  //
  // It goes with the unit of time of the equations. 1 where they have none.
  double natural_step() const {
    constexpr int rounds = 4;
    constexpr double least_power = 1e-3, most = 100.0;
    double logarithm = 0.0;
    if (!(is_step_.array() > 0.0).any()) return 1.0;
    for (int round = 0; round < rounds; ++round) {
      const VectorXd less = at(0.5 * std::exp(logarithm)), more = at(2.0 * std::exp(logarithm));
      VectorXd size = VectorXd::Zero(less.size()), power = size;
      std::vector<Index> known;
      for (Index k = 0; k < less.size(); ++k) {
        const double below = std::log(std::fabs(less[k])), above = std::log(std::fabs(more[k]));
        if (!std::isfinite(below) || !std::isfinite(above)) continue;
        known.push_back(k);
        size[k] = 0.5 * (below + above);
        power[k] = (above - below) / std::log(4.0);
      }
      level(size, known);
      level(power, known);
      if (!(power.squaredNorm() > least_power * static_cast<double>(known.size()))) break;
      logarithm = std::clamp(logarithm - power.dot(size) / power.squaredNorm(), -most, most);
    }
    const double thousands = std::log(1000.0);
    return std::pow(1000.0, std::round(logarithm / thousands));
  }

 private:
  Index row(Index k) const { return J_.row[static_cast<std::size_t>(k)]; }
  Index column(Index k) const { return J_.col[static_cast<std::size_t>(k)]; }

  // Takes from numbers, one for each known entry, what a sum of one for each row and one for each column
  // can take.
  void level(VectorXd& numbers, const std::vector<Index>& known) const {
    constexpr int sweeps = 60;
    VectorXd row_count = VectorXd::Zero(J_.rows), column_count = VectorXd::Zero(J_.cols);
    for (const Index k : known) row_count[row(k)] += 1.0, column_count[column(k)] += 1.0;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      VectorXd sum = VectorXd::Zero(J_.rows);
      for (const Index k : known) sum[row(k)] += numbers[k];
      for (const Index k : known) numbers[k] -= sum[row(k)] / row_count[row(k)];
      sum = VectorXd::Zero(J_.cols);
      for (const Index k : known) sum[column(k)] += numbers[k];
      for (const Index k : known) numbers[k] -= sum[column(k)] / column_count[column(k)];
    }
  }

  const SparseExprMatrix& J_;
  VectorXd point_, is_step_;
  Function entries_;
};

// The Jacobian while pivots are taken out of it.
class Tableau {
 public:
  Tableau(const SparseExprMatrix& J, const ExprVector& never_zero, std::vector<int> coarseness)
      : never_zero_(never_zero),
        coarseness_(std::move(coarseness)),
        rows_(static_cast<std::size_t>(J.rows)),
        columns_(static_cast<std::size_t>(J.cols)) {
    Eigen::Array<double, Eigen::Dynamic, 3> generic(J.values.size(), 3);
    const GenericEntries entries(J, never_zero);
    const double step = entries.natural_step();
    for (Index i = 0; i < 3; ++i) generic.col(i) = entries.in_units(kSteps[i] * step);
    for (std::size_t k = 0; k < J.row.size(); ++k) {
      const auto entry = static_cast<Index>(k);
      rows_[static_cast<std::size_t>(J.row[k])].emplace(J.col[k],
                                                        Entry{J.values[entry], generic.row(entry)});
      columns_[static_cast<std::size_t>(J.col[k])].insert(J.row[k]);
      columns_left_.insert(J.col[k]);
    }
  }

  struct Chosen {
    Elimination::Pivot pivot;
    Expr coefficient;
  };

  // Takes pivots away that have nothing to do with each other: none of their equations contains the
  // unknown of another one, now or before. Empty: nothing is left to take.
  std::vector<Chosen> round() {
    std::vector<std::pair<std::size_t, Elimination::Pivot>> candidates;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (const auto& [j, entry] : rows_[i])
        if (const auto cost = cost_of(static_cast<Index>(i), j))
          candidates.push_back({*cost, {static_cast<Index>(i), j}});
    // Of equal ones the last unknown first: multipliers and jets come after the state.
    std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first : a.second.unknown > b.second.unknown;
    });
    std::vector<bool> is_touched(rows_.size(), false);
    std::set<Index> blocked;
    std::vector<Chosen> taken;
    for (const auto& [cost, pivot] : candidates) {
      const auto i = static_cast<std::size_t>(pivot.equation);
      if (is_touched[i] || blocked.contains(pivot.unknown)) continue;
      const bool meets_taken = std::any_of(rows_[i].begin(), rows_[i].end(), [&](const auto& e) {
        return columns_[static_cast<std::size_t>(e.first)].empty();
      });
      const auto cost_now = cost_of(pivot.equation, pivot.unknown);
      if (meets_taken || !cost_now || *cost_now > cost) continue;
      for (const auto& [j, entry] : rows_[i]) blocked.insert(j);
      taken.push_back({pivot, rows_[i].at(pivot.unknown).coefficient});
      for (const Index k : columns_[static_cast<std::size_t>(pivot.unknown)])
        is_touched[static_cast<std::size_t>(k)] = true;
      take(pivot);
    }
    return taken;
  }

 private:
  struct Entry {
    Expr coefficient;
    Sizes generic;  // NaN where it is not known, 0 where it may vanish
  };
  using Row = std::map<Index, Entry>;

  // Whether a is made of numbers and of parameters that are never zero.
  bool is_never_zero(const Expr& a) const {
    std::vector<Expr> left = {a};
    std::set<std::uint32_t> visited;
    while (!left.empty()) {
      const Expr factor = left.back();
      left.pop_back();
      if (factor.is_constant()) {
        if (factor.is_constant(0.0) || !std::isfinite(factor.value())) return false;
        continue;
      }
      if (!visited.insert(factor.node()).second ||
          std::find(never_zero_.begin(), never_zero_.end(), factor) != never_zero_.end())
        continue;
      const Graph& graph = factor.graph();
      const Node& node = graph.node(factor.node());
      switch (node.op) {
        case Op::multiply:
        case Op::divide:
          left.push_back(graph.expression(node.b));
          [[fallthrough]];
        case Op::negate:
        case Op::power:
          left.push_back(graph.expression(node.a));
          break;
        default:
          return false;
      }
    }
    return true;
  }

  // How many entries may be filled if y_j is taken out of equation i; nothing if it must not be.
  std::optional<std::size_t> cost_of(Index i, Index j) const {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    const auto found = row.find(j);
    if (found == row.end()) return std::nullopt;
    const std::size_t others = row.size() - 1;
    const std::size_t elsewhere = columns_[static_cast<std::size_t>(j)].size() - 1;
    const std::size_t cost = others * elsewhere;
    if (columns_left_.size() > kDense && cost > others + elsewhere) return std::nullopt;
    Sizes largest = Sizes::Zero();
    for (const auto& [l, entry] : row) {
      if (coarseness_[static_cast<std::size_t>(l)] > coarseness_[static_cast<std::size_t>(j)])
        return std::nullopt;
      // The comparison is false where an entry is not known, and the pivot not allowed.
      for (Index i = 0; i < largest.size(); ++i)
        if (!(largest[i] >= std::fabs(entry.generic[i]))) largest[i] = std::fabs(entry.generic[i]);
    }
    const Sizes& size = found->second.generic;
    const bool is_large = (size.abs() >= kThreshold * largest).all();
    if (cost > 0 && !is_large) return std::nullopt;
    if ((size == 0.0).any() || !is_never_zero(found->second.coefficient)) return std::nullopt;
    return cost;
  }

  // a_kl - a_kj a_il / a_ij for all other k and l, and away with equation i and unknown j.
  void take(const Elimination::Pivot& pivot) {
    Row pivot_row = std::move(rows_[static_cast<std::size_t>(pivot.equation)]);
    rows_[static_cast<std::size_t>(pivot.equation)].clear();
    const Entry a = pivot_row.at(pivot.unknown);
    pivot_row.erase(pivot.unknown);
    for (const auto& [l, entry] : pivot_row)
      columns_[static_cast<std::size_t>(l)].erase(pivot.equation);
    auto& column = columns_[static_cast<std::size_t>(pivot.unknown)];
    column.erase(pivot.equation);
    for (const Index k : column) {
      Row& row = rows_[static_cast<std::size_t>(k)];
      const Entry factor = row.at(pivot.unknown);
      row.erase(pivot.unknown);
      for (const auto& [l, entry] : pivot_row) subtract(k, row, l, factor, entry, a);
    }
    column.clear();
    columns_left_.erase(pivot.unknown);
  }

  void subtract(Index k, Row& row, Index l, const Entry& factor, const Entry& entry,
                const Entry& pivot) {
    const auto [place, is_new] = row.try_emplace(l, Entry{Expr(0.0), Sizes::Zero()});
    Entry& target = place->second;
    const Sizes terms = factor.generic * entry.generic / pivot.generic;
    const Sizes sums = target.generic - terms;
    target.coefficient =
        target.coefficient - factor.coefficient * entry.coefficient / pivot.coefficient;
    target.generic = (sums.abs() <= kCancelled * terms.abs()).select(Sizes::Zero(), sums);
    if (target.coefficient.is_constant(0.0)) {
      row.erase(place);
      columns_[static_cast<std::size_t>(l)].erase(k);
    } else if (is_new) {
      columns_[static_cast<std::size_t>(l)].insert(k);
    }
  }

  const ExprVector& never_zero_;
  std::vector<int> coarseness_;
  std::vector<Row> rows_;
  std::vector<std::set<Index>> columns_;  // the rows of each
  std::set<Index> columns_left_;
};

// Generic points.
constexpr int kPoints = 3;
std::vector<VectorXd> generic_points(Index variables) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(0.3, 0.9);
  std::vector<VectorXd> points;
  for (int k = 0; k < kPoints; ++k)
    points.push_back(VectorXd::NullaryExpr(variables, [&] { return uniform(generator); }));
  return points;
}

template <class Number>
std::vector<Number> values_at(const Function& function, const VectorXd& point) {
  const std::vector<Number> at(point.begin(), point.end());
  std::vector<Number> values(static_cast<std::size_t>(function.output_size()));
  const Number* in[] = {at.data()};
  function.taylor_with_jacobian(in, 0, values.data());
  return values;
}

// Which expressions are zero for all values of their variables, as cos² a + sin² a - 1: at generic points they are no
// more than round-off, and shrink with it when the digits double. A bound of the round-off alone is no evidence: of a
// chain of hundreds of equations it grows beyond all numbers.
std::vector<bool> are_identities(const ExprVector& expressions) {
  constexpr double shrunk = 1e-10;  // doubles have 10⁻¹⁶, and the others 10⁻³⁴
  const ExprVector variables = variables_of(expressions);
  const std::vector<VectorXd> points = generic_points(variables.size());
  const Function all("identities", {{"p", variables}}, expressions);
  std::vector<bool> result(static_cast<std::size_t>(expressions.size()), true);
  for (const VectorXd& point : points) {
    const auto values = values_at<Uncertain>(all, point);
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = result[i] && std::fabs(values[i].value) <= values[i].error;
  }
  std::vector<Index> small;
  for (std::size_t i = 0; i < result.size(); ++i)
    if (result[i]) small.push_back(static_cast<Index>(i));
  if (small.empty()) return result;
  const Function some("identities", {{"p", variables}}, expressions(small));
  for (const VectorXd& point : points) {
    const auto coarse = values_at<Uncertain>(some, point);
    const auto fine = values_at<Quadruple>(some, point);
    for (std::size_t i = 0; i < small.size(); ++i) {
      const double number = std::fabs(coarse[i].value),
                   more = std::fabs(static_cast<double>(fine[i]));
      // Of functions that have no value in more digits the bound is all that is known.
      if (number > 0.0 && more > shrunk * number)
        result[static_cast<std::size_t>(small[i])] = false;
    }
  }
  return result;
}

// The unknowns that expressions contain, but by which all their derivatives are zero.
ExprVector without_influence(const ExprVector& expressions, const ExprVector& unknowns) {
  const SparseExprMatrix J = jacobian(expressions, unknowns);
  const std::vector<bool> is_zero = are_identities(J.values);
  std::vector<int> entries(static_cast<std::size_t>(unknowns.size())), zeros = entries;
  for (std::size_t k = 0; k < is_zero.size(); ++k) {
    const auto j = static_cast<std::size_t>(J.col[k]);
    ++entries[j];
    if (is_zero[k]) ++zeros[j];
  }
  std::vector<Index> found;
  for (std::size_t j = 0; j < entries.size(); ++j)
    if (entries[j] > 0 && zeros[j] == entries[j]) found.push_back(static_cast<Index>(j));
  return unknowns(found);
}

}  // namespace

Elimination::Elimination(const ExprVector& F, const ExprVector& y, const Options& options)
    : equations(collected(F)), unknowns(y) {
  std::vector<int> coarseness = options.coarseness;
  if (coarseness.empty()) coarseness.assign(static_cast<std::size_t>(y.size()), 0);
  if (std::ssize(coarseness) != y.size())
    throw std::invalid_argument(
        "Elimination: the coarseness has " + std::to_string(coarseness.size()) +
        " entries, expected one for each of the " + std::to_string(y.size()) + " unknowns.");
  std::vector<bool> is_done(static_cast<std::size_t>(F.size()), false);
  std::vector<bool> is_given(static_cast<std::size_t>(y.size()), false);
  const SparseExprMatrix J = jacobian(equations, y);
  Tableau tableau(J, options.never_zero, coarseness);
  for (auto taken = tableau.round(); !taken.empty(); taken = tableau.round()) {
    const auto count = static_cast<Index>(taken.size());
    ExprVector variables(count), rest(count);
    for (Index k = 0; k < count; ++k) {
      const Pivot& pivot = taken[static_cast<std::size_t>(k)].pivot;
      variables[k] = y[pivot.unknown];
      rest[k] = equations[pivot.equation];
    }
    ExprVector formulas = substitute(rest, variables, ExprVector::Constant(count, Expr(0.0)));
    for (Index k = 0; k < count; ++k)
      formulas[k] = -formulas[k] / taken[static_cast<std::size_t>(k)].coefficient;
    for (const auto& [pivot, coefficient] : taken) {
      is_done[static_cast<std::size_t>(pivot.equation)] = true;
      is_given[static_cast<std::size_t>(pivot.unknown)] = true;
      equations[pivot.equation] = Expr(0.0);
      pivots.push_back(pivot);
    }
    const ExprVector all = substitute(joined(equations, unknowns), variables, formulas);
    equations = all.head(F.size());
    unknowns = all.tail(y.size());
  }
  equations = collected(equations, y);
  unknowns = collected(unknowns, variables_of(unknowns));
  for (Index i = 0; i < F.size(); ++i)
    if (!is_done[static_cast<std::size_t>(i)] && !equations[i].is_constant(0.0))
      remaining.push_back(i);
  equations = equations(remaining).eval();
  // Equations that repeat others are round-off once those have been put into them, and so are the
  // coefficients of unknowns that then only the others tell apart, as two multipliers of one force.
  const std::vector<bool> is_identity = are_identities(equations);
  std::vector<Index> others, places;
  for (std::size_t i = 0; i < remaining.size(); ++i) {
    if (is_identity[i]) continue;
    others.push_back(remaining[i]);
    places.push_back(static_cast<Index>(i));
  }
  if (places.size() < remaining.size()) {
    remaining = others;
    equations = equations(places).eval();
    const ExprVector open = without_influence(equations, y);
    equations = substitute(equations, open, ExprVector::Constant(open.size(), Expr(0.0)));
  }
  for (Index j = 0; j < y.size(); ++j)
    if (!is_given[static_cast<std::size_t>(j)]) kept.push_back(j);
  if (options.is_regular) take_last_ones(y, coarseness);
}

// Unknowns that one equation alone contains, and that is affine in it; then those that are so without this one.
void Elimination::take_last_ones(const ExprVector& y, const std::vector<int>& coarseness) {
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    const SparseExprMatrix J = jacobian(equations, y(kept));
    std::vector<std::size_t> entries(kept.size(), 0), last(kept.size(), 0);
    for (std::size_t k = 0; k < J.row.size(); ++k) {
      const auto j = static_cast<std::size_t>(J.col[k]);
      ++entries[j];
      last[j] = k;
    }
    for (std::size_t j = 0; j < kept.size() && !goes_on; ++j) {
      const ExprVector unknown = ExprVector::Constant(1, y[kept[j]]);
      const Expr slope = entries[j] == 1 ? J.values[static_cast<Index>(last[j])] : Expr(0.0);
      if (entries[j] != 1 || depends(ExprVector::Constant(1, slope), unknown)) continue;
      const auto row = static_cast<std::size_t>(J.row[last[j]]);
      const auto coarse = [&](std::size_t k) {
        return coarseness[static_cast<std::size_t>(kept[k])];
      };
      bool is_coarsest = true;
      for (std::size_t k = 0; k < J.row.size(); ++k)
        if (J.row[k] == static_cast<Index>(row))
          is_coarsest &= coarse(static_cast<std::size_t>(J.col[k])) <= coarse(j);
      if (!is_coarsest) continue;
      const Expr rest = substitute(equations[static_cast<Index>(row)], unknown,
                                   ExprVector::Constant(1, Expr(0.0)));
      const ExprVector formula = ExprVector::Constant(1, -rest / slope);
      unknowns = substitute(unknowns, unknown, formula);
      pivots.push_back({remaining[row], kept[j]});
      remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(row));
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(j));
      std::vector<Index> left(static_cast<std::size_t>(equations.size()));
      std::iota(left.begin(), left.end(), Index{0});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(row));
      equations = ExprVector(equations(left));
      goes_on = true;
    }
  }
}

}  // namespace courant
