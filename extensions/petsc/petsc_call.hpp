// Calls of PETSc and MPI, with exceptions.
#pragma once

#include <petscsnes.h>

#include <stdexcept>
#include <string>

namespace courant {

// What PETSc said last of an error; empty before the first one.
std::string& petsc_complaint();

// Throws std::runtime_error, with what PETSc said, unless a call of PETSc has succeeded.
inline void require_petsc(PetscErrorCode code) {
  if (code != 0)
    throw std::runtime_error("PETSc: " + (petsc_complaint().empty()
                                              ? "error " + std::to_string(code)
                                              : petsc_complaint()));
}

inline void require_mpi(int code) {
  if (code != MPI_SUCCESS) throw std::runtime_error("MPI: error " + std::to_string(code));
}

}  // namespace courant
