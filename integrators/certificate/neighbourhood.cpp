#include "courant/integrators/certificate/neighbourhood.hpp"

#include <algorithm>
#include <cmath>

#include "courant/integrators/certificate/binary_scales.hpp"
#include "courant/integrators/certificate/least_solution.hpp"

namespace courant {
namespace {

constexpr int kAway = -30;  // exponent of two

bool have_same_ranks(const StagedElimination& a, const StagedElimination& b, Index k) {
  for (Index level = 0; level <= k; ++level)
    if (a.dim_S(level) != b.dim_S(level) || a.dim_M(level) != b.dim_M(level)) return false;
  return true;
}

}  // namespace

Neighbourhood::Neighbourhood(const JetEquations& equations, const NearestJet& nearest,
                             const Jet& jet, const StagedElimination& here, int looks) {
  const Index k = jet.k, unknown_count = equations.unknown_count(k);
  const std::vector<JetEquations::Entry> places = equations.pattern(k);
  const auto at = equations.at(jet.t, jet.y, k);
  std::mt19937 generator(1);
  // Sizes of unknowns are not known for certain: where no look has the ranks of the point others are asked.
  for (const bool by_sizes : {true, false}) {
    if (!by_sizes && !is_singular()) break;
    BinaryScales scales(equations, k);
    by_sizes ? scales.update(places, at.entries, jet) : scales.update(places, at.entries);
    // With time, which moves where the equations let it.
    const Index columns = unknown_count + (equations.depends_on_time() ? 1 : 0);
    std::vector<Eigen::Triplet<double>> triplets;
    for (std::size_t e = 0; e < places.size(); ++e) {
      const auto [i, j] = places[e];
      if (j == columns || at.entries[e].is_zero()) continue;
      triplets.emplace_back(static_cast<int>(i), static_cast<int>(j),
                            static_cast<double>(at.entries[e].times_power_of_two(
                                scales.row[static_cast<std::size_t>(i)] +
                                scales.column[static_cast<std::size_t>(j)])));
    }
    SparseMatrixXd A(equations.row_count(k), columns);
    A.setFromTriplets(triplets.begin(), triplets.end());
    const LeastSolution inverse(A);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (const int away : {kAway, 2 * kAway}) {
      if (away != kAway && !is_singular()) break;
      for (int i = 0; i < looks; ++i) {
        VectorXd direction(columns);
        for (double& entry : direction) entry = uniform(generator);
        for (int again = 0; again < 2; ++again)
          direction -= inverse.solve(MatrixXd(A * direction)).col(0);
        Jet there = jet;
        for (Index j = 0; j < columns; ++j) {
          if (std::fabs(direction[j]) <= 1e-13) continue;
          Digits& number = j < unknown_count ? there.y[static_cast<std::size_t>(j)] : there.t;
          number += Digits(direction[j])
                        .times_power_of_two(scales.column[static_cast<std::size_t>(j)] + away);
        }
        const NearestJet::Found found = nearest.find_displaced(there, scales);
        const auto values = equations.at(found.jet.t, found.jet.y, k);
        StagedElimination elimination(equations, values, found.jet);
        looks_.push_back({.jet = found.jet,
                          .is_zero = found.is_zero,
                          .has_same_ranks = found.is_zero && have_same_ranks(here, elimination, k),
                          .elimination = std::move(elimination)});
      }
    }
  }
}

bool Neighbourhood::is_singular() const {
  return std::none_of(looks_.begin(), looks_.end(), [](const Look& a) { return a.has_same_ranks; });
}

bool Neighbourhood::is_divided() const {
  return !is_singular() && std::any_of(looks_.begin(), looks_.end(), [](const Look& a) {
    return a.is_zero && !a.has_same_ranks;
  });
}

bool Neighbourhood::is_transversal() const {
  return std::any_of(looks_.begin(), looks_.end(), [](const Look& a) { return a.is_zero; });
}

}  // namespace courant
