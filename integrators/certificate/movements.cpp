#include "courant/integrators/certificate/movements.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace courant {

std::vector<Movement> movements(const ImplicitSystem& system, const InitialGuess& guess,
                                const State& point) {
  std::vector<Movement> moves;
  const auto compare = [&](const VectorXd& given, const VectorXd& found, const auto& name) {
    const double size = given.size() == 0 ? 0.0
                                          : std::max(given.lpNorm<Eigen::Infinity>(),
                                                     found.lpNorm<Eigen::Infinity>());
    for (Index i = 0; i < given.size(); ++i)
      if (std::abs(given[i] - found[i]) > 1e-12 * size)
        moves.push_back({name(static_cast<std::size_t>(i)), given[i], found[i]});
  };
  const ImplicitSystem::Names& names = system.names();
  compare(guess.x, point.x, [&](std::size_t i) { return names.coordinates[i]; });
  const bool one_name_each = guess.v.size() == guess.x.size();
  compare(guess.v, point.v, [&](std::size_t i) {
    return one_name_each ? names.coordinates[i] + "'" : "v[" + std::to_string(i) + "]";
  });
  compare(guess.z, point.z, [&](std::size_t i) { return names.auxiliary[i]; });
  return moves;
}

}  // namespace courant
