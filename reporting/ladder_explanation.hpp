// What a ladder means, for a terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_brackets.hpp"
#include "courant/reporting/prose.hpp"
#include "courant/running/ladder_report.hpp"

namespace courant {

// S₀ ⊇ S₁ = S₂ over M₀ ⊇ M₁ = M₂ with their dimensions, as lines of text: = where the dimensions
// repeat, ∅ where a level is empty.
std::vector<std::string> ladder_text_diagram(const LadderReport& ladder);

// The findings in parts, in the order of ladder_explanation.
struct LadderWords {
  std::vector<Prose> levels;     // what each level adds
  std::vector<Prose> freedom;    // degrees of freedom, classes
  std::vector<Prose> brackets;   // of the constraints
  std::vector<Prose> dynamics;   // total Hamiltonian, gauge generators, Dirac brackets
  std::vector<Prose> unknowns;   // their values, gauge, redundant equations
  std::vector<Prose> certainty;  // the numbers the verdict rests on, and doubts
};
// With brackets where there are some.
LadderWords ladder_words(const LadderReport& ladder,
                         const std::optional<ConstraintBrackets>& brackets = std::nullopt);

// The findings in words, level by level: hidden constraints and where they come
// from, multipliers, gauge directions, redundant equations, and the numbers the verdict rests on.
// One paragraph an entry; entries that begin with a space belong under the one before.
std::vector<Prose> ladder_explanation(
    const LadderReport& ladder, const std::optional<ConstraintBrackets>& brackets = std::nullopt);

// Why the verdict is what it is. Equations that contradict each other are formulas, = 0, where their names are some.
Prose reason_in_words(const LadderReport& ladder);

// That the value of an unknown is one of several, for each of the choices.
std::vector<std::string> choices_in_words(const LadderReport& ladder);

// What of the ladder is proved.
std::string proof_in_words(const LadderProof& proof);

// Whether E(x, λ) is a Morse family at the point, in a sentence; empty of a system that is not given by
// one.
std::string family_in_words(const LadderReport& ladder);

}  // namespace courant
