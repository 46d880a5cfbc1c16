// LadderReport: what is told of a ladder.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/integrators/certificate/constraint_classes.hpp"
#include "courant/integrators/certificate/constraint_formulas.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/findings.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// The findings of the constraint algorithm in the names of the system, as `courant constraints
// --json` prints them and a summary has them. Lists are in the order of the system. What there is
// not (the dimension of a set that is empty, the index of a ladder that did not end) is nothing; a
// number that is not known or not finite is NaN.
struct LadderReport {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  using Values = std::vector<std::pair<std::string, double>>;  // by name

  Verdict verdict = Verdict::not_reached;
  std::optional<Index> index = {};
  Index gauge_dimension = 0;
  std::optional<Index> degrees_of_freedom = {};
  std::optional<Index> dimension = {};  // of M
  struct Level {
    Index k = 0;
    std::optional<Index> dim_S = {}, dim_M = {}, fibre = {};
    // Of the rank decision with the smallest gap.
    double gap = kUnknown, smallest_counted = kUnknown, largest_neglected = kUnknown;
    double residual = kUnknown;
  };
  std::vector<Level> levels = {};
  Values consistent_point = {};
  double moved = 0.0;
  std::vector<Movement> moves = {};
  bool is_impulse = false;  // they are the jumps of an impulse
  // Of unknowns that have another value as well: from this one to that.
  std::vector<Movement> choices = {};
  // Of a MorseFamily E(x, λ) that the system is given by, at the consistent point: how many λ there
  // are, and the rank of ∂_λ(∂_xE, ∂_λE).
  struct Family {
    Index multipliers = 0, rank = 0;
    bool is_morse() const { return rank == multipliers; }
  };
  std::optional<Family> family = {};
  bool is_ambiguous = false;
  std::vector<Doubt> doubts = {};
  std::optional<LadderProof> proof = {};
  std::string reason = {};
  std::vector<NamedEquation> contradiction = {};  // that the reason has in words

  struct Classes {
    Index primary = 0, secondary = 0;
    std::optional<ConstraintClasses::Brackets> brackets = {};
    bool is_ambiguous = false;
    Index degrees_of_freedom_up_to_gauge = 0;
  };
  std::optional<Classes> classes = {};

  struct Term {
    std::string equation;
    Index derivative = 0;
    double coefficient = 0.0;
  };
  using Origin = std::vector<Term>;  // a combination of equations and their derivatives
  struct Constraint {
    Index level = 0;
    Values gradient = {};
    Origin from = {};
  };
  // Of a ladder that has an end.
  std::optional<std::vector<Constraint>> constraints = {};

  struct Velocity {
    std::string name;
    Index level = 0;  // from which it is a function of the point
    std::string formula;
    std::string on_M_f = {};  // where constraints of later levels make it simpler
  };
  // What elimination by hand would find; not of ladders that stopped on the way.
  struct Elimination {
    std::vector<ConstraintFormulas::Constraint> formulas = {};
    std::vector<ConstraintFormulas::Step> steps = {};
    std::vector<Velocity> velocities = {};

    const Velocity* velocity(const std::string& name) const;  // nothing if there is none
  };
  std::optional<Elimination> elimination = {};

  struct Unknown {
    std::string name;
    double value = kUnknown;
    bool is_determined = false;
    std::optional<std::string> formula = {};
  };
  // (dim S, dim M) of each level but those that only confirm the one before.
  using Dimensions = std::pair<std::optional<Index>, std::optional<Index>>;
  std::vector<Dimensions> dimensions() const;

  // So many constraints of a joint follow from others, of as many as it has.
  struct RedundantJoint {
    std::string joint;
    Index conditions = 0, of = 0;
  };
  // What is known at the end.
  struct End {
    std::vector<Unknown> unknowns = {};
    std::vector<Values> gauge_directions = {};
    std::vector<std::string> determined_velocities = {};  // that gauge leaves as they are
    std::vector<std::pair<std::string, Index>> differentiations =
        {};                              // of which equation, how often
    std::vector<Origin> redundant = {};  // dependences among the equations themselves
    // Of a mechanism, the joints of which constraints follow from others, later ones first to be so.
    std::vector<RedundantJoint> redundant_joints = {};
  };
  std::optional<End> end = {};
};

LadderReport ladder_report(const ConstraintLadder& ladder, const ImplicitSystem& system);
// The same for who has the formulas of its constraints.
LadderReport ladder_report(const ConstraintLadder& ladder, const ImplicitSystem& system,
                           const ConstraintFormulas& formulas);

// Verdict, levels and the point alone, without formulas: all there is of a DiscreteConstraintAlgorithm, where it is the
// first point of the chain.
LadderReport discrete_ladder_report(const ConstraintLadder& ladder, const ImplicitSystem& system);

// What of a ladder is known when the algorithm stops at this level; the ladder itself if it ends
// there or before.
LadderReport up_to_level(LadderReport ladder, Index level);

// The JSON of a ladder, and back. What is missing in it is not known. Throws std::invalid_argument,
// `/verdict: what it is`, for words that it does not know.
Json to_json(const LadderReport& ladder);
LadderReport read_ladder_report(const Json& json);

}  // namespace courant
