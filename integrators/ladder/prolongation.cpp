#include "courant/integrators/ladder/prolongation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace courant {

void UncertainEntries::add(Index row, Index column, const Uncertain& entry) {
  if (!entry.is_exactly(0.0)) entries_.push_back({row, column, entry});
}

void UncertainEntries::fill(Linearization& result, Index rows, Index columns) {
  const auto place = [](const Entry& entry) { return std::pair(entry.column, entry.row); };
  std::sort(entries_.begin(), entries_.end(),
            [&](const Entry& a, const Entry& b) { return place(a) < place(b); });
  std::vector<Eigen::Triplet<double>> values, errors;
  for (auto at = entries_.begin(); at != entries_.end();) {
    const auto first = at;
    Uncertain sum = first->number;
    for (++at; at != entries_.end() && place(*at) == place(*first); ++at) sum += at->number;
    const auto row = static_cast<int>(first->row), column = static_cast<int>(first->column);
    // What is not finite stays for whoever uses the matrix to see.
    const bool is_zero = std::fabs(sum.value) <= sum.error && std::isfinite(sum.error);
    if (!is_zero) values.emplace_back(row, column, sum.value);
    errors.emplace_back(row, column, sum.error + (is_zero ? std::fabs(sum.value) : 0.0));
  }
  result.jacobian.resize(rows, columns);
  result.jacobian.setFromTriplets(values.begin(), values.end());
  result.error.resize(rows, columns);
  result.error.setFromTriplets(errors.begin(), errors.end());
}

VectorXd Prolongation::rounding(const VectorXd& y) {
  return y.unaryExpr([](double number) { return Uncertain::rounded(number).error; });
}

Index Prolongation::level_of(const VectorXd& y) const {
  const Index block = base_size_ + auxiliary_size_;
  const Index blocks = block == 0 ? 1 : (y.size() - base_size_) / block;
  if (blocks < 1 || y.size() != base_size_ + blocks * block)
    throw std::invalid_argument(
        "Prolongation::level_of: y has " + std::to_string(y.size()) +
        " entries; expected n + (k+1)(n+m) with n = " + std::to_string(base_size_) +
        ", m = " + std::to_string(auxiliary_size_) + ".");
  return blocks - 1;
}

}  // namespace courant
