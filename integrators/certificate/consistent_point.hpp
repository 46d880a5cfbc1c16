// Consistent points: zeros of a derivative array near given values.
#pragma once

#include <memory>
#include <utility>

#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/certificate/derivative_array.hpp"
#include "courant/integrators/certificate/initial_guess.hpp"
#include "courant/integrators/certificate/least_deviation.hpp"
#include "courant/integrators/certificate/least_zero.hpp"

namespace courant {

// A jet y that solves F^[k] = 0 (if zero().found) in the chart of array(), whose origin is its point
// (ξ_0 = 0) unless it is a neighbour of one. zero().nominal has the largest sizes of the unknowns on the way there.
// y, its nominal values and its uncertainty are always of one level of that array.
class ConsistentJet {
 public:
  // Throws std::invalid_argument if they are not.
  ConsistentJet(DerivativeArray array, Zero zero);

  const DerivativeArray& array() const { return array_; }
  const Zero& zero() const { return zero_; }
  Index level() const { return level_; }  // k
  // The same of level k: with zeros appended, or cut.
  ConsistentJet at_level(Index k) const;

 private:
  DerivativeArray array_;
  Zero zero_;
  Index level_ = 0;
};

// (x, v, z), the N + Ñ + m numbers of a state.
VectorXd numbers_of(const State& state);

// What of a state is to change least: ‖root ((x, v, z)[rows] - given)‖.
struct LeastChange {
  std::vector<Index> rows;  // of numbers_of()
  VectorXd given;
  SparseMatrixXd root;  // of the metric, with as many columns

  double of(const State& state) const;  // that
};

// Where F^[k] vanishes near a guess.
//
// Values that are held are conditions beside F^[k]; x stays exactly where it is if the other
// unknowns alone can solve F^[k] = 0, otherwise it goes to the zero with the least ½ (x - x_given)ᵀ
// W (x - x_given) nearby. v and z of the guess choose between branches and give the iteration its
// start.
class ConsistentPoint {
 public:
  // Throws std::invalid_argument if sizes do not fit the system. `metric`: W, N × N, or empty
  // for 1.
  ConsistentPoint(const std::shared_ptr<const ChartEquations>& equations, InitialGuess guess,
                  SparseMatrixXd metric);
  // Of equations that are traced for it alone.
  ConsistentPoint(const std::shared_ptr<const ImplicitSystem>& system, InitialGuess guess,
                  SparseMatrixXd metric)
      : ConsistentPoint(std::make_shared<const ChartEquations>(system), std::move(guess),
                        std::move(metric)) {}

  // The given values as a jet of level 0; x is brought to the manifold. On Rⁿ given numbers that are
  // round-off next to the units of the problem, as the cosine of a right angle, are 0.
  ConsistentJet start() const;
  // The zero of F^[k] near `from`, whose jet is of level k.
  ConsistentJet find(const ConsistentJet& from) const;
  // The zero of F^[k] near `from`, a zero, at which `change` is least, and those of the held values and `kept`, rows
  // of (x, v, z), what they are.
  using Values = std::vector<std::pair<Index, double>>;  // row of (x, v, z), value
  struct Least {
    ConsistentJet jet;
    LeastDeviation found;
  };
  Least least_changed(const ConsistentJet& from, const LeastChange& change,
                      const Values& kept) const;
  // A zero of F^[k] near the point x, from v and z, which may be empty: 0. Its level and its time are those of `like`.
  // Where a search ends among numbers so much smaller than those that it began with that these hide its digits, as at
  // a circle of radius 1 from (10⁹, 1), it begins again there.
  ConsistentJet find_from(const VectorXd& x, const VectorXd& v, const VectorXd& z,
                          const ConsistentJet& like) const;
  // The jet of a ladder that has a point, as a zero: whether it is one, is_met_at says.
  ConsistentJet jet_of(const ConstraintLadder& ladder) const;
  // Whether each equation of F^[k], and each held value, vanishes at the jet next to the terms that it is the sum of
  // there, or, as the product of a velocity of 10⁻¹⁷ with a coordinate, next to 1 and the terms that numbers of the
  // sizes there may make. A search has units of its own, which may be those of what it met on its way.
  bool is_met_at(const ConsistentJet& jet, double unseen = 1e-9, double nothing = 1e-12) const;
  // Whether the linear parts of the equations contradict each other at a jet that is no zero: whether
  // rank (J | F) exceeds rank J. Elsewhere a search that ended has merely not converged.
  bool is_contradiction(const ConsistentJet& jet) const;
  // The same zero found once more, from its point, velocity and unknowns alone: higher coefficients
  // that the equations leave open lose what the search left in them.
  ConsistentJet again(const ConsistentJet& jet) const;
  // A zero of F^[k] near `from`, its jet displaced by `displacement`, and how far from there it is.
  // Held values may change. The jet stays in the chart of `from`, where its ξ_0 is not 0.
  // `magnitude`: of the Jacobian around `from` (generic_magnitude).
  struct Neighbour {
    ConsistentJet jet;
    VectorXd correction;
  };
  Neighbour find_displaced(const ConsistentJet& from, const VectorXd& displacement,
                           const SparseMatrixXd& magnitude) const;
  // The same, `later` in time: from where the curve leads whose jet `from` is.
  Neighbour find_later(const ConsistentJet& from, const VectorXd& displacement, double later) const;

  // The zero of F^[k] near `from`, of level k, with ξ_0 = `xi` in its chart. Held values may change.
  ConsistentJet find_at(const ConsistentJet& from, const VectorXd& xi) const;

  // ‖x - x_given‖_W.
  double distance(const VectorXd& x) const;

 private:
  static LinearizableMap conditions(const DerivativeArray& array, const Values& held);
  Mobility mobility(const ConsistentJet& from, bool x_is_free) const;
  Quadratic displacement(const DerivativeArray& array, const VectorXd& y) const;
  // From where a search ended at the edge of a chart, as that of the sphere does on T*S², the zero
  // that it was on the way to, in charts farther on; empty if there is none or no edge.
  std::optional<ConsistentJet> find_beyond(const ConsistentJet& ended) const;
  // By the unknowns of as few levels as solve the equations, the last ones; none if those of the first have to move.
  std::optional<Zero> find_above(const ConsistentJet& from, const LinearizableMap& F) const;
  ConsistentJet recentred(const DerivativeArray& array, const Zero& zero, const Values& held) const;

  Neighbour find_around(const ConsistentJet& from, const DerivativeArray& array,
                        const VectorXd& start, const VectorXd& displacement,
                        const SparseMatrixXd& magnitude) const;
  void drop_round_off();

  std::shared_ptr<const ImplicitSystem> system_;
  InitialGuess guess_;
  bool z_is_given_ = false;
  SparseMatrixXd metric_;
  std::optional<DerivativeArray> array_;  // at the given point
  Values held_;
};

}  // namespace courant
