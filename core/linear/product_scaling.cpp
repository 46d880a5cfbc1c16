#include "courant/core/linear/product_scaling.hpp"

#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace courant {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// The assignment problem of least cost for the edges of a bipartite graph, by successive shortest
// paths. Rows are matched one after the other; one that no path leads from stays alone.
class Assignment {
 public:
  Assignment(Index rows, Index columns)
      : edges_(size(rows)),
        u_(VectorXd::Zero(rows)),
        v_(VectorXd::Zero(columns)),
        column_of_(size(rows), -1),
        row_of_(size(columns), -1) {}

  void add(Index row, Index column, double cost) { edges_[size(row)].push_back({column, cost}); }

  void solve() {
    for (Index i = 0; i < u_.size(); ++i) match(i);
    // What is not matched is as large as it can be.
    for (Index i = 0; i < u_.size(); ++i)
      if (column_of_[size(i)] < 0) u_[i] = least_reduced(i);
    VectorXd slack = VectorXd::Constant(v_.size(), infinite);
    for (Index i = 0; i < u_.size(); ++i)
      for (const auto& [j, cost] : edges_[size(i)])
        slack[j] = std::min(slack[j], cost - u_[i] - v_[j]);
    for (Index j = 0; j < v_.size(); ++j)
      if (row_of_[size(j)] < 0 && std::isfinite(slack[j])) v_[j] += slack[j];
  }

  // cost_ij - u_i - v_j ≥ 0, with equality along the matching.
  const VectorXd& u() const { return u_; }
  const VectorXd& v() const { return v_; }

 private:
  struct Edge {
    Index column;
    double cost;
  };

  static std::size_t size(Index i) { return static_cast<std::size_t>(i); }

  double least_reduced(Index i) const {
    double least = infinite;
    for (const auto& [j, cost] : edges_[size(i)]) least = std::min(least, cost - v_[j]);
    return std::isfinite(least) ? least : 0.0;
  }

  // Dijkstra's algorithm from row `first` to the nearest column that is free.
  void match(Index first) {
    u_[first] = least_reduced(first);
    std::vector<double> distance(row_of_.size(), infinite);
    std::vector<Index> from(row_of_.size(), -1), reached;
    std::vector<bool> is_done(row_of_.size(), false);
    using Candidate = std::pair<double, Index>;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> next;
    Index row = first, end = -1;
    double length = 0.0;
    while (true) {
      for (const auto& [j, cost] : edges_[size(row)]) {
        const double there = length + std::max(0.0, cost - u_[row] - v_[j]);
        if (is_done[size(j)] || there >= distance[size(j)]) continue;
        distance[size(j)] = there;
        from[size(j)] = row;
        next.emplace(there, j);
      }
      Index column = -1;
      while (!next.empty() && column < 0) {
        if (!is_done[size(next.top().second)]) column = next.top().second;
        next.pop();
      }
      if (column < 0) return;  // no path
      length = distance[size(column)];
      if (row_of_[size(column)] < 0) {
        end = column;
        break;
      }
      is_done[size(column)] = true;
      reached.push_back(column);
      row = row_of_[size(column)];
    }
    u_[first] += length;
    for (const Index j : reached) {
      v_[j] -= length - distance[size(j)];
      u_[row_of_[size(j)]] += length - distance[size(j)];
    }
    while (true) {
      const Index i = from[size(end)];
      row_of_[size(end)] = i;
      std::swap(column_of_[size(i)], end);
      if (i == first) return;
    }
  }

  std::vector<std::vector<Edge>> edges_;  // of each row
  VectorXd u_, v_;
  std::vector<Index> column_of_, row_of_;
};

VectorXd powers_of_two(const VectorXd& exponent) {
  return exponent.unaryExpr([](double e) { return std::exp2(std::round(e)); });
}

}  // namespace

ProductScaling::ProductScaling(const SparseMatrixXd& A) {
  // Both orders, and their mean: dual variables are not unique, and either end of them makes lines
  // large that need not be.
  Assignment by_row(A.rows(), A.cols()), by_column(A.cols(), A.rows());
  for (Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(A, j); it; ++it) {
      if (it.value() == 0.0) continue;
      const double cost = -std::log2(std::fabs(it.value()));
      by_row.add(it.row(), j, cost);
      by_column.add(j, it.row(), cost);
    }
  by_row.solve();
  by_column.solve();
  row_scale = powers_of_two(0.5 * (by_row.u() + by_column.v()));
  column_scale = powers_of_two(0.5 * (by_row.v() + by_column.u()));
}

}  // namespace courant
