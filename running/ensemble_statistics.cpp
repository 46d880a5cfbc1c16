#include "courant/running/ensemble_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr std::pair<const char*, double> kQuantiles[] = {
    {"0.05", 0.05}, {"0.25", 0.25}, {"0.5", 0.5}, {"0.75", 0.75}, {"0.95", 0.95}};

// Between the two numbers beside it in order, linearly: quantile 0 is the least, 1 the greatest (type 7 of R. J.
// Hyndman and Y. Fan, Sample quantiles in statistical packages, 1996).
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  return part == 0.0 ? sorted[below] : sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

Json spread_json(const Spread& spread, std::vector<double> values) {
  std::ranges::sort(values);
  Json quantiles = Json::object();
  for (const auto& [name, share] : kQuantiles)
    quantiles[name] = values.empty() ? EnsembleMember::kUnknown : quantile(values, share);
  return {{"mean", spread.mean},
          {"standard_deviation", spread.standard_deviation()},
          {"min", spread.min},
          {"max", spread.max},
          {"quantiles", std::move(quantiles)}};
}

}  // namespace

void Spread::add(double value) {
  count += 1.0;
  const double way = value - mean;
  mean += way / count;
  variation += way * (value - mean);
  min = std::min(min, value);
  max = std::max(max, value);
}

double Spread::standard_deviation() const {
  return count > 1.0 ? std::sqrt(variation / (count - 1.0)) : 0.0;
}

EnsembleStatistics::EnsembleStatistics(const EnsembleOpening& opening)
    : opening_(opening),
      spreads_(static_cast<std::size_t>(opening.numbers_of_member())),
      ends_(opening.columns.size()) {}

void EnsembleStatistics::add(const EnsembleMember& member) {
  if (member.status != RunStatus::completed) return;
  const std::size_t count = std::min(member.rows.size(), spreads_.size());
  ++completed_;
  for (std::size_t k = 0; k < count; ++k) spreads_[k].add(member.rows[k]);
  const std::size_t width = ends_.size();
  if (member.rows.size() >= width)
    for (std::size_t k = 0; k < width; ++k)
      ends_[k].push_back(member.rows[member.rows.size() - width + k]);
  if (!std::isnan(member.max_drift)) {
    if (drifts_.empty() || member.max_drift > worst_drift_) {
      worst_ = member.number;
      worst_drift_ = member.max_drift;
    }
    drifts_.push_back(member.max_drift);
  }
  max_violation_ = std::fmax(max_violation_, member.max_violation);
}

std::optional<Spread> EnsembleStatistics::at(const std::string& column, double t) const {
  const auto found = std::ranges::find(opening_.columns, column);
  if (found == opening_.columns.end()) return std::nullopt;
  for (Index row = 0; row < opening_.rows; ++row) {
    const double time = spread(row, 0).mean;
    if (spread(row, 0).count > 0.0 && std::abs(time - t) <= 1e-9 * std::max(1.0, std::abs(t)))
      return spread(row, found - opening_.columns.begin());
  }
  return std::nullopt;
}

Json EnsembleStatistics::at_end() const {
  Json result = Json::object();
  if (completed_ == 0) return result;
  for (std::size_t k = 1; k < ends_.size(); ++k) {
    Spread spread;
    for (const double value : ends_[k]) spread.add(value);
    result[opening_.columns[k]] = spread_json(spread, ends_[k]);
  }
  return result;
}

Json EnsembleStatistics::drift() const {
  if (drifts_.empty()) return {};
  Spread spread;
  for (const double value : drifts_) spread.add(value);
  Json result = spread_json(spread, drifts_);
  result["worst_member"] = worst_;
  return result;
}

std::string EnsembleStatistics::csv() const {
  std::string text = "t";
  for (std::size_t k = 1; k < opening_.columns.size(); ++k)
    for (const char* what : {"mean", "standard_deviation", "min", "max"})
      text += "," + opening_.columns[k] + "." + what;
  text += "\n";
  for (Index row = 0; row < opening_.rows; ++row) {
    if (spread(row, 0).count == 0.0) continue;
    text += exact_text(spread(row, 0).min);
    for (Index k = 1; k < columns(); ++k) {
      const Spread& one = spread(row, k);
      for (const double value : {one.mean, one.standard_deviation(), one.min, one.max})
        text += "," + exact_text(value);
    }
    text += "\n";
  }
  return text;
}

}  // namespace courant
