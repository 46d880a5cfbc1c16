#include "courant/reading/system_kinds.hpp"

namespace courant {

const Registry<Model>& system_kinds() {
  static const Registry<Model> kinds({
      {{"hamiltonian", "a Dirac structure and a Hamiltonian in formulas"}, read_hamiltonian},
      {{"lagrangian", "a Lagrangian in formulas, singular or not, on T*Q"}, read_lagrangian},
      {{"port-hamiltonian", "x' = (J - R) dH + B u with open or closed ports"},
       read_port_hamiltonian},
      {{"implicit", "equations in coordinates, velocities and unknowns"}, read_implicit},
      {{"point-vortices", "n point vortices in the plane, of given \"strengths\""},
       read_point_vortices},
      {{"spherical-vortices", "n point vortices on the sphere, of given \"strengths\""},
       read_spherical_vortices},
  });
  return kinds;
}

}  // namespace courant
