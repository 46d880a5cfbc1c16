#include "courant/running/quantity_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/pairs.hpp"

namespace courant {

void QuantityStatistics::add(double t, const VectorXd& values) {
  auto& [count, initial, final, min, max, mean_t, variation, mean, covariation] = memory_;
  if (empty()) {
    initial = min = max = values;
    mean = covariation = VectorXd::Zero(values.size());
  }
  count += 1.0;
  final.resize(values.size());
  copy_pairs(values.data(), values.size(), final.data());
  const double from_mean = t - mean_t, share = 1.0 / count;
  mean_t += from_mean * share;
  variation += from_mean * (t - mean_t);
  is_finite_ = is_finite_ && are_finite(values.data(), values.size());
  if (!is_finite_) keep_undefined(values);
  double* const least = min.data();
  double* const most = max.data();
  double* const means = mean.data();
  double* const products = covariation.data();
  for_each_pair(0, values.size(),
                [=, from = values.data(), is_finite = is_finite_]<class Numbers>(Index i, Numbers) {
                  const auto value = read<Numbers>(from + i), before = read<Numbers>(means + i);
                  const Numbers now = before + (value - before) * share;
                  write(means + i, now);
                  write(products + i,
                        Numbers(read<Numbers>(products + i) + from_mean * (value - now)));
                  if (!is_finite) return;
                  write(least + i, smaller(read<Numbers>(least + i), value));
                  write(most + i, larger(read<Numbers>(most + i), value));
                });
}

// Least and greatest values, of which a NaN, old or new, wins.
void QuantityStatistics::keep_undefined(const VectorXd& values) {
  VectorXd& min = memory_.min;
  VectorXd& max = memory_.max;
  for (Index i = 0; i < values.size(); ++i) {
    if (!(values[i] >= min[i]) && !std::isnan(min[i])) min[i] = values[i];
    if (!(values[i] <= max[i]) && !std::isnan(max[i])) max[i] = values[i];
  }
}

void QuantityStatistics::recall(Memory memory) {
  memory_ = std::move(memory);
  is_finite_ = memory_.min.allFinite() && memory_.max.allFinite();
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
