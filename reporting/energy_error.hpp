// By how much the energy of a run is wrong.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "courant/running/run_files.hpp"

namespace courant {

// H - H(0), or H - H(0) - supplied + dissipated where energy comes in or goes out, in all rows of a run.
struct EnergyError {
  std::vector<double> values;
  double size = 0.0;        // the greatest |H|, |supplied| and |dissipated|
  bool is_balance = false;  // whether energy is supplied or dissipated
};

// That of a run that has H; nothing without H or rows. What a run supplies and dissipates is in its columns
// `supplied` and `dissipated`, which runs with ports, forces or damping have, as systems have that depend on time.
std::optional<EnergyError> energy_error(const Run& run);

// "H − H(0)", or "H − H(0) − supplied + dissipated".
std::string name_of(const EnergyError& error);

// The greatest |value| of those that are finite; 0 if there is none.
double greatest_size(std::span<const double> values);

}  // namespace courant
