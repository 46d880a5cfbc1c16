#include "courant/reading/time_span.hpp"

#include <cmath>

namespace courant {

std::optional<long> TimeSpan::step_at(double t) const {
  if (rate) return std::nullopt;
  const double k = std::round((t - start) / step);
  if (!(k >= 0.0 && k <= static_cast<double>(steps))) return std::nullopt;
  const long whole = static_cast<long>(k);
  if (std::abs(time(whole) - t) > 1e-9 * step + 1e-15 * std::abs(t)) return std::nullopt;
  return whole;
}

bool TimeSpan::is_known_at(double t) const {
  return rate ? t >= start && t <= until : step_at(t).has_value();
}

}  // namespace courant
