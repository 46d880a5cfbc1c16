#include "courant/reporting/energy_trend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "courant/plotting/scale.hpp"

namespace courant {

namespace {

constexpr std::size_t windows = 10;
constexpr double certain = 5;  // standard errors

struct Line {
  double slope = 0, error = 0;
};

// The least-squares line through (i, values[i]), in units of a window.
Line line_through(const std::array<double, windows>& values) {
  const double centre = (windows - 1) / 2.0;
  double mean = 0, variation = 0, covariation = 0, rest = 0;
  for (const double value : values) mean += value / windows;
  for (std::size_t i = 0; i < windows; ++i) {
    const double x = static_cast<double>(i) - centre;
    variation += x * x;
    covariation += x * (values[i] - mean);
  }
  const double slope = covariation / variation;
  for (std::size_t i = 0; i < windows; ++i) {
    const double off = values[i] - mean - slope * (static_cast<double>(i) - centre);
    rest += off * off;
  }
  return {slope, std::sqrt(rest / (windows - 2) / variation)};
}

std::size_t crossings(std::span<const double> values) {
  double mean = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  std::size_t count = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if ((values[i - 1] < mean) != (values[i] < mean)) ++count;
  return count;
}

}  // namespace

EnergyTrend energy_trend(std::span<const double> t, std::span<const double> error, double size) {
  using Growth = EnergyTrend::Growth;
  std::vector<double> times, values;
  for (std::size_t i = 0; i < std::min(t.size(), error.size()); ++i)
    if (std::isfinite(error[i])) times.push_back(t[i]), values.push_back(error[i]);
  EnergyTrend trend;
  for (const double value : values) trend.greatest = std::max(trend.greatest, std::abs(value));
  if (values.size() < 2 * windows) return trend;

  std::array<double, windows> means{}, extremes{};
  for (std::size_t i = 0; i < windows; ++i) {
    const std::size_t begin = i * values.size() / windows, end = (i + 1) * values.size() / windows;
    for (std::size_t row = begin; row < end; ++row) {
      means[i] += values[row] / static_cast<double>(end - begin);
      extremes[i] = std::max(extremes[i], std::abs(values[row]));
    }
  }
  const Line drift = line_through(means), envelope = line_through(extremes);
  const double window = (times.back() - times.front()) / windows;
  trend.slope = drift.slope / window;
  trend.uncertainty = drift.error / window;
  if (trend.greatest <= 1e-12 * size) {
    trend.growth = Growth::round_off;
    return trend;
  }
  const auto rises = [&](double slope, double standard_error) {
    return slope > certain * standard_error && slope * windows > trend.greatest / 4;
  };
  const double early = *std::max_element(extremes.begin(), extremes.begin() + windows / 2);
  const double late = std::min(extremes[windows - 2], extremes[windows - 1]);
  if (rises(std::abs(drift.slope), drift.error) || rises(envelope.slope, envelope.error) ||
      late > 3 * early)
    trend.growth = Growth::growing;
  else
    trend.growth = crossings(values) >= 4 ? Growth::bounded : Growth::unclear;
  return trend;
}

std::string word(EnergyTrend::Growth growth) {
  switch (growth) {
    case EnergyTrend::Growth::round_off:
      return "kept to round-off";
    case EnergyTrend::Growth::bounded:
      return "bounded";
    case EnergyTrend::Growth::growing:
      return "growing";
    case EnergyTrend::Growth::unclear:
      return "too short to tell";
  }
  return "";
}

std::string in_words(const EnergyTrend& trend) {
  const std::string greatest = "at most " + plot::readable(trend.greatest, 3);
  if (trend.growth == EnergyTrend::Growth::round_off) return word(trend.growth) + ", " + greatest;
  if (trend.growth == EnergyTrend::Growth::unclear)
    return greatest + "; the run is too short to tell bounded from growing";
  const bool is_none = std::abs(trend.slope) <= certain * trend.uncertainty;
  return word(trend.growth) + ", " + greatest + ", with a slope of " +
         plot::readable(trend.slope, 2) + " ± " + plot::readable(trend.uncertainty, 1) +
         (is_none && trend.growth == EnergyTrend::Growth::bounded
              ? ", which is none that can be told from zero"
              : "");
}

}  // namespace courant
