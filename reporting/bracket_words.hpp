// The brackets of constraints in words.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_brackets.hpp"
#include "courant/reporting/prose.hpp"

namespace courant {

// Those that are not 0, or why they have no formulas; nothing where all are 0.
std::vector<Prose> brackets_in_words(const ConstraintBrackets& found);

// What the word behind numbers at the point means; "" where there are none.
std::string note_on_numbers(const ConstraintBrackets& found);

// The total Hamiltonian, what the first class generates, and what is left of the brackets of coordinates.
std::vector<Prose> dynamics_in_words(const ConstraintBrackets& found);

}  // namespace courant
