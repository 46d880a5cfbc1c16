// ConstraintLadder: what the constraint algorithm found.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/core/linear/rank_decision.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// What the constraint algorithm says of a system near a point.
enum class Verdict {
  regular,       // S_f is the graph of a vector field on M_f
  gauge,         // the velocity at a point of M_f is free in gauge_dimension directions
  inconsistent,  // some S_k is empty near the point
  rank_change,   // the point is singular: nearby, the sets have other dimensions
  not_reached,   // dimensions still fell at the highest level allowed
};

std::string to_string(
    Verdict verdict);  // "regular", "gauge", "inconsistent", "rank-change", "not-reached"

// S_k over M_k at the consistent point.
struct LadderLevel {
  Index k = 0;
  bool is_empty = false;  // no point of S_k was found; the dimensions are then -1
  Index dim_S = -1;
  Index dim_M = -1;
  double residual = 0.0;  // ‖F^[k]‖_∞ at the point; of an empty level, the least that was found
  // Whether F^[k] vanishes at the point as far as it is known.
  bool is_solved = true;
  // The ranks behind the dimensions: of the Jacobian J of F^[k], of its part J_S without the
  // columns (x, v), and J_M without x.
  //   dim S_k = 2n - rank J + rank J_S,   dim M_k = n - rank J + rank J_M
  RankDecision all, without_tangent, without_point;

  // The dimension of the velocities in S_k at a point of M_k.
  Index fibre() const { return dim_S - dim_M; }
  // The least gap of the three decisions, and whether any of them is in doubt.
  double gap() const { return std::min({all.gap, without_tangent.gap, without_point.gap}); }
  bool is_ambiguous() const {
    return all.ambiguous() || without_tangent.ambiguous() || without_point.ambiguous();
  }
};

// Why a ladder is not certain. There are five reasons, and each says which it is.
struct Doubt {
  enum class Kind {
    near_singular,  // within half a unit of the last digit that was typed is a point with other ranks
    neighbours,     // consistent points nearby have other ranks, or two ways to count disagree
    not_transversal,  // Newton's method does not square its error at the zero: it may be a double one
    search,     // the search for a consistent point did not end, or a derivative is not finite
    at_switch,  // abs, sign, min, max or a comparison is at its edge
  };
  Kind kind = Kind::neighbours;
  std::string text;

  Doubt(Kind of, std::string sentence) : kind(of), text(std::move(sentence)) {}
  Doubt(std::string sentence) : text(std::move(sentence)) {}  // NOLINT(google-explicit-constructor)
  Doubt(const char* sentence) : text(sentence) {}             // NOLINT(google-explicit-constructor)
};

// "near-singular", "neighbours", "not-transversal", "search", "switch"
std::string to_string(Doubt::Kind kind);
// The kind of that name; throws std::invalid_argument if there is none.
Doubt::Kind doubt_kind(const std::string& name);

// An equation, or one of its time derivatives, by its name.
struct NamedEquation {
  std::string name;
  Index derivative = 0;
};
// "x + y - 1, d/dt x - t": up to so many of them, with commas between, and "…" for the others.
inline constexpr std::size_t kMostEquationsInWords = 6;
std::string in_words(const std::vector<NamedEquation>& equations);

// A given value that had to move to be consistent.
struct Movement {
  std::string name;
  double from = 0.0, to = 0.0;
};

// A linear combination Σ c · dⁱF_e/dtⁱ of equations and their derivatives, at the point.
struct Combination {
  struct Term {
    Index equation;
    Index derivative;  // i
    double coefficient;
  };
  std::vector<Term> terms;
};

// A function on M that vanishes on M_k but not on M_{k-1}, by its differential at the point and
// where it comes from.
struct PointConstraint {
  Index level = 0;          // 0: seen in the equations; ≥ 1: hidden
  VectorXd gradient;        // covector in the tangent representation of M (Ñ)
  Combination origin;       // of equations and derivatives, that is free of all other unknowns
  VectorXd gradient_error;  // bounds, entry by entry (Ñ)
};

// What of a ladder is proved, by arithmetic with balls, at a consistent jet y of level k and of the ranks that were
// decided there:
//
//   has_point   in a ball around y there is exactly one zero of as many equations of F^[k] as there are pivots,
//               for all other unknowns as they are (Newton's method maps the ball into itself)
//   not_zero    that many numbers, the pivots, are nowhere zero in this ball
//   zero        that many numbers that count as zero could not be proved to be: they shrink when the digits double
//
// Ranks are thus at least what the ladder says. Where `zero` is 0 they are what the ladder says at every point of the
// ball, so that they are constant around the point, which is the hypothesis of the constraint algorithm: dimensions,
// index and verdict are proved. A value.
struct LadderProof {
  bool has_point = false;
  double radius = 0.0;  // the largest of the ball's, of a coordinate
  Index not_zero = 0, zero = 0;
  // What could not be proved, in a sentence; empty if has_point and all pivots are not zero.
  std::string missing;

  bool is_whole() const { return missing.empty() && zero == 0; }
};

// The sets S_0 ⊇ S_1 ⊇ … over M_0 ⊇ M_1 ⊇ … of an implicit system near one point, and where they
// end: S_f over M_f.
//
// index is the smallest k with S_{k+1} = S_k and M_{k+1} = M_k; levels run to the confirming level
// k+1, or to the level that is empty, or to the highest that was tried. A value; see
// docs/constraint-algorithm.md.
struct ConstraintLadder {
  Verdict verdict = Verdict::not_reached;
  Index index = -1;
  Index gauge_dimension = 0;      // dim S_f - dim M_f
  Index degrees_of_freedom = -1;  // dim M_f
  std::vector<LadderLevel> levels;

  State point;         // consistent: x ∈ M_f, (x, v) ∈ S_f
  VectorXd jet;        // the Taylor coefficients there, as in Prolongation, in the chart at point.x
  double moved = 0.0;  // distance from the given x to point.x in the metric of the options
  std::vector<Movement> moves;

  // How many time derivatives of each equation (r) it takes to describe S_f.
  std::vector<int> differentiations;
  // Independent constraints whose common kernel is T M_f, by level: n - dim M_f of them.
  std::vector<PointConstraint> constraints;
  // Their gradients as rows: (n - dim M_f) × Ñ.
  MatrixXd conormals() const;
  // Combinations that vanish identically at the point: equations that follow from the others.
  std::vector<Combination> redundancies;
  // Columns: basis of {w : (x, v + w) ∈ S_f}, Ñ × gauge_dimension.
  MatrixXd gauge_directions;
  // Whether each component of the velocity (Ñ) is determined by the point: gauge freedom leaves some
  // of them as they are.
  std::vector<bool> determined_velocities;
  // Whether each auxiliary unknown (m) is determined by the point of M_f; its value is in point.z.
  std::vector<bool> determined;

  // One sentence: why the verdict is what it is.
  std::string reason;
  // The equations that contradict each other, where they are why: the reason has them in words.
  std::vector<NamedEquation> contradiction;
  // Why the verdict is not certain, a sentence each: what the levels contradict, where two ways to
  // count disagree.
  std::vector<Doubt> doubts;
  // Where one was asked for.
  std::optional<LadderProof> proof;

  const LadderLevel& final_level() const { return levels.back(); }
  // Whether a rank is doubtful or there are doubts.
  bool is_ambiguous() const;
};

// What the levels say that no ladder can: dimensions that rise, sets that are larger than the space
// they are in. A sentence each; none for levels of a ladder.
std::vector<std::string> contradictions(const std::vector<LadderLevel>& levels);

class ImplicitSystem;

// Throws std::invalid_argument unless the ladder has a point, and that and its equations have the
// sizes of this system. `place` begins the message.
void check_ladder(const std::string& place, const ImplicitSystem& system,
                  const ConstraintLadder& ladder);

}  // namespace courant
