// EnsembleStatistics: how the members of an ensemble are spread.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "courant/running/ensemble_member.hpp"

namespace courant {

// Of some numbers: how many, mean, standard deviation (of a sample: by n - 1; 0 of one number), least and greatest.
struct Spread {
  double count = 0.0, mean = 0.0, variation = 0.0;  // Σ (value - mean)²
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(double value);  // as Welford does
  double standard_deviation() const;
};

// Spread of each column in each row over the members that completed, which are added in their order; at the end also
// quantiles.
class EnsembleStatistics {
 public:
  explicit EnsembleStatistics(const EnsembleOpening& opening);

  void add(const EnsembleMember& member);

  Index completed() const { return completed_; }
  // Of a column in the row at time t; nothing where there is no such row.
  std::optional<Spread> at(const std::string& column, double t) const;

  // By column but t: mean, standard_deviation, min, max, quantiles of the last row.
  Json at_end() const;
  // Of the greatest |H - H(0)| of each member, and which has the greatest; null without an energy.
  Json drift() const;
  double max_violation() const { return max_violation_; }
  // t, then mean, standard_deviation, min and max of each column; a row each.
  std::string csv() const;

 private:
  const Spread& spread(Index row, Index column) const {
    return spreads_[static_cast<std::size_t>(row * columns() + column)];
  }
  Index columns() const { return static_cast<Index>(opening_.columns.size()); }

  EnsembleOpening opening_;
  Index completed_ = 0;
  std::vector<Spread> spreads_;            // rows × columns
  std::vector<std::vector<double>> ends_;  // by column: those of the members
  std::vector<double> drifts_;
  Index worst_ = 0;  // the member with the greatest drift
  double worst_drift_ = 0.0;
  double max_violation_ = EnsembleMember::kUnknown;
};

}  // namespace courant
