#include "courant/extensions/petsc/petsc_partition.hpp"

#include <numeric>

#include "courant/extensions/petsc/petsc_call.hpp"

namespace courant {
namespace {

// Fewer blocks a rank are divided in their order.
constexpr Index kFewBlocks = 8;

std::vector<int> in_order(const BlockGraph& blocks, int ranks) {
  const Index all = std::accumulate(blocks.weights.begin(), blocks.weights.end(), Index{0});
  std::vector<int> result;
  Index before = 0;
  for (const Index weight : blocks.weights) {
    result.push_back(static_cast<int>(before * ranks / all));
    before += weight;
  }
  return result;
}

// As PETSc takes it over.
PetscInt* handed_over(const std::vector<Index>& numbers) {
  PetscInt* result = nullptr;
  require_petsc(PetscMalloc1(numbers.size() + 1, &result));
  std::copy(numbers.begin(), numbers.end(), result);
  return result;
}

}  // namespace

std::vector<int> partition(MPI_Comm team, const BlockGraph* blocks) {
  int ranks = 1;
  require_mpi(MPI_Comm_size(team, &ranks));
  Index count = blocks == nullptr ? 0 : std::ssize(blocks->weights);
  const Index own = count;
  require_mpi(MPI_Bcast(&count, 1, MPI_INT64_T, 0, team));
  if (ranks == 1 || count < kFewBlocks * ranks)
    return blocks == nullptr ? std::vector<int>{} : in_order(*blocks, ranks);
  Mat graph = nullptr;
  MatPartitioning parts = nullptr;
  IS found = nullptr;
  const std::vector<Index> none, start = {0};
  require_petsc(MatCreateMPIAdj(team, static_cast<PetscInt>(own), static_cast<PetscInt>(count),
                                handed_over(blocks == nullptr ? start : blocks->begins),
                                handed_over(blocks == nullptr ? none : blocks->neighbours), nullptr,
                                &graph));
  require_petsc(MatPartitioningCreate(team, &parts));
  require_petsc(MatPartitioningSetAdjacency(parts, graph));
#ifdef PETSC_HAVE_PTSCOTCH
  require_petsc(MatPartitioningSetType(parts, MATPARTITIONINGPTSCOTCH));
#endif
  require_petsc(MatPartitioningSetVertexWeights(
      parts, handed_over(blocks == nullptr ? none : blocks->weights)));
  require_petsc(MatPartitioningSetFromOptions(parts));
  require_petsc(MatPartitioningApply(parts, &found));
  const PetscInt* numbers = nullptr;
  require_petsc(ISGetIndices(found, &numbers));
  std::vector<int> result(numbers, numbers + own);
  require_petsc(ISRestoreIndices(found, &numbers));
  require_petsc(ISDestroy(&found));
  require_petsc(MatPartitioningDestroy(&parts));
  require_petsc(MatDestroy(&graph));
  return result;
}

}  // namespace courant
