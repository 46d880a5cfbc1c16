// The way up the levels of a ladder.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/ladder_levels.hpp"
#include "courant/integrators/certificate/singularity.hpp"

namespace courant {

// The levels S_0 over M_0, S_1 over M_1, … at zeros of F^[0], F^[1], …, each found from the one before, up to
// the first that repeats the dimensions of the one before; or to where the way ends: at a level that is empty,
// at a singular point, at equations that are not finite, where a search does not converge, where levels
// contradict each other, or at the highest level allowed.
struct LadderAscent {
  ConsistentJet jet;  // where it ended, of the last level
  std::vector<LadderLevel> levels;
  bool is_stopped = false;    // whether the last level repeats the one before
  bool has_converged = true;  // whether every search ended at a point or a contradiction
  std::string reason = "";    // why the way ended without a point; empty if it did not
  std::vector<NamedEquation> contradiction = {};  // where that is why
  Singularity singular = {};                      // of the last point that was looked at
  std::string changed = "";  // what a later point changed of earlier levels, in words

  LadderAscent(const ConsistentPoint& consistent, const ImplicitSystem& system, Index max_level);

  // Whether the last level has a point.
  bool has_point() const { return !levels.empty() && !levels.back().is_empty; }
  bool is_singular() const { return !singular.reason.empty(); }

 private:
  bool climb(const ConsistentPoint& consistent, const ImplicitSystem& system, Index k);
  void end_without_point(const ConsistentPoint& consistent, const ImplicitSystem& system,
                         const ConsistentJet& ended, Index k);
};

// Whether the last two levels have the same dimensions.
bool repeats(const std::vector<LadderLevel>& levels);

// What a search for a point of the next level changed of the levels before, in words; empty if nothing.
std::string change(const std::vector<LadderLevel>& before, const std::vector<LadderLevel>& now);

}  // namespace courant
