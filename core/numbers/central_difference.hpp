// Derivatives by central differences of order 8.
#pragma once

#include <array>
#include <cstddef>

namespace courant {

// Adds df/ds at 0 to `slope`, which is a number, a vector or a column of one size with what f returns:
//
//   f'(0) = Σ_k w_k (f(k s) - f(-k s)) / s + O(s⁸),   w = (4/5, -1/5, 4/105, -1/280),   k = 1 … 4
//
// `step`: s. f returns a number or a vector, no expression of Eigen; it is called eight times, and what it throws
// passes through.
template <class F, class Slope>
void add_central_difference(const F& f, double step, Slope&& slope) {
  constexpr std::array weights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double s = static_cast<double>(k + 1) * step;
    const auto ahead = f(s), behind = f(-s);
    slope += weights[k] / step * (ahead - behind);
  }
}

}  // namespace courant
