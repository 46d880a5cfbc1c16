#include "courant/integrators/certificate/nearest_jet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/orthogonal_rows.hpp"
#include "courant/integrators/certificate/least_solution.hpp"

namespace courant {
namespace {

// What is zero but for rounding_exponent is zero.
void settle_unknowns(Jet& jet) {
  for (Digits& number : jet.y) number.settle();
}

// Both precisions search from one place, or one of them could end at another zero.
void begin_at_one_place(Jet& jet) {
  settle_unknowns(jet);
  for (Digits& number : jet.y) number = number.from_fine();
}

bool are_all_finite(const std::vector<Digits>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](const Digits& a) { return a.is_finite(); });
}

// Columns, of the unknowns that are in it, of a matrix whose rows and columns are scaled_part.
struct FreeColumns {
  std::vector<Index> unknown;
  std::vector<Index> column;  // by unknown, -1: not in it
  void add(Index j) {
    column[static_cast<std::size_t>(j)] = std::ssize(unknown);
    unknown.push_back(j);
  }
  explicit FreeColumns(Index size) : column(static_cast<std::size_t>(size), -1) {}
};

// What is smaller than this, where 1 is the largest of its row, is taken for rounding_exponent in doubles (exponents of two).
constexpr std::int64_t rounding_exponent = -43;

// Entries of a step in doubles below this, of the largest, are rounding_exponent: where the equations leave an unknown open
// they would be all that it has. What they were the next step corrects.
constexpr double noise_of_step = 1e-13;

// Rows and columns scaled so that they are alike: 2^row A 2^column.
SparseMatrixXd scaled_part(const std::vector<JetEquations::Entry>& places,
                           const std::vector<Digits>& entries, const BinaryScales& scales,
                           const FreeColumns& part) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(places.size());
  for (std::size_t e = 0; e < places.size(); ++e) {
    const auto unknown = static_cast<std::size_t>(places[e].column);
    if (unknown >= part.column.size() || part.column[unknown] < 0 || entries[e].is_zero()) continue;
    const std::int64_t scale =
        scales.row[static_cast<std::size_t>(places[e].row)] + scales.column[unknown];
    if (entries[e].exponent() + scale > rounding_exponent)
      triplets.emplace_back(static_cast<int>(places[e].row), static_cast<int>(part.column[unknown]),
                            static_cast<double>(entries[e].times_power_of_two(scale)));
  }
  SparseMatrixXd A(std::ssize(scales.row), std::ssize(part.unknown));
  A.setFromTriplets(triplets.begin(), triplets.end());
  return A;
}

// Of an unknown in the unit of its column, and at least that.
double size_of_unknown(const Jet& jet, const BinaryScales& scales, std::size_t j) {
  return std::max(1.0,
                  std::fabs(static_cast<double>(jet.y[j].times_power_of_two(-scales.column[j]))));
}

// Up to as many unknowns Newton's method in Digits, and least squares, whose matrices are dense.
constexpr std::size_t most_dense = 200;

// Whether the unknowns that are held are, but for the rounding of doubles, what they were.
bool are_rounded(const Jet& jet, const Jet& start, const std::vector<bool>& held) {
  constexpr double rounding = 1e-14;
  double largest = 0.0, change = 0.0;
  for (std::size_t j = 0; j < held.size(); ++j) {
    if (!held[j]) continue;
    largest = std::max(largest, std::fabs(static_cast<double>(start.y[j])));
    change = std::max(change, std::fabs(static_cast<double>(jet.y[j] - start.y[j])));
  }
  return change <= rounding * largest;
}

// The first digits of the fine part.
DoubleDouble two_terms(const Digits& number) {
  const auto high = static_cast<double>(number);
  const Digits rest = number.corrected(0.0, high);
  return {high, static_cast<double>(rest)};
}

// What is left of a zero in the fine digits, next to the terms of an equation: where a search ends earlier what depends on
// it shrinks by hardly as much as a zero has to.
constexpr double deep = 0x1p-200;

}  // namespace

NearestJet::NearestJet(const JetEquations& equations, const InitialGuess& guess,
                       const SparseMatrixXd& metric)
    : equations_(equations),
      guess_(guess),
      rough_search_(equations.in_chart(), guess, metric),
      rough_(rough_search_.start()),
      metric_(metric) {
  for (const double number : guess.x) given_x_.push_back(Digits::written(number));
  before_ = jet_of(rough_, 0);
}

std::vector<bool> NearestJet::held_unknowns(Index k) const {
  std::vector<bool> stays(static_cast<std::size_t>(equations_.unknown_count(k)), false);
  const auto hold = [&](Index j) { stays[static_cast<std::size_t>(j)] = true; };
  const Index N = equations_.point_size();
  for (const Index j : guess_.hold_x) hold(j);
  if (equations_.system().manifold()->has_identity_frame())
    for (const Index j : guess_.hold_v) hold(N + j);
  for (const Index j : guess_.hold_z) hold(2 * N + j);
  return stays;
}

double NearestJet::distance(const Jet& jet) const {
  VectorXd moved(std::ssize(given_x_));
  for (std::size_t j = 0; j < given_x_.size(); ++j)
    moved[static_cast<Index>(j)] = static_cast<double>(jet.y[j] - given_x_[j]);
  return metric_.size() == 0 ? moved.norm() : std::sqrt(std::max(0.0, moved.dot(metric_ * moved)));
}

Jet NearestJet::jet_of(const ConsistentJet& rough, Index k) const {
  const Index N = equations_.point_size(), m = equations_.auxiliary_size();
  const DerivativeArray& array = rough.array();
  const Manifold& M = *equations_.system().manifold();
  const VectorXd &y = rough.zero().y, &nominal = rough.zero().nominal;
  Jet jet{.k = k, .t = Digits::written(guess_.t), .y = {}};
  jet.y.resize(static_cast<std::size_t>(equations_.unknown_count(k)));
  // What a search leaves in unknowns that vanish is round-off of what they were on the way.
  constexpr double round_off = 1e-12;
  const auto number = [&](Index j) {
    const double unit = j < nominal.size() ? nominal[j] : 0.0;
    return std::fabs(y[j]) <= round_off * unit ? 0.0 : y[j];
  };
  const auto set = [&](Index j, double value) { jet.y[static_cast<std::size_t>(j)] = value; };
  for (Index i = 0; i <= k; ++i)
    for (Index j = 0; j < m; ++j) set(equations_.z_offset(i) + j, number(array.z_offset(i) + j));
  if (M.has_identity_frame()) {
    for (Index j = 0; j < N; ++j) set(j, array.origin()[j] + y[j]);
    for (Index i = 1; i <= k + 1; ++i)
      for (Index j = 0; j < N; ++j) set(equations_.x_offset(i) + j, number(array.x_offset(i) + j));
  } else {
    const Graph graph;
    const Index n = M.dimension(), width = k + 2;
    const ExprVector xi = graph.variables("xi", n);
    const SeriesFunction chart({xi},
                               M.chart(constants(array.origin()), constants(array.basis()), xi));
    std::vector<double> in(static_cast<std::size_t>(n * width)),
        out(static_cast<std::size_t>(N * width));
    for (Index i = 0; i <= k + 1; ++i)
      for (Index j = 0; j < n; ++j)
        in[static_cast<std::size_t>(j * width + i)] = number(array.x_offset(i) + j);
    const double* group = in.data();
    chart.run(&group, k + 1, out.data());
    for (Index i = 0; i <= k + 1; ++i) {
      double largest = 0.0;
      for (Index j = 0; j < N; ++j)
        largest = std::max(largest, std::fabs(out[static_cast<std::size_t>(j * width + i)]));
      for (Index j = 0; j < N; ++j) {
        const double value = out[static_cast<std::size_t>(j * width + i)];
        set(equations_.x_offset(i) + j, std::fabs(value) <= 1e-15 * largest ? 0.0 : value);
      }
    }
  }
  // What stayed where it was given is what was written.
  for (Index j = 0; j < N; ++j)
    if (std::fabs(static_cast<double>(jet.y[static_cast<std::size_t>(j)]) - guess_.x[j]) <=
        4e-16 * std::max(std::fabs(guess_.x[j]), guess_.x.lpNorm<Eigen::Infinity>() * 0x1p-20))
      jet.y[static_cast<std::size_t>(j)] = given_x_[static_cast<std::size_t>(j)];
  const auto written = [&](Index offset, const VectorXd& given) {
    for (Index j = 0; j < given.size(); ++j)
      if (Digits& value = jet.y[static_cast<std::size_t>(offset + j)];
          static_cast<double>(value) == given[j])
        value = Digits::written(given[j]);
  };
  if (M.has_identity_frame()) written(N, guess_.v);
  written(2 * N, guess_.z);
  return jet;
}

// What a jet of the level below, with zeros for what is new, becomes if x stays, or what is given of it: higher
// coefficients are in the equations to the first power, so that nothing has to be searched.
NearestJet::Found NearestJet::continued(Index k) const {
  Jet jet = before_;
  jet.k = k;
  jet.y.resize(static_cast<std::size_t>(equations_.unknown_count(k)));
  const Index N = equations_.point_size();
  std::vector<bool> given = held_unknowns(k);
  for (Index j = 0; j < N; ++j)
    if (metric_.size() == 0 || metric_.coeff(j, j) != 0.0)
      given[static_cast<std::size_t>(j)] = true;
  std::vector<bool> all = given;
  std::fill_n(all.begin(), N, true);
  const auto at = equations_.at(jet.t, jet.y, k);
  Found found{.jet = jet};
  if (!are_all_finite(at.residual) || !are_all_finite(at.entries)) return found;
  const std::vector<JetEquations::Entry> places = equations_.pattern(k);
  for (const bool with_digits : {false, true})
    for (const std::vector<bool>& stays : {all, given}) {
      for (const bool by_sizes : {true, false}) {
        BinaryScales scales(equations_, k);
        by_sizes ? scales.update(places, at.entries, jet) : scales.update(places, at.entries);
        found = refined(jet, stays, scales, with_digits);
        if (found.is_zero && keeps_velocities(found.jet)) return tidied(found, stays, scales);
      }
      if (all == given) break;
    }
  found.is_zero = false;
  return found;
}

// Whether velocities that are held are what was given, on manifolds where they are no unknowns of a jet.
bool NearestJet::keeps_velocities(const Jet& jet) const {
  constexpr double rounding = 1e-12;
  const Manifold& M = *equations_.system().manifold();
  if (guess_.hold_v.empty() || M.has_identity_frame()) return true;
  const Index N = equations_.point_size();
  VectorXd y(2 * N);
  for (Index j = 0; j < y.size(); ++j)
    y[j] = static_cast<double>(jet.y[static_cast<std::size_t>(j)]);
  const VectorXd v = M.coframe(VectorXd(y.head(N))) * VectorXd(y.tail(N));
  const double most =
      rounding * std::max(guess_.v.lpNorm<Eigen::Infinity>(), v.lpNorm<Eigen::Infinity>());
  return std::all_of(guess_.hold_v.begin(), guess_.hold_v.end(),
                     [&](Index i) { return std::fabs(v[i] - guess_.v[i]) <= most; });
}

NearestJet::Found NearestJet::find(Index k) {
  Found found = continued(k);
  if (!found.is_zero) found = searched(k);
  if (!found.is_zero && found.is_finite) found = descended(k, found);
  if (found.is_zero) before_ = found.jet;
  return found;
}

NearestJet::Found NearestJet::searched(Index k) {
  // The nearest zero is found level by level, also where those below needed no search.
  for (; next_level_ < k; ++next_level_) {
    ConsistentJet below = rough_search_.find(rough_.at_level(next_level_));
    if (below.zero().found) rough_ = std::move(below);
  }
  next_level_ = k + 1;
  rough_ = rough_.at_level(k);
  const ConsistentJet next = rough_search_.find(rough_);
  Found found{.jet = jet_of(next.zero().y.size() == rough_.zero().y.size() ? next : rough_, k)};
  found.is_finite = next.zero().is_finite;
  if (!next.zero().is_finite) return found;
  if (!next.zero().found) {
    found.residual = next.array().residual(next.zero().y).lpNorm<Eigen::Infinity>();
    return found;
  }
  rough_ = next;
  const std::vector<bool> held = held_unknowns(k);
  // Coordinates that the search left where they were given stay there if they can.
  std::vector<bool> unmoved = held;
  for (std::size_t j = 0; j < given_x_.size(); ++j)
    unmoved[j] = unmoved[j] || found.jet.y[j] == given_x_[j];
  const Jet start = found.jet;
  const std::vector<JetEquations::Entry> places = equations_.pattern(k);
  const auto at = equations_.at(start.t, start.y, k);
  for (const bool by_sizes : {true, false}) {
    BinaryScales scales(equations_, k);
    by_sizes ? scales.update(places, at.entries, start) : scales.update(places, at.entries);
    for (const std::vector<bool>& stays : {unmoved, held}) {
      found = refined(start, stays, scales);
      found.was_near = true;
      if (found.is_zero) return tidied(found, stays, scales);
      if (unmoved == held) break;
    }
    // Doubles that are held are as exact as they are.
    const std::vector<bool> free(held.size(), false);
    if (held == free) continue;
    Found moved = refined(start, free, scales);
    if (moved.is_zero && are_rounded(moved.jet, start, held)) {
      moved.was_near = true;
      return tidied(moved, held, scales);
    }
  }
  return found;
}

NearestJet::Found NearestJet::refined(Jet jet, const std::vector<bool>& stays, BinaryScales scales,
                                      bool with_digits) const {
  // Each precision ends where its own digits do: going on, the coarse part of an unknown that is zero would fall as
  // far as the fine one, and would not tell.
  constexpr int most_steps = 40;
  constexpr double coarse_end = 0x1p-90, fine_end = 0x1p-252, slow = 0.25;
  const Index k = jet.k;
  begin_at_one_place(jet);
  const std::vector<JetEquations::Entry> places = equations_.pattern(k);
  const auto at = equations_.at(jet.t, jet.y, k);
  Found found{.jet = jet};
  if (!are_all_finite(at.residual) || !are_all_finite(at.entries)) return found;
  scales.update(places, at.entries, jet);
  const std::vector<std::int64_t> whole_rows = scales.row;
  scales.scale_rows(places, at.entries, stays);
  FreeColumns part(equations_.unknown_count(k));
  for (std::size_t j = 0; j < stays.size(); ++j)
    if (!stays[j]) part.add(static_cast<Index>(j));
  const auto residual_of = [&](const std::vector<Digits>& F) {
    double largest = 0.0;
    for (std::size_t i = 0; i < F.size(); ++i)
      largest =
          std::max(largest, std::fabs(static_cast<double>(F[i].times_power_of_two(whole_rows[i]))));
    return largest;
  };
  // An equation that nothing that is free stands in stays as it is.
  std::vector<bool> is_open(at.residual.size(), false);
  for (const JetEquations::Entry& place : places) {
    const auto unknown = static_cast<std::size_t>(place.column);
    if (unknown < part.column.size() && part.column[unknown] >= 0)
      is_open[static_cast<std::size_t>(place.row)] = true;
  }
  for (std::size_t i = 0; i < is_open.size(); ++i)
    if (!is_open[i] && !at.residual[i].shrinks()) {
      found.residual = residual_of(at.residual);
      return found;
    }
  const LeastSolution inverse(scaled_part(places, at.entries, scales, part));
  std::vector<Digits> F = at.residual;
  double before = -1.0;
  for (int step = 0; step < most_steps; ++step) {
    MatrixXd f(std::ssize(F), 2);
    for (std::size_t i = 0; i < F.size(); ++i) {
      const Digits scaled_row = F[i].times_power_of_two(scales.row[i]);
      f(static_cast<Index>(i), 0) = scaled_row.coarse();
      f(static_cast<Index>(i), 1) = static_cast<double>(scaled_row);
    }
    const MatrixXd d = inverse.solve(f);
    if (!d.allFinite() || d.size() == 0) break;
    // Each next to the size of its unknown.
    MatrixXd relative = d;
    for (std::size_t c = 0; c < part.unknown.size(); ++c)
      relative.row(static_cast<Index>(c)) /=
          size_of_unknown(jet, scales, static_cast<std::size_t>(part.unknown[c]));
    const double length = relative.col(1).lpNorm<Eigen::Infinity>();
    const bool moves_coarse = relative.col(0).lpNorm<Eigen::Infinity>() > coarse_end;
    if (length <= fine_end || (before >= 0.0 && length > slow * before)) break;
    before = length;
    for (std::size_t c = 0; c < part.unknown.size(); ++c) {
      const auto j = static_cast<std::size_t>(part.unknown[c]);
      const auto row = static_cast<Index>(c);
      if (std::fabs(relative(row, 1)) <= noise_of_step * length) continue;
      const Digits change = Digits().corrected(moves_coarse ? -d(row, 0) : 0.0, -d(row, 1));
      jet.y[j] -= change.times_power_of_two(scales.column[j]);
    }
    F = equations_.residual(jet.t, jet.y, k);
  }
  settle_unknowns(jet);
  found.jet = jet;
  found.is_zero =
      std::all_of(F.begin(), F.end(), [](const Digits& a) { return a.is_finite() && a.shrinks(); });
  found.residual = residual_of(F);
  const bool is_deep = found.is_zero && found.residual <= deep;
  if (is_deep || !with_digits || part.unknown.size() > most_dense) return found;
  Found by_newton = newton(found.jet, stays, scales);
  return by_newton.is_zero ? by_newton : found;
}

NearestJet::Found NearestJet::tidied(const Found& found, std::vector<bool> stays,
                                     const BinaryScales& scales) const {
  constexpr std::int64_t tiny = -80;
  Jet jet = found.jet;
  bool any = false;
  for (std::size_t j = 0; j < jet.y.size(); ++j) {
    if (stays[j] || jet.y[j].is_zero() || jet.y[j].exponent() - scales.column[j] > tiny) continue;
    jet.y[j] = Digits();
    stays[j] = any = true;
  }
  if (!any) return found;
  Found tidy = refined(std::move(jet), stays, scales);
  return tidy.is_zero ? tidy : found;
}

// By Levenberg and Marquardt.
NearestJet::Found NearestJet::descended(Index k, const Found& before) const {
  constexpr int most_steps = 200;
  constexpr double flat = 1e-7, round_off = 1e-13, beside = 1e-6;
  Found result = before;
  const Index size = equations_.unknown_count(k);
  if (size > static_cast<Index>(most_dense)) return result;
  Jet jet = before_;
  jet.k = k;
  jet.y.resize(static_cast<std::size_t>(size));
  const std::vector<JetEquations::Entry> entries = equations_.pattern(k);
  const auto first = equations_.at(jet.t, jet.y, k);
  if (!are_all_finite(first.residual) || !are_all_finite(first.entries)) return result;
  BinaryScales scales(equations_, k);
  scales.update(entries, first.entries, jet);
  const std::vector<bool> held = held_unknowns(k);
  const double t = static_cast<double>(jet.t);
  const auto unit = [&](std::size_t j) {
    return held[j] ? 0.0 : std::ldexp(1.0, static_cast<int>(scales.column[j]));
  };
  const auto residual_at = [&](const std::vector<double>& there) {
    const std::vector<double> F = equations_.residual(t, there, k);
    VectorXd f(std::ssize(F));
    for (Index i = 0; i < f.size(); ++i)
      f[i] = std::ldexp(F[static_cast<std::size_t>(i)],
                        static_cast<int>(scales.row[static_cast<std::size_t>(i)]));
    return f;
  };
  // A point around, near or far, where less is left.
  const auto lower_around = [&](const std::vector<double>& here,
                                double left) -> std::optional<std::vector<double>> {
    constexpr double much_less = 0.999;
    constexpr int nearest = -20, farthest = 20, stride = 4, directions = 6;
    for (int away = nearest; away <= farthest; away += stride)
      for (int direction = 0; direction < directions; ++direction) {
        std::vector<double> there = here;
        for (std::size_t j = 0; j < there.size(); ++j)
          there[j] += unit(j) * std::ldexp(std::cos((1.0 + 1.7 * static_cast<double>(j)) *
                                                        static_cast<double>(direction + 1) +
                                                    static_cast<double>(direction)),
                                           away);
        if (const VectorXd next = residual_at(there);
            next.allFinite() && next.norm() < much_less * left)
          return there;
      }
    return std::nullopt;
  };
  std::vector<double> y;
  for (const Digits& number : jet.y) y.push_back(static_cast<double>(number));
  VectorXd f = residual_at(y);
  double damping = 1.0;
  double terms = 0.0;  // the size of what cancels in a zero
  for (int step = 0; step < most_steps && f.allFinite() && f.norm() > 0.0; ++step) {
    const auto at = equations_.at(t, y, k);
    MatrixXd J = MatrixXd::Zero(f.size(), size);
    for (std::size_t e = 0; e < entries.size(); ++e) {
      const auto [i, j] = entries[e];
      if (j < size)
        J(i, j) =
            std::ldexp(at.entries[e], static_cast<int>(scales.row[static_cast<std::size_t>(i)])) *
            unit(static_cast<std::size_t>(j));
    }
    if (!J.allFinite()) return result;
    VectorXd in_units(size);
    for (Index j = 0; j < size; ++j) {
      const auto i = static_cast<std::size_t>(j);
      in_units[j] = held[i] ? 0.0 : std::fabs(y[i]) / unit(i);
    }
    terms = VectorXd(J.cwiseAbs() * in_units).norm();
    if (f.norm() <= round_off * terms) break;
    const VectorXd gradient = J.transpose() * f;
    if (gradient.norm() <= flat * f.norm()) {
      // A critical point may be the centre of a circle.
      const std::optional<std::vector<double>> lower = lower_around(y, f.norm());
      result.is_least = !lower;
      if (!lower) break;
      y = *lower;
      f = residual_at(y);
      continue;
    }
    MatrixXd damped(J.rows() + size, size);
    damped << J, std::sqrt(damping) * MatrixXd::Identity(size, size);
    VectorXd right = VectorXd::Zero(J.rows() + size);
    right.head(J.rows()) = -f;
    const MatrixXd d = CompleteOrthogonalDecomposition(damped, 0.0).solve(right);
    std::vector<double> there = y;
    for (Index j = 0; j < size; ++j)
      there[static_cast<std::size_t>(j)] += d(j, 0) * unit(static_cast<std::size_t>(j));
    const VectorXd next = residual_at(there);
    if (next.allFinite() && next.norm() < f.norm()) {
      y = there;
      f = next;
      damping = std::max(1e-12, 0.3 * damping);
    } else {
      damping *= 4.0;
      if (damping > 1e12) break;
    }
  }
  if (!f.allFinite() || f.norm() > beside * terms) return result;
  for (std::size_t j = 0; j < y.size(); ++j)
    if (static_cast<double>(jet.y[j]) != y[j]) jet.y[j] = y[j];
  const auto at = equations_.at(jet.t, jet.y, k);
  for (const bool by_sizes : {true, false}) {
    BinaryScales there(equations_, k);
    by_sizes ? there.update(entries, at.entries, jet) : there.update(entries, at.entries);
    Found found = refined(jet, held, there);
    found.was_near = true;
    if (found.is_zero) return tidied(found, held, there);
  }
  return result;
}

NearestJet::Found NearestJet::find_displaced(const Jet& from, const BinaryScales& scales) const {
  return refined(from, std::vector<bool>(from.y.size(), false), scales);
}

// Newton's method with steps of least change in the scaled unknowns. Its matrix has 106 bits: what these leave of a step
// the next one corrects in each precision, as steps of one factorisation in doubles do.
NearestJet::Found NearestJet::newton(Jet jet, const std::vector<bool>& stays,
                                     BinaryScales scales) const {
  constexpr int most_steps = 20;
  constexpr double negligible_row = 0x1p-64, coarse_end = 0x1p-90, fine_end = 0x1p-240;
  // What dependent rows leave falls like the square of the error next to a zero.
  constexpr double much_less = 0x1p-4;
  double before = std::numeric_limits<double>::infinity(), left_before = before;
  const Index k = jet.k;
  begin_at_one_place(jet);
  const std::vector<JetEquations::Entry> places = equations_.pattern(k);
  Found found{.jet = jet};
  FreeColumns part(equations_.unknown_count(k));
  for (std::size_t j = 0; j < stays.size(); ++j)
    if (!stays[j]) part.add(static_cast<Index>(j));
  const std::size_t columns = part.unknown.size();
  for (int step = 0; step < most_steps; ++step) {
    const auto at = equations_.at(jet.t, jet.y, k);
    if (!are_all_finite(at.residual) || !are_all_finite(at.entries)) return found;
    const std::size_t row_count = at.residual.size();
    scales.update(places, at.entries, jet);
    scales.scale_rows(places, at.entries, stays);
    OrthogonalRows::Rows rows(row_count, std::vector<DoubleDouble>(columns));
    for (std::size_t e = 0; e < places.size(); ++e) {
      const auto unknown = static_cast<std::size_t>(places[e].column);
      if (unknown >= part.column.size() || part.column[unknown] < 0) continue;
      const auto i = static_cast<std::size_t>(places[e].row);
      Digits entry = at.entries[e].times_power_of_two(scales.row[i] + scales.column[unknown]);
      rows[i][static_cast<std::size_t>(part.column[unknown])] = two_terms(entry.settle());
    }
    std::vector<DoubleDouble> coarse(row_count), fine(row_count);
    for (std::size_t i = 0; i < row_count; ++i) {
      Digits right = -at.residual[i].times_power_of_two(scales.row[i]);
      right.settle();
      coarse[i] = right.coarse();
      fine[i] = two_terms(right);
    }
    const OrthogonalRows inverse(std::move(rows), negligible_row);
    const OrthogonalRows::Solution change = inverse.solve(std::move(fine));
    if (change.left > fine_end && step > 2 && change.left > much_less * left_before) break;
    left_before = std::max(change.left, fine_end);
    double length = 0.0;
    for (std::size_t c = 0; c < columns; ++c)
      length = std::max(
          length, std::fabs(change.x[c].high) /
                      size_of_unknown(jet, scales, static_cast<std::size_t>(part.unknown[c])));
    const bool moves_coarse = length > coarse_end;
    const std::vector<DoubleDouble> of_coarse =
        moves_coarse ? inverse.solve(std::move(coarse)).x : std::vector<DoubleDouble>(columns);
    for (std::size_t c = 0; c < columns; ++c) {
      const auto j = static_cast<std::size_t>(part.unknown[c]);
      const auto [high, low] = change.x[c];
      const Digits d = Digits().corrected(-of_coarse[c].high, -high).corrected(0.0, -low);
      jet.y[j] += d.times_power_of_two(scales.column[j]);
    }
    // The error is not squared, nor halved.
    if (length > fine_end && step > 2 && length > 0.5 * before) break;
    before = length;
    if (length > fine_end) continue;
    const std::vector<Digits> F = equations_.residual(jet.t, jet.y, k);
    settle_unknowns(jet);
    found.jet = jet;
    found.is_zero = std::all_of(F.begin(), F.end(),
                                [](const Digits& a) { return a.is_finite() && a.shrinks(); });
    return found;
  }
  found.jet = jet;
  return found;
}

}  // namespace courant
