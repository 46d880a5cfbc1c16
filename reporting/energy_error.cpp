#include "courant/reporting/energy_error.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

std::optional<EnergyError> energy_error(const Run& run) {
  const TrajectoryTable& table = run.trajectory;
  if (!table.contains("H") || table.rows() == 0) return std::nullopt;
  const auto H = table.column("H");
  EnergyError error{{H.begin(), H.end()}, greatest_size(H), false};
  for (double& value : error.values) value -= H.front();
  if (!table.contains("supplied") || !table.contains("dissipated")) return error;
  const auto supplied = table.column("supplied"), dissipated = table.column("dissipated");
  const double exchanged = std::max(greatest_size(supplied), greatest_size(dissipated));
  error.is_balance = exchanged > 0.0;
  error.size = std::max(error.size, exchanged);
  for (std::size_t i = 0; i < error.values.size(); ++i)
    error.values[i] += dissipated[i] - supplied[i];
  return error;
}

std::string name_of(const EnergyError& error) {
  return error.is_balance ? "H − H(0) − supplied + dissipated" : "H − H(0)";
}

double greatest_size(std::span<const double> values) {
  double size = 0;
  for (const double value : values)
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return size;
}

}  // namespace courant
