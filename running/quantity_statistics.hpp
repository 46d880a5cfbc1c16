// What is kept of the quantities of a run, without keeping their values.
#pragma once

#include <utility>

#include "courant/core/expressions/expr.hpp"
#include "courant/reading/expectation.hpp"

namespace courant {

// Initial, final, least and greatest values, greatest drift and slope of several quantities, from
// their values at one time after the other. NaN in a quantity stays in its records.
class QuantityStatistics {
 public:
  void add(double t, const VectorXd& values);
  // Whether all values so far were finite.
  bool is_finite() const { return is_finite_; }
  bool empty() const { return memory_.count == 0.0; }
  QuantityRecord record(Index quantity) const;

  // All that is kept, whatever the number of values.
  struct Memory {
    double count = 0.0;
    VectorXd initial = {}, final = {}, min = {}, max = {};
    // Means, Σ (t - mean)² and Σ (t - mean)(value - mean), updated as Welford does.
    double mean_t = 0.0, variation = 0.0;
    VectorXd mean = {}, covariation = {};
  };
  const Memory& memory() const { return memory_; }
  // Goes on as the statistics of the same quantities that had this memory.
  void recall(Memory memory);

 private:
  void keep_undefined(const VectorXd& values);

  Memory memory_;
  bool is_finite_ = true;
};

}  // namespace courant
