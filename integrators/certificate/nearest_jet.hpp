// NearestJet: the consistent point nearest to what was given, in the digits of the decision.
#pragma once

#include <vector>

#include "courant/integrators/certificate/binary_scales.hpp"
#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/jet_equations.hpp"

namespace courant {

// Zeros of F^[k] near a guess: where x can stay, from the zero of the level below; else what a search in doubles
// (ConsistentPoint) finds. Both are taken to the ends of both precisions by corrections with one factorisation, or,
// where these do not converge, by Newton's method with 106 bits.
//
// A zero is one if every equation shrinks there: how it was found plays no part. What the search left where it was
// given is what was written there (Digits::written), and stays if it can.
class NearestJet {
 public:
  // Throws std::invalid_argument if sizes do not fit the system. `metric`: W, N × N; empty for 1.
  NearestJet(const JetEquations& equations, const InitialGuess& guess,
             const SparseMatrixXd& metric);

  const Jet& start() const { return before_; }
  struct Found {
    Jet jet;  // the zero, or where the search ended
    bool is_zero = false;
    bool is_finite = true;  // F and its derivatives, on the way
    bool was_near = false;  // in doubles it was one
    // There is no zero near: least squares end where the residual is not small and no point around has less.
    bool is_least = false;
    double residual = 0.0;  // the largest
  };
  // Of level k, after those of all levels below.
  Found find(Index k);
  // Near a jet that is displaced from a zero where unknowns have these sizes; what was given may change.
  Found find_displaced(const Jet& from, const BinaryScales& scales) const;

  // ‖x - x_given‖_W.
  double distance(const Jet& jet) const;

 private:
  Found continued(Index k) const;
  bool keeps_velocities(const Jet& jet) const;
  Found searched(Index k);
  // By least squares in doubles from the last zero, what is held held; `before` is what other searches found.
  Found descended(Index k, const Found& before) const;
  Jet jet_of(const ConsistentJet& rough, Index k) const;
  std::vector<bool> held_unknowns(Index k) const;
  // `with_digits`: by Newton's method with 106 bits where steps in doubles do not end at a zero.
  Found refined(Jet jet, const std::vector<bool>& stays, BinaryScales scales,
                bool with_digits = true) const;
  Found newton(Jet jet, const std::vector<bool>& stays, BinaryScales scales) const;
  // The same zero with 0 for what is open and was left by rounding, where that is one.
  Found tidied(const Found& found, std::vector<bool> stays, const BinaryScales& scales) const;

  const JetEquations& equations_;
  InitialGuess guess_;
  ConsistentPoint rough_search_;
  ConsistentJet rough_;
  Index next_level_ = 0;   // that rough_search_ has not looked at
  SparseMatrixXd metric_;  // W; empty for 1
  std::vector<Digits> given_x_;
  Jet before_;  // the last that was found
};

}  // namespace courant
