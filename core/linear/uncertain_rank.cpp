#include "courant/core/linear/uncertain_rank.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/product_scaling.hpp"
#include "courant/core/linear/rank_cut.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/linear/sparse_rank_decision.hpp"
#include "courant/core/linear/uncertain_elimination.hpp"

namespace courant {
namespace {

// Singular values cost 4 m n min(m, n) operations; from here on sparse factorisation is faster.
constexpr Index dense_limit = 200;

// A singular value counted is at least this many thresholds, and one that does not count at most
// that part of one, or the decision is doubtful. Measured on ladders whose dimensions are known:
// singular values that are zero come out at less than a fifth of the bound.
constexpr double clearly_above = 10.0, clearly_below = 0.5;

// How many times its error a pivot can be said to be.
constexpr double kExact = 1.0 / std::numeric_limits<double>::epsilon();

// The matrix while pivots that are alone in their row or column are taken away, and the blocks that
// are left.
class Peeling {
 public:
  explicit Peeling(const UncertainMatrix& A)
      : rows_(static_cast<std::size_t>(A.rows())), columns_(static_cast<std::size_t>(A.cols())) {
    each(A.value, [&](std::size_t i, std::size_t j, double value) {
      if (!std::isfinite(value)) is_finite_ = false;
      add(values_, &Line::values, {i, j, value, 0.0});
    });
    each(A.error, [&](std::size_t i, std::size_t j, double error) {
      if (!std::isfinite(error)) is_finite_ = false;
      // Values are sorted by column, then row: the one of this place, if there is one.
      const auto& column = columns_[j].values;
      const auto found =
          std::lower_bound(column.begin(), column.end(), i,
                           [&](std::size_t at, std::size_t row) { return values_[at].row < row; });
      if (found != column.end() && values_[*found].row == i)
        values_[*found].error = error;
      else if (error != 0.0)
        add_zero({i, j, 0.0, error});
    });
    for (auto* lines : {&rows_, &columns_})
      for (Line& line : *lines) line.count = line.values.size();
  }

  bool is_finite() const { return is_finite_; }

  // Takes pivots away while there are any that hide no number; others are left to the blocks. Returns
  // how many times its error each one is.
  std::vector<double> pivots() {
    for (auto* lines : {&rows_, &columns_})
      for (Line& line : *lines)
        if (line.count == 1) single_.push_back(&line);
    std::vector<double> margins;
    while (!single_.empty()) {
      Line& line = *single_.back();
      single_.pop_back();
      if (line.is_gone || line.count != 1) continue;
      const auto at = std::find_if(line.values.begin(), line.values.end(),
                                   [&](std::size_t v) { return is_there(values_[v]); });
      const Entry pivot = values_[*at];
      if (hides_numbers(pivot)) continue;
      const double margin = std::fabs(pivot.value) / pivot.error;
      margins.push_back(std::min(margin, kExact));
      carry_errors(pivot);
      for (Line* gone : {&rows_[pivot.row], &columns_[pivot.column]}) {
        for (const std::size_t v : gone->values) {
          if (!is_there(values_[v])) continue;
          count_less(values_[v]);
        }
        gone->is_gone = true;
      }
    }
    return margins;
  }

  // The blocks of what is left.
  std::vector<UncertainMatrix> blocks() const {
    const std::size_t m = rows_.size();
    std::vector<std::size_t> parent(m + columns_.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (const Entry& entry : values_)
      if (is_there(entry)) parent[root(entry.row)] = root(m + entry.column);

    struct Block {
      Index rows = 0, columns = 0;
      std::vector<Eigen::Triplet<double>> values, errors;
    };
    std::vector<Block> blocks;
    std::vector<std::size_t> number(parent.size(), parent.size());
    std::vector<int> place(parent.size(), -1);
    const auto block_of = [&](std::size_t vertex) -> Block& {
      std::size_t& index = number[root(vertex)];
      if (index == parent.size()) {
        index = blocks.size();
        blocks.emplace_back();
      }
      return blocks[index];
    };
    const auto locate = [&](std::size_t vertex, Index Block::*size) {
      if (place[vertex] < 0) place[vertex] = static_cast<int>((block_of(vertex).*size)++);
      return place[vertex];
    };
    for (const Entry& entry : values_) {
      if (!is_there(entry)) continue;
      const int i = locate(entry.row, &Block::rows);
      const int j = locate(m + entry.column, &Block::columns);
      block_of(entry.row).values.emplace_back(i, j, entry.value);
      block_of(entry.row).errors.emplace_back(i, j, entry.error);
    }
    // What errors couple blocks changes singular values by a product of two of them.
    for (const Entry& zero : zeros_) {
      if (!is_there(zero) || place[zero.row] < 0 || place[m + zero.column] < 0) continue;
      if (root(zero.row) != root(m + zero.column)) continue;
      block_of(zero.row).errors.emplace_back(place[zero.row], place[m + zero.column], zero.error);
    }
    std::vector<UncertainMatrix> result;
    for (const Block& block : blocks) {
      UncertainMatrix A{SparseMatrixXd(block.rows, block.columns),
                        SparseMatrixXd(block.rows, block.columns)};
      A.value.setFromTriplets(block.values.begin(), block.values.end());
      A.error.setFromTriplets(block.errors.begin(), block.errors.end());
      result.push_back(std::move(A));
    }
    return result;
  }

 private:
  struct Entry {
    std::size_t row, column;
    double value, error;
    bool is_gone = false;
  };
  struct Line {
    std::vector<std::size_t> values;  // entries that are not zero
    std::vector<std::size_t> zeros;   // zeros that are not exact
    std::size_t count = 0;            // values in lines that are still there
    bool is_gone = false;
  };

  template <class Visit>
  static void each(const SparseMatrixXd& M, const Visit& visit) {
    for (Index j = 0; j < M.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(M, j); it; ++it)
        visit(static_cast<std::size_t>(it.row()), static_cast<std::size_t>(j), it.value());
  }

  void add(std::vector<Entry>& list, std::vector<std::size_t> Line::*of, const Entry& entry) {
    (rows_[entry.row].*of).push_back(list.size());
    (columns_[entry.column].*of).push_back(list.size());
    list.push_back(entry);
  }

  bool is_there(const Entry& entry) const {
    return !entry.is_gone && !rows_[entry.row].is_gone && !columns_[entry.column].is_gone;
  }

  // The lines of an entry that goes.
  void count_less(const Entry& entry) {
    for (Line* line : {&rows_[entry.row], &columns_[entry.column]})
      if (--line->count == 1) single_.push_back(line);
  }

  // The error of a place grows. An entry that it covers is a zero from then on.
  void add_error(std::size_t row, std::size_t column, double error) {
    for (const std::size_t v : rows_[row].values) {
      Entry& entry = values_[v];
      if (entry.column != column || entry.is_gone) continue;
      entry.error += error;
      if (std::fabs(entry.value) > entry.error) return;
      error = entry.error + std::fabs(entry.value);
      count_less(entry);
      entry.is_gone = true;
      break;
    }
    add_zero({row, column, 0.0, error});
  }

  // One entry a place, however many errors it collects: they add up.
  void add_zero(const Entry& zero) {
    const auto [found, is_new] =
        place_of_zero_.try_emplace(zero.row * columns_.size() + zero.column, zeros_.size());
    if (is_new)
      add(zeros_, &Line::zeros, zero);
    else
      zeros_[found->second].error += zero.error;
  }

  // The pivot a_ij is eliminated from the rest, a_kl - a_kj a_il / a_ij, where one of the factors
  // is a zero that is not exact: visits each (k, l) with the error that this brings.
  template <class Visit>
  void each_carried_error(const Entry& pivot, const Visit& visit) const {
    const auto carry = [&](const Entry& in_column, const Entry& in_row) {
      if (in_column.row == pivot.row || in_row.column == pivot.column) return;
      if (!is_there(in_column) || !is_there(in_row)) return;
      const auto size = [](const Entry& entry) {
        return entry.value == 0.0 ? entry.error : std::fabs(entry.value);
      };
      visit(in_column.row, in_row.column, size(in_column) * size(in_row) / std::fabs(pivot.value));
    };
    // Copies: the lists grow meanwhile, by entries of other lines.
    const std::vector<std::size_t> row_zeros = rows_[pivot.row].zeros;
    const std::vector<std::size_t> column_zeros = columns_[pivot.column].zeros;
    for (const std::size_t z : row_zeros) {
      for (const std::size_t v : columns_[pivot.column].values)
        carry(Entry(values_[v]), Entry(zeros_[z]));
      for (const std::size_t v : column_zeros) carry(Entry(zeros_[v]), Entry(zeros_[z]));
    }
    for (const std::size_t z : column_zeros)
      for (const std::size_t v : rows_[pivot.row].values)
        carry(Entry(zeros_[z]), Entry(values_[v]));
  }

  void carry_errors(const Entry& pivot) {
    each_carried_error(pivot, [&](std::size_t row, std::size_t column, double error) {
      add_error(row, column, error);
    });
  }

  // Whether an entry that is clearly a number would no longer be one beside the errors that the pivot
  // brings, as those of a pivot of 10⁻⁵ in a row whose other entry is 0 ± 10⁻³ next to 10¹².
  bool hides_numbers(const Entry& pivot) const {
    bool hides = false;
    each_carried_error(pivot, [&](std::size_t row, std::size_t column, double error) {
      for (const std::size_t v : rows_[row].values) {
        const Entry& entry = values_[v];
        if (hides || entry.column != column || entry.is_gone) continue;
        const double least = std::fabs(entry.value) / clearly_above;
        hides = entry.error <= least && entry.error + error > least;
      }
    });
    return hides;
  }

  std::vector<Entry> values_, zeros_;
  std::unordered_map<std::size_t, std::size_t> place_of_zero_;  // in zeros_
  std::vector<Line> rows_, columns_;
  std::vector<Line*> single_;  // lines with one entry, or that had one
  bool is_finite_ = true;
};

// ‖E‖ ≤ (‖E‖₁ ‖E‖_∞)^½ for E ≥ 0.
double norm_bound(const SparseMatrixXd& E) {
  VectorXd rows = VectorXd::Zero(E.rows()), columns = VectorXd::Zero(E.cols());
  for (Index j = 0; j < E.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(E, j); it; ++it) {
      rows[it.row()] += it.value();
      columns[j] += it.value();
    }
  return E.nonZeros() == 0 ? 0.0 : std::sqrt(rows.maxCoeff() * columns.maxCoeff());
}

// The singular values of a scaled block in units of what they have to be above to count.
RankDecision decide_scaled(const UncertainMatrix& A) {
  const double error = std::max(norm_bound(A.error), std::numeric_limits<double>::min());
  const RankOptions options{.magnitude = 1.0, .error_norm = error};
  const bool is_dense = std::max(A.rows(), A.cols()) <= dense_limit;
  RankDecision decision =
      is_dense ? decide_rank(MatrixXd(A.value), options) : decide_rank(A.value, options);
  // The threshold once more: conclude() of the decision puts a threshold between the values.
  const double largest = decision.singular_values.size() == 0 ? 0.0 : decision.singular_values[0];
  const double floor = noise_level(A.rows(), A.cols(), largest, options).floor;
  decision.singular_values /= floor;
  decision.above = decision.rank > 0 ? decision.above / floor : kExact;
  decision.below /= floor;
  return decision;
}

bool is_doubtful(const RankDecision& decision) {
  return decision.above < clearly_above || decision.below > clearly_below;
}

// The larger of the entries and 10⁸ times their errors: scales that level it leave errors at 10⁻⁸, also
// those of entries that are 0. Scales that see the entries alone make a row that has one small entry
// large, with the error beside it.
SparseMatrixXd heeding_errors(const UncertainMatrix& A) {
  constexpr double heeded = 1e8, largest = 1e300;
  const SparseMatrixXd error =
      A.error.unaryExpr([](double size) { return std::min(size, largest / heeded) * heeded; });
  return SparseMatrixXd(A.value.cwiseAbs()).cwiseMax(error);
}

// By elimination, each pivot in units of its error.
RankDecision eliminated(const UncertainMatrix& A) {
  const UncertainElimination elimination(A);
  RankDecision decision;
  decision.rank = elimination.rank;
  decision.rows = A.rows();
  decision.columns = A.cols();
  decision.singular_values.resize(elimination.rank);
  for (Index i = 0; i < elimination.rank; ++i)
    decision.singular_values[i] =
        std::min(elimination.margins[static_cast<std::size_t>(i)], kExact);
  decision.above = decision.rank > 0 ? decision.singular_values.minCoeff() : kExact;
  decision.below = elimination.left;
  return decision;
}

// Every scaling proves a rank, and none proves too much. Where the first does not prove all that there
// could be, the others may: the second does not see small entries, the first does not see which are
// large, and the third sees errors.
RankDecision decide_block(const UncertainMatrix& A) {
  const Equilibration<SparseMatrixXd> units = equilibrate(A.value, 0.0);
  const auto decided = [](const UncertainMatrix& of, const auto& scales) {
    const auto scaled = [&](const SparseMatrixXd& M) {
      return SparseMatrixXd(scales.row_scale.asDiagonal() * M * scales.column_scale.asDiagonal());
    };
    return decide_scaled({scaled(of.value), scaled(of.error)});
  };
  RankDecision decision = decided(A, units);
  const Index full = std::min(A.rows(), A.cols());
  const auto is_settled = [&] { return decision.rank == full && !is_doubtful(decision); };
  const auto consider = [&](const RankDecision& other) {
    const bool proves_more = other.rank > decision.rank;
    const bool is_clearer =
        other.rank == decision.rank && is_doubtful(decision) && !is_doubtful(other);
    if (proves_more || is_clearer) decision = other;
  };
  if (is_settled()) return decision;
  const UncertainMatrix level{
      units.scaled, units.row_scale.asDiagonal() * A.error * units.column_scale.asDiagonal()};
  consider(decided(level, ProductScaling(level.value)));
  if (is_settled()) return decision;
  consider(decided(A, equilibrate(heeding_errors(A), 0.0)));
  if (is_settled() || std::max(A.rows(), A.cols()) > dense_limit) return decision;
  RankDecision by_pivots = eliminated(level);
  if (by_pivots.rank > decision.rank) return by_pivots;
  if (by_pivots.rank ==
      decision.rank) {  // each is evidence that these are numbers, and the rest is not
    decision.above = std::max(decision.above, by_pivots.above);
    decision.below = std::min(decision.below, by_pivots.below);
  }
  return decision;
}

}  // namespace

RankDecision decide_rank(const UncertainMatrix& A) {
  RankDecision decision;
  decision.rows = A.rows();
  decision.columns = A.cols();
  decision.threshold = 1.0;
  Peeling peeling(A);
  if (!peeling.is_finite()) return decision;

  std::vector<double> values = peeling.pivots();
  decision.rank = static_cast<Index>(values.size());
  decision.above = kExact;
  for (const double margin : values) decision.above = std::min(decision.above, margin);
  for (const UncertainMatrix& block : peeling.blocks()) {
    const RankDecision part = decide_block(block);
    decision.rank += part.rank;
    decision.above = std::min(decision.above, part.above);
    decision.below = std::max(decision.below, part.below);
    values.insert(values.end(), part.singular_values.begin(), part.singular_values.end());
  }
  std::sort(values.begin(), values.end(), std::greater<>());
  decision.singular_values = Eigen::Map<const VectorXd>(values.data(), std::ssize(values));
  decision.gap = decision.above / std::max(1.0, decision.below);
  decision.is_doubtful = is_doubtful(decision);
  return decision;
}

}  // namespace courant
