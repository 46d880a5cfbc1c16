#include "courant/running/quantity_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

void QuantityStatistics::add(double t, const VectorXd& values) {
  if (empty()) {
    initial_ = min_ = max_ = values;
    mean_ = covariation_ = VectorXd::Zero(values.size());
  }
  count_ += 1.0;
  final_ = values;
  // A NaN, old or new, wins.
  for (Index i = 0; i < values.size(); ++i) {
    if (!(values[i] >= min_[i]) && !std::isnan(min_[i])) min_[i] = values[i];
    if (!(values[i] <= max_[i]) && !std::isnan(max_[i])) max_[i] = values[i];
  }
  const double from_mean = t - mean_t_;
  mean_t_ += from_mean / count_;
  variation_ += from_mean * (t - mean_t_);
  mean_ += (values - mean_) / count_;
  covariation_ += from_mean * (values - mean_);
}

QuantityRecord QuantityStatistics::record(Index quantity) const {
  QuantityRecord record{.initial = initial_[quantity],
                        .final = final_[quantity],
                        .min = min_[quantity],
                        .max = max_[quantity]};
  record.max_drift = std::max(record.max - record.initial, record.initial - record.min);
  if (variation_ > 0.0) record.slope = covariation_[quantity] / variation_;
  return record;
}

}  // namespace courant
