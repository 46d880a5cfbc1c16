// The laws of CellComplex and of the sparse Stokes–Dirac structures on it.
#pragma once

#include <vector>

#include "courant/manifolds/law_result.hpp"
#include "courant/structures/stokes_dirac/stokes_dirac.hpp"

namespace courant {

// X1 to X3 in the comment of CellComplex. The entries of coboundaries are integers, so the bounds of X1 and X2 are 0.
std::vector<LawResult> check_cell_complex(const CellComplex& complex);
// K1 to K4 of its matrices, whose entries are integers too.
std::vector<LawResult> check_stokes_dirac(const StokesDirac& structure);

}  // namespace courant
