#include "courant/structures/rank_profile.hpp"

#include <algorithm>
#include <ostream>
#include <sstream>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/structures/blocks.hpp"

namespace courant {

FibreRanks fibre_ranks(const DiracStructure& structure, const VectorXd& x) {
  const auto [F, E, P] = structure.matrices(x);
  const PairedSubspace D = PairedSubspace::kernel(F, E, P, DiracStructure::rounding);
  const RankDecision equations = decide_rank(beside(beside(F, E), P), DiracStructure::rounding);
  const RankDecision ports = decide_rank(P, DiracStructure::rounding);
  const RankDecision vectors = decide_rank(D.vectors(), D.block_options());
  const RankDecision covectors = decide_rank(D.covectors(), D.block_options());
  return {
      .dimension = D.dimension(),
      .vector_range = vectors.rank,
      .covector_range = covectors.rank,
      .equations = equations.rank,
      .ports = ports.rank,
      .gap = std::min({D.decision().gap, equations.gap, ports.gap, vectors.gap, covectors.gap})};
}

RankProfile rank_profile(const DiracStructure& structure, std::span<const VectorXd> points) {
  RankProfile profile;
  for (const VectorXd& x : points) profile.at.push_back(fibre_ranks(structure, x));
  if (profile.at.empty()) return profile;
  FibreRanks& generic = profile.generic = profile.at.front();
  // The dimension of D is least where the rank of its equations is largest.
  for (const FibreRanks& ranks : profile.at) {
    generic.dimension = std::min(generic.dimension, ranks.dimension);
    generic.equations = std::max(generic.equations, ranks.equations);
    generic.ports = std::max(generic.ports, ranks.ports);
    generic.gap = std::min(generic.gap, ranks.gap);
  }
  const auto jumps = [&](const FibreRanks& ranks) {
    return ranks.dimension != generic.dimension || ranks.equations != generic.equations ||
           ranks.ports != generic.ports;
  };
  generic.vector_range = generic.covector_range = 0;
  for (const FibreRanks& ranks : profile.at) {
    if (jumps(ranks)) continue;
    generic.vector_range = std::max(generic.vector_range, ranks.vector_range);
    generic.covector_range = std::max(generic.covector_range, ranks.covector_range);
  }
  for (std::size_t i = 0; i < profile.at.size(); ++i) {
    const FibreRanks& ranks = profile.at[i];
    if (jumps(ranks))
      profile.jumps.push_back(i);
    else if (ranks.vector_range != generic.vector_range ||
             ranks.covector_range != generic.covector_range)
      profile.singular.push_back(i);
  }
  return profile;
}

std::ostream& operator<<(std::ostream& out, const RankProfile& profile) {
  const auto line = [](const FibreRanks& ranks) {
    std::ostringstream text;
    text << "dim D = " << ranks.dimension << ", dim F_D = " << ranks.vector_range
         << ", dim F_D^(*) = " << ranks.covector_range << ", rank of the equations "
         << ranks.equations << ", of their ports " << ranks.ports;
    return text.str();
  };
  out << profile.at.size() << " points, generic: " << line(profile.generic) << '\n';
  for (std::size_t i = 0; i < profile.at.size(); ++i) {
    const bool jump = std::ranges::binary_search(profile.jumps, i);
    if (!jump && !std::ranges::binary_search(profile.singular, i)) continue;
    out << "  point " << i << ": " << line(profile.at[i])
        << (jump ? ": the rank jumps, D is not smooth there" : ": singular leaf") << '\n';
  }
  return out;
}

}  // namespace courant
