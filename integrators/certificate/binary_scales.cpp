#include "courant/integrators/certificate/binary_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/integrators/certificate/dimensionless_arguments.hpp"

namespace courant {
namespace {

constexpr std::int64_t no_exponent = std::numeric_limits<std::int64_t>::min();

bool has_no_size(const Digits& a) { return a.shrinks() || !a.is_finite(); }

struct SizedEntry {
  std::size_t row, column;
  std::int64_t exponent;
};

// Of each row the largest_of_rows entry among columns that are known; no_exponent where there is none.
std::vector<std::int64_t> largest_of_rows(const std::vector<SizedEntry>& entries,
                                          const BinaryScales& scales) {
  std::vector<std::int64_t> found(scales.row.size(), no_exponent);
  for (const SizedEntry& a : entries)
    if (scales.is_known[a.column])
      found[a.row] = std::max(found[a.row], a.exponent + scales.column[a.column]);
  return found;
}

// Gives sizes to columns that have entries in rows that are known. Whether there were some.
bool extend_sizes(const std::vector<SizedEntry>& entries, BinaryScales& scales) {
  const std::vector<std::int64_t> of_row = largest_of_rows(entries, scales);
  std::vector<std::int64_t> of_column(scales.column.size(), no_exponent);
  for (const SizedEntry& a : entries)
    if (!scales.is_known[a.column] && of_row[a.row] != no_exponent)
      of_column[a.column] = std::max(of_column[a.column], a.exponent - of_row[a.row]);
  bool any = false;
  for (std::size_t j = 0; j < of_column.size(); ++j) {
    if (of_column[j] == no_exponent) continue;
    scales.column[j] = -of_column[j];
    scales.is_known[j] = true;
    any = true;
  }
  return any;
}

// Of each column that is known, whether it is more than 2^limit of the largest entry of some row in which it stands.
std::vector<bool> counting_columns(const std::vector<SizedEntry>& entries,
                                   const BinaryScales& scales, std::int64_t limit) {
  const std::vector<std::int64_t> of_row = largest_of_rows(entries, scales);
  std::vector<bool> counts(scales.column.size(), false);
  for (const SizedEntry& a : entries)
    if (scales.is_known[a.column] && a.exponent + scales.column[a.column] >= of_row[a.row] + limit)
      counts[a.column] = true;
  return counts;
}

// An unknown that is next to nothing in every row in which it stands, as the cosine of a right angle, vanishes as far
// as sizes go.
void forget_negligible(const std::vector<SizedEntry>& entries, BinaryScales& scales) {
  constexpr std::int64_t next_to_nothing = -30;
  const std::vector<bool> counts = counting_columns(entries, scales, next_to_nothing);
  for (std::size_t j = 0; j < counts.size(); ++j)
    if (!counts[j]) scales.is_known[j] = false;
}

std::vector<SizedEntry> exponents_of(const std::vector<JetEquations::Entry>& places,
                                     const std::vector<Digits>& entries) {
  std::vector<SizedEntry> result;
  for (std::size_t e = 0; e < places.size(); ++e)
    if (!has_no_size(entries[e]))
      result.push_back({static_cast<std::size_t>(places[e].row),
                        static_cast<std::size_t>(places[e].column), entries[e].exponent()});
  return result;
}

void complete_sizes(const std::vector<SizedEntry>& entries, BinaryScales& scales) {
  for (;;) {
    while (extend_sizes(entries, scales)) {
    }
    // Nothing is known of what is left: the first column has the size 1.
    const auto open = std::find_if(entries.begin(), entries.end(),
                                   [&](const SizedEntry& a) { return !scales.is_known[a.column]; });
    if (open == entries.end()) break;
    scales.is_known[open->column] = true;
  }
  const std::vector<std::int64_t> of_row = largest_of_rows(entries, scales);
  for (std::size_t i = 0; i < of_row.size(); ++i)
    scales.row[i] = of_row[i] == no_exponent ? 0 : -of_row[i];
}

// Of each unknown, whether it is below 2^limit of 1 in what a sine, an exponential or another function of numbers is of:
// such arguments are of the size of 1, whatever else stands beside them. Arguments that are linear in the unknowns alone:
// of a product nothing tells which factor is small.
std::vector<bool> small_angles(const JetEquations& equations, const Jet& jet, std::int64_t limit) {
  std::vector<bool> found(jet.y.size(), false);
  const ImplicitSystem& system = equations.system();
  const Index N = equations.point_size(), m = equations.auxiliary_size();
  VectorXd point = VectorXd::Zero(N + system.manifold()->tangent_dimension() + m + 1);
  for (Index j = 0; j < N; ++j) point[j] = static_cast<double>(jet.y[static_cast<std::size_t>(j)]);
  const double least = std::ldexp(1.0, static_cast<int>(limit));
  if (!point.head(N).unaryExpr([](double x) { return x != 0.0 && std::fabs(x) < 1.0; }).any())
    return found;
  const DimensionlessArguments arguments(system);
  const auto here = arguments.slopes(point), there = arguments.slopes(point.array() + 1.0);
  const auto is_constant = [&](const DimensionlessArguments::Slope& slope) {
    return std::ranges::any_of(there, [&](const auto& other) {
      return other.argument == slope.argument && other.unknown == slope.unknown &&
             other.size == slope.size;
    });
  };
  for (const auto& slope : here)
    if (slope.unknown < N && is_constant(slope)) {
      const double part = slope.size * std::fabs(point[slope.unknown]);
      if (part > 0.0 && part < least) found[static_cast<std::size_t>(slope.unknown)] = true;
    }
  return found;
}

}  // namespace

std::vector<Index> rounded_unknowns(const JetEquations& equations, const Jet& jet) {
  constexpr std::int64_t rounding = -50;
  const std::vector<bool> is_small_angle = small_angles(equations, jet, rounding);
  const auto at = equations.at(jet.t, jet.y, jet.k);
  BinaryScales sizes(equations, jet.k);
  for (std::size_t j = 0; j < jet.y.size(); ++j) {
    if (has_no_size(jet.y[j])) continue;
    sizes.column[j] = jet.y[j].exponent();
    sizes.is_known[j] = true;
  }
  const std::vector<SizedEntry> entries = exponents_of(equations.pattern(jet.k), at.entries);
  const std::vector<bool> counts = counting_columns(entries, sizes, rounding);
  std::vector<bool> stands(counts.size(), false);
  for (const SizedEntry& a : entries) stands[a.column] = true;
  std::vector<Index> found;
  for (std::size_t j = 0; j < jet.y.size(); ++j)
    if (sizes.is_known[j] && stands[j] && (!counts[j] || is_small_angle[j]))
      found.push_back(static_cast<Index>(j));
  return found;
}

void BinaryScales::update(const std::vector<JetEquations::Entry>& places,
                          const std::vector<Digits>& entries, const Jet& jet) {
  const std::vector<SizedEntry> known = exponents_of(places, entries);
  const bool is_first = std::none_of(is_known.begin(), is_known.end(), [](bool is) { return is; });
  for (std::size_t j = 0; j < column.size(); ++j) {
    const Digits& value = j < jet.y.size() ? jet.y[j] : jet.t;
    if (is_known[j] || has_no_size(value)) continue;
    column[j] = value.exponent();
    is_known[j] = true;
  }
  if (is_first) forget_negligible(known, *this);
  complete_sizes(known, *this);
}

void BinaryScales::scale_rows(const std::vector<JetEquations::Entry>& places,
                              const std::vector<Digits>& entries,
                              const std::vector<bool>& is_held) {
  std::vector<std::int64_t> largest(row.size(), no_exponent);
  for (const SizedEntry& a : exponents_of(places, entries))
    if (a.column < is_held.size() && !is_held[a.column])
      largest[a.row] = std::max(largest[a.row], a.exponent + column[a.column]);
  for (std::size_t i = 0; i < row.size(); ++i)
    if (largest[i] != no_exponent) row[i] = -largest[i];
}

void BinaryScales::update(const std::vector<JetEquations::Entry>& places,
                          const std::vector<Digits>& entries) {
  complete_sizes(exponents_of(places, entries), *this);
}

}  // namespace courant
