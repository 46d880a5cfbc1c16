#include "courant/running/quantity_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

void QuantityStatistics::add(double t, const VectorXd& values) {
  auto& [count, initial, final, min, max, mean_t, variation, mean, covariation] = memory_;
  if (empty()) {
    initial = min = max = values;
    mean = covariation = VectorXd::Zero(values.size());
  }
  count += 1.0;
  final = values;
  // A NaN, old or new, wins.
  for (Index i = 0; i < values.size(); ++i) {
    if (!(values[i] >= min[i]) && !std::isnan(min[i])) min[i] = values[i];
    if (!(values[i] <= max[i]) && !std::isnan(max[i])) max[i] = values[i];
  }
  const double from_mean = t - mean_t;
  mean_t += from_mean / count;
  variation += from_mean * (t - mean_t);
  mean += (values - mean) / count;
  covariation += from_mean * (values - mean);
}

QuantityRecord QuantityStatistics::record(Index quantity) const {
  QuantityRecord record{.initial = memory_.initial[quantity],
                        .final = memory_.final[quantity],
                        .min = memory_.min[quantity],
                        .max = memory_.max[quantity]};
  record.max_drift = std::max(record.max - record.initial, record.initial - record.min);
  if (memory_.variation > 0.0) record.slope = memory_.covariation[quantity] / memory_.variation;
  return record;
}

}  // namespace courant
