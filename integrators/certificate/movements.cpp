#include "courant/integrators/certificate/movements.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace courant {

void add_movements(const VectorXd& given, const VectorXd& found,
                   const std::function<std::string(Index)>& name, std::vector<Movement>& moves) {
  if (given.size() == 0) return;
  constexpr double unseen = 1e-12, round_off = 1e-15;
  const double size = std::max(given.lpNorm<Eigen::Infinity>(), found.lpNorm<Eigen::Infinity>());
  for (Index i = 0; i < given.size(); ++i) {
    if (!(std::abs(given[i] - found[i]) > unseen * size)) continue;
    const std::string of = name(i);
    if (!of.empty())
      moves.push_back({of, given[i], std::abs(found[i]) > round_off * size ? found[i] : 0.0});
  }
}

std::vector<Movement> movements(const ImplicitSystem& system, const InitialGuess& guess,
                                const State& point) {
  std::vector<Movement> moves;
  const auto compare = [&](const VectorXd& given, const VectorXd& found, const auto& name) {
    add_movements(
        given, found, [&](Index i) { return name(static_cast<std::size_t>(i)); }, moves);
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
