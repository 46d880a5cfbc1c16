// Whether an energy error stays or grows.
#pragma once

#include <span>
#include <string>

namespace courant {

// How H - H(0) behaves over a run.
//
// The run is cut into ten windows of as many rows. A line through their means has a slope with a
// standard error, and so has one through their greatest |H - H(0)|. The error grows if one of these
// lines rises by more than five standard errors and a quarter of the greatest error, or if the last
// two windows have errors three times those of the first half. It is bounded otherwise, if it has
// passed its mean at least four times; a run that is shorter does not tell. What is below 1e-12 of
// the greatest |H| is round-off.
struct EnergyTrend {
  enum class Growth { round_off, bounded, growing, unclear };
  Growth growth = Growth::unclear;
  double greatest = 0.0;     // |H - H(0)|
  double slope = 0.0;        // of the line through the means, per unit of t
  double uncertainty = 0.0;  // its standard error
};

// Of `error` = H - H(0) at the times t; rows that are not finite are left out. `size` is the
// greatest |H|.
EnergyTrend energy_trend(std::span<const double> t, std::span<const double> error, double size);

// "kept to round-off", "bounded", "growing", "too short to tell".
std::string word(EnergyTrend::Growth growth);
// "bounded: at most 1.92 × 10⁻⁴, slope (…) ± … per unit of t, which is none".
std::string in_words(const EnergyTrend& trend);

}  // namespace courant
