// A build without PETSc (COURANT_WITH_PETSC=OFF).
#include <stdexcept>

#include "courant/extensions/petsc/petsc_session.hpp"

namespace courant {

class PetscSession::Team {};

std::string PetscSession::missing() {
  return "this courant was built without PETSc; expected one built with -D COURANT_WITH_PETSC=ON, "
         "which "
         "takes the Debian packages libpetsc-real-dev and openmpi-bin";
}

PetscSession::PetscSession(const std::vector<std::string>&, const std::atomic<bool>*) {
  throw std::logic_error("PetscSession::PetscSession: " + missing() + ".");
}
PetscSession::~PetscSession() = default;
bool PetscSession::is_first() const { return true; }
int PetscSession::ranks() const { return 1; }
std::shared_ptr<const EquationEngine> PetscSession::engine() const { return nullptr; }
void PetscSession::serve() {}
bool PetscSession::is_lost() const { return false; }

}  // namespace courant
