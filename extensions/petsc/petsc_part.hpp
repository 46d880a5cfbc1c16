// PetscPart: the equations of one rank, and the iteration that all ranks make together.
#pragma once

#include <petscsnes.h>

#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/core/solve/equation_engine.hpp"
#include "courant/extensions/petsc/message.hpp"

namespace courant {

// Some rows of G(u; p) = 0 with the unknowns that they are matched with. All ranks make theirs, and call solve(), at
// the same time.
//
// Convergence is that of Newton: changes relative to the sizes of groups of unknowns, and their contraction. The matrix
// is kept, its factorisation with it, as long as changes contract by it, beyond one solution where the caller says so.
class PetscPart {
 public:
  static constexpr std::size_t kMostGroups = 8;

  // `message`: the name of the system; the kind of back end; the number of the first unknown that is owned, among all
  // rank by rank; how many are owned; the numbers of the others that the rows read; the rows, as EquationRows.
  PetscPart(MPI_Comm team, Message& message);
  ~PetscPart();
  PetscPart(const PetscPart&) = delete;
  PetscPart& operator=(const PetscPart&) = delete;

  bool is_native() const { return rows_.is_native(); }
  int owned() const { return static_cast<int>(owned_); }
  // How many are taken by solve().
  int numbers() const { return static_cast<int>(owned_ + parameters_.size() + kMostGroups); }

  // `numbers`: the first iterate of the unknowns that are owned, the parameters, and where groups of the unknowns that
  // are owned end; on return the solution in the place of the first iterate. `scales`: of the groups.
  EngineEquations::Answer solve(double* numbers, const std::vector<double>& scales,
                                bool keeps_matrix, bool is_damped);

 private:
  static PetscErrorCode evaluate(SNES, Vec u, Vec residual, void* part);
  static PetscErrorCode linearize(SNES, Vec u, Mat, Mat, void* part);
  static PetscErrorCode look(SNES snes, PetscInt iteration, PetscReal, PetscReal,
                             PetscReal residual, SNESConvergedReason* reason, void* part);
  void make_matrix(MPI_Comm team, PetscInt offset, const std::vector<PetscInt>& ghosts);
  void make_solver(MPI_Comm team);
  template <class Evaluate>
  void at(Vec u, const Evaluate& evaluate);
  SNESConvergedReason judge(SNES snes, PetscInt iteration, double residual);

  MPI_Comm team_;
  Function rows_;
  std::size_t owned_ = 0;
  std::vector<double> parameters_, all_;
  Vec u_ = nullptr, residual_ = nullptr;
  Mat matrix_ = nullptr;
  SNES snes_ = nullptr;
  // Of the solution under way.
  std::vector<double> scales_;
  std::vector<std::size_t> ends_;
  std::vector<double> moved_;  // the last changes of groups
  bool keeps_ = false, is_fresh_ = false;
  double previous_ = 0.0, norm_ = 0.0;
  int compared_ = 0, factorizations_ = 0;
};

}  // namespace courant
