// The partition of the blocks of a system among ranks.
#pragma once

#include <petscmat.h>

#include <vector>

#include "courant/extensions/petsc/block_graph.hpp"

namespace courant {

// The rank of each block, on the first rank; empty on the others, which call it too, with null. By PETSc's
// MatPartitioning (PTScotch where PETSc has it; -mat_partitioning_type), which makes parts of equal weight that few
// neighbours are cut from; in their order where there are too few blocks for that.
std::vector<int> partition(MPI_Comm team, const BlockGraph* blocks);

}  // namespace courant
