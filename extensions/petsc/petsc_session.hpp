// PetscSession: the processes of `mpirun` that solve the steps of a run together.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "courant/core/solve/equation_engine.hpp"

namespace courant {

// The first process (rank 0) runs the experiment; the others serve it:
//
//   PetscSession session(options, stop);
//   if (session.is_first())
//     run(experiment, {.folder = …, .engine = session.engine()});
//   else
//     session.serve();
//
// For each system of equations that the steps of a method solve the first rank sends every rank, itself included, the
// equations that are its own: the graph of their instructions, and no more. Unknowns are divided by PETSc's
// MatPartitioning, see BlockGraph. A rank compiles its equations and their rows of the Jacobian, and evaluates them;
// SNES iterates, with the KSP and PC of the options, by default LU factorisation by MUMPS. For a solution a rank gets
// its part of the first iterate and the parameters that its equations read, such as coordinates before the step,
// exchanges with its neighbours what they read of each other in each iteration, and returns its part.
//
// All that is not the solution of equations the first rank does alone: what is predicted, x₁ from the solution,
// projections onto a manifold, what is observed, files.
//
// MPI and PETSc are begun here, in a thread of their own, in which all is called that is theirs. One object a
// process, once.
class PetscSession {
 public:
  // Empty where this build has PETSc; else what is missing, in a sentence.
  static std::string missing();

  // `options`: of PETSc, "-ksp_type", "gmres", …, which come after those in PETSC_OPTIONS. `stop`: set by someone else
  // when the run is to end; solve() of the engine throws EngineStopped where it does not come to its own end then,
  // within half a second.
  // Throws std::runtime_error if MPI or PETSc cannot begin.
  PetscSession(const std::vector<std::string>& options, const std::atomic<bool>* stop);
  // The first rank ends the others. Where is_lost(), nothing of MPI is ended.
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

  bool is_first() const;
  int ranks() const;
  // Of the first rank; it outlives nothing: valid as long as the session.
  std::shared_ptr<const EquationEngine> engine() const;
  // Of the other ranks: returns when the first one is at its end. What fails ends all ranks.
  void serve();
  // Whether a rank does not answer any more. The process has to be ended by _Exit then, which ends the others.
  bool is_lost() const;

 private:
  class Team;
  class Engine;
  std::shared_ptr<Team> team_;
};

}  // namespace courant
