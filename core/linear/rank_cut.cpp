#include "courant/core/linear/rank_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {
double entry_noise(const RankOptions& options) {
  return std::max(64.0 * std::numeric_limits<double>::epsilon(), options.data_error);
}

NoiseLevel noise_level(Index m, Index n, double largest, const RankOptions& options) {
  const auto rows = static_cast<double>(m), columns = static_cast<double>(n);
  const double top = options.magnitude > 0.0 ? options.magnitude : 1.0;
  const double rounding = std::max({rows, columns, 1.0}) * std::numeric_limits<double>::epsilon() *
                          std::max(top, largest);
  const double error = (std::sqrt(rows) + std::sqrt(columns)) * options.data_error * top;
  return {.floor = rounding + error + options.error_norm,
          .top = top,
          .number = options.error_norm > 0.0 ? 1.0 : 1e2};
}

Index count_above_cut(const VectorXd& values, const NoiseLevel& noise) {
  const auto gap = [&](Index r) {
    const double above = r > 0 ? values[r - 1] : noise.top;
    return above / (r < values.size() ? std::max(values[r], noise.floor) : noise.floor);
  };
  const Index numbers = (values.array() > noise.number * noise.floor).count();
  const Index not_zero = (values.array() > noise.floor).count();
  Index best = numbers;
  for (Index r = numbers + 1; r <= not_zero; ++r) {
    if (gap(r) > gap(best)) best = r;
  }
  return best;
}

void conclude(RankDecision& decision, Index rank, double above, double below,
              const NoiseLevel& noise) {
  decision.rank = rank;
  decision.above = above;
  decision.below = below;
  const double top = rank > 0 ? above : noise.top;
  decision.gap = top / std::max(below, noise.floor);
  decision.threshold = top / std::sqrt(decision.gap);
  decision.is_doubtful = !(decision.gap >= 1e3);
}

}  // namespace courant
