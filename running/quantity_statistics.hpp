// What is kept of the quantities of a run, without keeping their values.
#pragma once

#include "courant/core/expr.hpp"
#include "courant/reading/expectation.hpp"

namespace courant {

// Initial, final, least and greatest values, greatest drift and slope of several quantities, from
// their values at one time after the other. NaN in a quantity stays in its records.
class QuantityStatistics {
 public:
  void add(double t, const VectorXd& values);
  bool empty() const { return count_ == 0.0; }
  QuantityRecord record(Index quantity) const;

 private:
  double count_ = 0.0;
  VectorXd initial_, final_, min_, max_;
  // Means, Σ (t - mean)² and Σ (t - mean)(value - mean), updated as Welford does.
  double mean_t_ = 0.0, variation_ = 0.0;
  VectorXd mean_, covariation_;
};

}  // namespace courant
